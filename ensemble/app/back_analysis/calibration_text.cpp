// SPDX-License-Identifier: Apache-2.0
#include "ensemble/app/back_analysis/calibration_text.hpp"

#include "ensemble/app/console/fitted.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace sturz::app {
namespace {

using Lines = std::vector<std::string>;
using Rows = std::vector<std::vector<std::string>>;
using workflow::Calibrated;
using workflow::KeySummary;

std::string number(double value) { return fmt::format("{:.4g}", value); }
std::string range(const double (&v)[3]) {
  return fmt::format("{} [{} .. {}]", number(v[1]), number(v[0]), number(v[2]));
}
std::string unit_text(const std::string& unit) { return unit == "1" ? "" : " " + unit; }

/// A dash where one member holds all the weight.
std::string told_text(double share) {
  return std::isnan(share) ? "-" : fmt::format("{:.0f} %", 100 * share);
}

std::string method_line(const Calibrated& c) {
  const Posterior& p = c.found.posterior;
  std::string text =
      fmt::format("method {} ({}); {} members{}", to_string(p.method), c.found.reason, c.n_drawn,
                  c.n_chosen > 0 ? fmt::format(" and {} chosen ones", c.n_chosen) : "");
  text += p.chains ? fmt::format("; chains of {:.0f} independent draws", p.effective_size)
                   : fmt::format("; worth {:.0f} independent members", p.effective_size);
  if (p.chains) {
    const auto& r = p.chains->r_hat;
    const auto [least, most] =
        std::minmax_element(p.chains->acceptance.begin(), p.chains->acceptance.end());
    text += fmt::format("; {} chains, R-hat {:.3f}, acceptance {:.2f} .. {:.2f}",
                        p.chains->acceptance.size(), *std::max_element(r.begin(), r.end()), *least,
                        *most);
  }
  return text;
}

void add(const Rows& rows, int columns, Lines& lines) {
  for (std::string& line : fitted_table(rows, columns)) lines.push_back(std::move(line));
}

void add_keys(const Calibrated& c, int columns, Lines& lines) {
  Rows rows{{"value", "prior [5 % .. 95 %]", "posterior", "told"}};
  if (c.found.best) rows[0].emplace_back("best fit");
  for (const KeySummary& k : c.keys) {
    rows.push_back({k.key + unit_text(k.unit), range(k.prior), range(k.posterior),
                    told_text(k.variance_removed)});
    if (k.best) rows.back().push_back(number(*k.best));
  }
  add(rows, columns, lines);
  for (const Ridge& r : c.found.identifiability.ridges)
    lines.push_back(
        fmt::format("ridge: {} and {} (correlation {:+.2f}): a combination of them is "
                    "known, not each",
                    c.keys[r.a].key, c.keys[r.b].key, r.correlation));
}

void add_emulators(const Calibrated& c, Lines& lines) {
  if (c.found.emulators.empty()) return;
  std::string text;
  for (const EmulatorReport& e : c.found.emulators)
    text += fmt::format("{}{} {:.2f}{}", text.empty() ? "" : ", ", e.quantity, e.q2,
                        e.step ? " (two sides of a step)" : "");
  lines.push_back("emulators, Q2 by leaving one out: " + text);
}

std::string interval(const PredictedQuantity& p) {
  return fmt::format("{} [{} .. {}]", number(p.median), number(p.lower), number(p.upper));
}

std::string best_text(const Observation& o) {
  if (o.known == Known::not_at_all) return "not known";
  return (o.known == Known::at_least ? ">= " : "") + number(o.value);
}

void add_quantities(const Calibrated& c, int columns, Lines& lines) {
  const auto& held = c.found.held_out.quantities;
  Rows rows{{"quantity", "observed", "posterior gives (90 %)"}};
  if (!held.empty()) rows[0].emplace_back("without it (90 %)");
  if (c.best_member) rows[0].emplace_back("best member");
  for (std::size_t q = 0; q < c.found.check.size(); ++q) {
    const PredictedQuantity& p = c.found.check[q];
    rows.push_back({p.name, number(p.observed), interval(p)});
    if (!held.empty()) rows.back().push_back(interval(held[q].predicted));
    if (c.best_member) rows.back().push_back(best_text((*c.best_member)[q]));
  }
  add(rows, columns, lines);
  const auto ends = [](const PredictedQuantity& p) { return p.ends_at_least; };
  if (std::any_of(c.found.check.begin(), c.found.check.end(), ends) ||
      std::any_of(held.begin(), held.end(),
                  [&](const HeldOutQuantity& h) { return ends(h.predicted); }))
    lines.emplace_back(
        "a 0 predicted: the quantity is never smaller; what normal errors put below stands there");
  if (!held.empty())
    lines.push_back(fmt::format(
        "held out one by one: {:.0f} % inside 50 %, {:.0f} % inside 90 %; log score {:.2f} against "
        "{:.2f} of the prior",
        100 * c.found.held_out.coverage50, 100 * c.found.held_out.coverage90,
        c.found.held_out.mean_log_score, c.found.held_out.prior_mean_log_score));
}

void add_events(const Calibrated& c, int columns, Lines& lines) {
  if (c.found.held_out.events.empty()) return;
  Rows rows{{"event, by the others", "log score", "of the prior", "worth", "inside 90 %"}};
  for (const HeldOutEvent& e : c.found.held_out.events)
    rows.push_back({e.event, fmt::format("{:.2f}", e.log_score),
                    fmt::format("{:.2f}", e.prior_log_score),
                    fmt::format("{:.0f}", e.effective_size),
                    fmt::format("{} of {}", e.n_inside90, e.quantities.size())});
  add(rows, columns, lines);
}

void add_discrepancy(const Calibrated& c, Lines& lines) {
  if (c.discrepancy == 0) {
    lines.emplace_back("no model discrepancy: as sure as if the model were perfect");
    return;
  }
  std::string text;
  for (const DiscrepancyFound& d : c.found.discrepancies)
    text += fmt::format("{}{} {:.0f} % [{:.0f} .. {:.0f}]", text.empty() ? "" : ", ", d.kind,
                        100 * d.mean, 100 * d.lower, 100 * d.upper);
  lines.push_back("model discrepancy: " + text);
}

}  // namespace

std::vector<std::string> calibration_lines(const Calibrated& c, int columns) {
  Lines lines{method_line(c)};
  add_keys(c, columns, lines);
  add_emulators(c, lines);
  add_quantities(c, columns, lines);
  add_events(c, columns, lines);
  add_discrepancy(c, lines);
  return lines;
}

}  // namespace sturz::app
