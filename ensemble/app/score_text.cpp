// SPDX-License-Identifier: Apache-2.0
#include "ensemble/app/score_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sturz::app {
namespace {

/// ">= 12" of a lower bound, "12 so far" of what may go either way.
std::string known_text(const Observation& value, const std::string& text) {
  if (std::isnan(value.value)) return "none";
  if (value.known == Known::at_least) return ">= " + text;
  return value.known == Known::exactly ? text : text + " so far";
}

const char* word(Known known) {
  switch (known) {
    case Known::exactly:
      return "exactly";
    case Known::at_least:
      return "at_least";
    case Known::not_at_all:
      break;
  }
  return "not_at_all";
}

std::string unit_text(const std::string& unit) {
  if (unit == "1") return "";
  return " " + (unit == "m s-1" ? std::string("m/s") : unit);
}

std::string area_text(const ScoreTable& t, std::size_t row, const std::string& area) {
  std::string text;
  for (const auto& [tail, label] :
       {std::pair("_iou", "IoU"), std::pair("_hit_rate", "hit rate"),
        std::pair("_false_alarm_ratio", "false alarms"), std::pair("_hss", "HSS"),
        std::pair("_hausdorff_m", "Hausdorff m")}) {
    const auto k = t.column(area + tail);
    if (!k) continue;
    const Observation& value = t.rows[row][*k];
    const bool length = std::string(tail).ends_with("_m");
    const std::string number =
        length ? fmt::format("{:.0f}", value.value) : fmt::format("{:.3f}", value.value);
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", label, known_text(value, number));
  }
  return text;
}

/// Row of the comparison that belongs to a row of the table: those without scores have none.
std::size_t compared(const ScoreTable& t, std::size_t row) {
  return static_cast<std::size_t>(
      std::count_if(t.rows.begin(), t.rows.begin() + static_cast<std::ptrdiff_t>(row),
                    [](const auto& scores) { return !scores.empty(); }));
}

}  // namespace

std::vector<std::pair<std::string, std::string>> score_lines(const ScoreTable& t, std::size_t row) {
  std::vector<std::pair<std::string, std::string>> lines;
  if (t.rows.at(row).empty()) return lines;
  for (const char* area : {"outline", "deposit", "thickness"})
    if (const std::string text = area_text(t, row, area); !text.empty())
      lines.emplace_back(area, text);
  const std::vector<Observation>& simulated = t.comparison.simulated.values[compared(t, row)];
  for (std::size_t q = 0; q < simulated.size(); ++q) {
    const ObservedQuantity& o = t.comparison.observed[q];
    lines.emplace_back(
        o.name, fmt::format("{}{} (observed {:.4g} +- {:.3g})",
                            known_text(simulated[q], fmt::format("{:.4g}", simulated[q].value)),
                            unit_text(o.unit), o.value, o.sd));
  }
  const Observation& misfit = t.rows[row][*t.column("misfit")];
  lines.emplace_back("misfit", known_text(misfit, fmt::format("{:.3g}", misfit.value)) +
                                   " standard deviations (root mean square)");
  return lines;
}

nlohmann::ordered_json score_json(const ScoreTable& t, std::size_t row) {
  using Json = nlohmann::ordered_json;
  if (t.rows.at(row).empty()) return nullptr;
  Json scores = Json::object(), observed = Json::array();
  for (std::size_t k = 0; k < t.columns.size(); ++k)
    scores[t.columns[k].name] = {{"value", t.rows[row][k].value},
                                 {"known", word(t.rows[row][k].known)}};
  const std::vector<Observation>& simulated = t.comparison.simulated.values[compared(t, row)];
  for (std::size_t q = 0; q < simulated.size(); ++q) {
    const ObservedQuantity& o = t.comparison.observed[q];
    observed.push_back({{"name", o.name},
                        {"value", o.value},
                        {"sd", o.sd},
                        {"unit", o.unit},
                        {"simulated", simulated[q].value},
                        {"known", word(simulated[q].known)}});
  }
  return {{"scores", scores}, {"observed", observed}};
}

std::string nearest_text(const ScoreTable& t, std::span<const std::int64_t> numbers) {
  const std::vector<std::size_t> rows = best_rows(t);
  if (rows.empty()) return {};
  const auto score = [&](const char* name) {
    const auto k = t.column(name);
    return k ? t.rows[rows.front()][*k] : Observation{nan_d, Known::not_at_all};
  };
  const Observation misfit = score("misfit");
  std::string text =
      fmt::format("nearest to what was observed: member {} (misfit {}", numbers[rows.front()],
                  known_text(misfit, fmt::format("{:.3g}", misfit.value)));
  for (const auto& [name, label] :
       {std::pair("outline_iou", "outline IoU"), std::pair("deposit_iou", "deposit IoU"),
        std::pair("thickness_iou", "thickness IoU")})
    if (t.column(name)) text += fmt::format(", {} {:.3f}", label, score(name).value);
  text += ")";
  for (std::size_t i = 1; i < std::min<std::size_t>(rows.size(), 3); ++i)
    text += fmt::format("{} {}", i == 1 ? ", then" : ",", numbers[rows[i]]);
  return text;
}

}  // namespace sturz::app
