// SPDX-License-Identifier: Apache-2.0
#include "reports/page/sections.hpp"
#include "reports/page/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <set>

namespace sturz {
namespace {

std::string manifest_value(const ReportInput& input, const std::string& key) {
  for (const auto& [k, v] : input.manifest)
    if (k == key) return v;
  return {};
}

std::string card(const std::string& label, const std::string& value, const std::string& detail) {
  return fmt::format(
      "<div class=\"card\"><dt>{}</dt><dd class=\"value\">{}</dd><dd "
      "class=\"detail\">{}</dd></div>",
      html_escape(label), html_escape(value), html_escape(detail));
}

std::string interval_text(const Estimate& e, const std::string& ends) {
  if (std::isnan(e.lower)) return "too few members for an interval";
  return fmt::format("{} interval {}", percent_text(interval_confidence), ends);
}

std::string sentence(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

std::string outcome_counts(const Headline& h) {
  std::string out;
  for (const auto& [outcome, n] : h.outcomes)
    out += (out.empty() ? "" : " \u00B7 ") + std::to_string(n) + " " + words(to_string(outcome));
  return out;
}

/// Warnings of members differ in their numbers only: one line per sentence, with its count.
struct MemberWarning {
  std::string example;
  int count = 0;
};
std::vector<MemberWarning> member_warnings(const std::vector<MemberSummary>& members) {
  std::map<std::string, std::size_t> place;
  std::vector<MemberWarning> found;
  for (const MemberSummary& m : members) {
    std::size_t start = 0;
    while (start < m.warnings.size()) {
      const std::size_t end = std::min(m.warnings.find("; ", start), m.warnings.size());
      const std::string text = m.warnings.substr(start, end - start);
      std::string shape = text;
      std::erase_if(shape, [](unsigned char c) { return std::isdigit(c) || c == '.'; });
      const auto [it, is_new] = place.try_emplace(shape, found.size());
      if (is_new) found.push_back({text, 0});
      ++found[it->second].count;
      start = end + 2;
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.count > b.count; });
  return found;
}

/// "depth averaged", or both where members differ.
std::string formulations(const std::vector<MemberSummary>& members) {
  std::set<std::string> names;
  for (const MemberSummary& m : members)
    if (is_valid(m.outcome) && !m.formulation.empty()) names.insert(words(m.formulation));
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : " and ") + name;
  return text;
}

}  // namespace

std::string header_html(const ReportInput& input, const Headline& h) {
  std::string origin;
  const auto add = [&origin](const std::string& text) {
    if (text.empty()) return;
    origin += (origin.empty() ? "" : " \u00B7 ") + text;
  };
  if (input.hazard != nullptr)
    add(fmt::format("Ensemble of {} member{}", h.n_members, h.n_members == 1 ? "" : "s"));
  else
    add("Single run");
  add(formulations(input.members));
  add(words(manifest_value(input, "design")));
  add(manifest_value(input, "date"));
  const std::string version = manifest_value(input, "version");
  add(version.empty() ? "sturz" : "sturz " + version);
  return fmt::format(
      "<header class=\"top\"><p class=\"kind\">{}</p><h1>{}</h1><p "
      "class=\"origin\">{}</p></header>",
      input.hazard != nullptr ? "Hazard map report" : "Simulation report",
      html_escape(input.title.empty() ? "Untitled scene" : input.title), html_escape(origin));
}

std::string warnings_html(const ReportInput& input, const Headline& h) {
  std::vector<std::string> lines;
  const int lost = h.n_members - h.n_valid;
  if (h.n_members == 0)
    lines.emplace_back("No member has finished yet: this page holds no results.");
  else if (h.n_valid == 0)
    lines.push_back(
        h.n_members == 1
            ? std::string("The run is not valid: its maps must not be used.")
            : fmt::format("None of the {} members is valid: there is no hazard map.", h.n_members));
  else if (lost > 0)
    lines.push_back(
        fmt::format("{} of {} members failed and {} left out of every map and number "
                    "below; the table of members gives the reasons.",
                    lost, h.n_members, lost == 1 ? "is" : "are"));
  lines.insert(lines.end(), input.warnings.begin(), input.warnings.end());
  for (const auto& w : member_warnings(input.members)) {
    if (std::find(lines.begin(), lines.end(), w.example) != lines.end()) continue;
    lines.push_back(h.n_members == 1
                        ? sentence(w.example)
                        : fmt::format("{} of {} members: {}", w.count, h.n_members, w.example));
  }
  if (lines.empty()) return {};
  std::string html =
      "<section class=\"warnings\" aria-label=\"Warnings\"><h2>Read this first</h2><ul>";
  for (const auto& line : lines) html += "<li>" + html_escape(line) + "</li>";
  return html + "</ul></section>";
}

std::string headline_html(const ReportInput& input, const Headline& h) {
  if (h.n_members == 0) return {};
  std::string html = "<section aria-label=\"Key numbers\"><dl class=\"cards\">";
  const bool single = input.hazard == nullptr && h.n_members == 1;
  if (single)
    html += card("Outcome", sentence(words(to_string(input.members.front().outcome))),
                 input.members.front().reason.empty()
                     ? "simulated " + duration_text(input.members.front().scalars.end_time_s)
                     : input.members.front().reason);
  else
    html +=
        card("Valid members", fmt::format("{} of {}", h.n_valid, h.n_members), outcome_counts(h));
  if (h.n_valid > 0) {
    if (!std::isnan(h.likely_area_m2.value))
      html += card("Area likely reached", area_text(h.likely_area_m2.value),
                   fmt::format("P(reached) \u2265 50 %; {}",
                               interval_text(h.likely_area_m2, area_text(h.likely_area_m2.lower,
                                                                         h.likely_area_m2.upper))));
    else
      html += card(single ? "Area reached" : "Median area reached", area_text(h.reached_area_m2),
                   "cells that the flow touched at any time");
    html += card(single ? "Runout" : "Median runout", with_unit(h.runout_m.value, "m"),
                 single ? std::string("release's centre of mass to the farthest cell reached")
                        : interval_text(h.runout_m, shown_number(h.runout_m.lower) + " \u2013 " +
                                                        with_unit(h.runout_m.upper, "m")));
    html += card("Largest kinetic energy", with_unit(h.max_energy_j_m2, "J m-2"),
                 (single ? std::string() : fmt::format("member {}; ", h.max_energy_member)) +
                     fmt::format("fastest {}, thickest {}", with_unit(h.max_speed_m_s, "m s-1"),
                                 with_unit(h.max_thickness_m, "m")));
  }
  std::string pace;
  if (!std::isnan(h.members_per_hour) && !single)
    pace = shown_number(h.members_per_hour) + " members per hour";
  if (input.elapsed_s > 0)
    pace += (pace.empty() ? "" : "; ") + duration_text(input.elapsed_s) + " elapsed";
  html += card("Computing time", duration_text(h.member_seconds),
               pace.empty() ? (single ? "of this run" : "summed over members") : pace);
  return html + "</dl></section>";
}

}  // namespace sturz
