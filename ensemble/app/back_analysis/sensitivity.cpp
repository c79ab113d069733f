// SPDX-License-Identifier: Apache-2.0
// sturz sensitivity: which uncertain value matters for which result of a finished ensemble.
#include "ensemble/workflow/sensitivity/sensitivity.hpp"

#include "ensemble/app/commands.hpp"
#include "ensemble/app/console/console_observer.hpp"
#include "ensemble/app/console/fitted.hpp"
#include "ensemble/app/console/interrupt.hpp"
#include "ensemble/app/console/json_text.hpp"
#include "ensemble/app/exit_codes.hpp"
#include "ensemble/app/grammar.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include <algorithm>
#include <cmath>

namespace sturz::app {
namespace {

struct Options {
  std::string folder;
  std::vector<std::string> results;
  bool ranks_only = false;
  bool maps = false;
};

using workflow::ResultSensitivity;
using workflow::Sensitivity;
using Json = nlohmann::ordered_json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }
Json share_json(const Share& s) {
  return {{"value", number(s.value)}, {"lower", number(s.lower)}, {"upper", number(s.upper)}};
}

const SobolIndices* indices_of(const ResultSensitivity& r) {
  if (r.direct) return &*r.direct;
  return r.emulated ? &r.emulated->indices : nullptr;
}

Json key_json(const Sensitivity& all, const ResultSensitivity& r, std::size_t k) {
  Json one{{"key", all.keys[k]}, {"kendall_tau", number(r.ranks[k].tau)}};
  if (!r.morris.empty()) {
    const MorrisMeasure& m = r.morris[k];
    one["morris"] = {{"mu", number(m.mean)},
                     {"mu_star", number(m.mean_absolute)},
                     {"mu_star_error", number(m.mean_absolute_error)},
                     {"sigma", number(m.deviation)},
                     {"effects", m.n},
                     {"effects_left_out", m.n_censored}};
  }
  if (const SobolIndices* s = indices_of(r); s != nullptr && !s->first.empty()) {
    one["sobol_first"] = share_json(s->first[k]);
    one["sobol_total"] = share_json(s->total[k]);
  }
  return one;
}

Json result_json(const Sensitivity& all, const ResultSensitivity& r) {
  Json keys = Json::array();
  for (std::size_t k = 0; k < all.keys.size(); ++k) keys.push_back(key_json(all, r, k));
  Json one{{"result", r.name},
           {"unit", r.unit},
           {"members_known", r.n_exact},
           {"members_cut_off", r.n_censored},
           {"keys", std::move(keys)}};
  if (const SobolIndices* s = indices_of(r)) {
    one["sobol_method"] = r.direct ? "direct" : "emulator";
    one["sobol_sets"] = s->n_sets;
    one["sobol_sets_left_out"] = s->n_left_out;
  }
  if (r.emulated) one["emulator_q2"] = number(r.emulated->emulator.q2);
  if (!r.why_not.empty()) one["no_indices"] = r.why_not;
  return one;
}

std::string share_text(const Share& s) {
  return fmt::format("{:.2f} [{:.2f} .. {:.2f}]", s.value, s.lower, s.upper);
}

/// "by emulator, Q2 0.93", "62 sets, 2 left out", or why there are none.
std::string origin_text(const ResultSensitivity& r) {
  std::string text = fmt::format("{} members known", r.n_exact);
  if (r.n_censored > 0) text += fmt::format(", {} cut off or not there", r.n_censored);
  if (r.direct)
    text += fmt::format("; {} sets, {} left out", r.direct->n_sets, r.direct->n_left_out);
  if (r.emulated) text += fmt::format("; shares by emulator, Q2 {:.2f}", r.emulated->emulator.q2);
  if (!r.why_not.empty()) text += "; no shares: " + r.why_not;
  return text;
}

void say(const Sensitivity& all, const ResultSensitivity& r, Console& console) {
  console.say(
      fmt::format("{}{} ({})", r.name, r.unit == "1" ? "" : " [" + r.unit + "]", origin_text(r)));
  std::size_t width = 8;
  for (const std::string& key : all.keys) width = std::max(width, key.size());
  const SobolIndices* s = indices_of(r);
  for (std::size_t k = 0; k < all.keys.size(); ++k) {
    std::string line = fmt::format("  {:<{}}  tau {:+.2f}", all.keys[k], width, r.ranks[k].tau);
    if (!r.morris.empty())
      line += fmt::format("  mu* {:.4g} +- {:.2g}  sigma {:.4g}", r.morris[k].mean_absolute,
                          r.morris[k].mean_absolute_error, r.morris[k].deviation);
    if (s != nullptr && !s->first.empty())
      line += fmt::format("  first {}  total {}", share_text(s->first[k]), share_text(s->total[k]));
    // Where both shares do not fit, they stand below each other.
    const std::size_t total = line.find("  total ");
    const int wide = columns_of(STDOUT_FILENO);
    if (wide > 0 && line.size() > static_cast<std::size_t>(wide) && total != std::string::npos)
      line.replace(total, 2, "\n" + std::string(line.find("  first ") + 2, ' '));
    console.say(line);
  }
}

int sensitivity(const Options& options, Console& console) {
  ConsoleObserver observer(console);
  const Sensitivity all =
      workflow::sensitivity_of({options.folder, options.results, !options.ranks_only, options.maps},
                               observer, interrupt_flag());
  Json results = Json::array();
  for (const ResultSensitivity& r : all.results) {
    say(all, r, console);
    results.push_back(result_json(all, r));
  }
  console.say("In " + all.file.string());
  if (!all.maps.empty()) console.say("Maps of the shares in " + all.maps.string());
  console.event(json_text(Json{{"event", "done"},
                               {"file", all.file.string()},
                               {"maps", all.maps.empty() ? Json(nullptr) : Json(all.maps.string())},
                               {"results", std::move(results)}}));
  return ok;
}

}  // namespace

void add_sensitivity(Grammar& grammar) {
  auto [parser, options] =
      add_command(grammar, "sensitivity",
                  "Which uncertain value matters for which result of an ensemble", sensitivity);
  parser.add_option("folder", options.folder, "Folder of an ensemble")
      ->type_name("DIR")
      ->required();
  parser
      .add_option("--result", options.results,
                  "Column of members.csv; may be given more than once (default: the usual ones)")
      ->type_name("NAME");
  parser.add_flag("--maps", options.maps,
                  "Sobol' indices of each cell too (design saltelli), in sensitivity.nc");
  parser.add_flag("--ranks-only", options.ranks_only, "No emulators: rank correlations alone");
  add_remote(parser);
  add_json(grammar, parser);
}

}  // namespace sturz::app
