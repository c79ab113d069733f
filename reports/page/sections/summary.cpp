// SPDX-License-Identifier: Apache-2.0
#include "reports/page/estimate_text.hpp"
#include "reports/page/sections/sections.hpp"
#include "reports/page/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <initializer_list>
#include <set>

namespace sturz {
namespace {

std::string manifest_value(const ReportInput& input, const std::string& key) {
  for (const auto& [k, v] : input.manifest)
    if (k == key) return v;
  return {};
}

std::int64_t missing(const ReportInput& input) {
  return std::max<std::int64_t>(0, input.n_planned - std::ssize(input.members));
}

/// "40", or "3 of 40" where some have not been computed.
std::string of_planned(const ReportInput& input, int n) {
  return missing(input) > 0 ? fmt::format("{} of {}", n, input.n_planned) : std::to_string(n);
}

std::string card(const std::string& label, const std::string& value, const std::string& detail) {
  return fmt::format(
      "<div class=\"card\"><dt>{}</dt><dd class=\"value\">{}</dd><dd "
      "class=\"detail\">{}</dd></div>",
      html_escape(label), html_escape(value), html_escape(detail));
}

/// Of a number counted from the maps: each member that is cut off may have reached any cell.
std::string area_interval(const Estimate& e, bool cut) {
  if (std::isnan(e.lower)) return "too few simulations for an interval";
  return fmt::format(
      "{} interval {}", percent_text(interval_confidence),
      cut ? "from " + area_text(e.lower) + ", upper end not known" : area_text(e.lower, e.upper));
}

std::string sentence(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

std::string outcome_counts(const ReportInput& input, const Headline& h) {
  std::string out = h.n_valid > 0 ? counts_text(h.censoring) : "";
  for (const auto& [outcome, n] : h.outcomes)
    if (!is_valid(outcome))
      out += (out.empty() ? "" : ", ") + std::to_string(n) + " " + words(to_string(outcome));
  if (missing(input) > 0) out += fmt::format(", {} not computed yet", missing(input));
  return out;
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
  if (input.region != nullptr)
    add(fmt::format("Region of {} source{}, {} members each", input.region->sources.size(),
                    input.region->sources.size() == 1 ? "" : "s", input.region->members_planned));
  else if (input.hazard != nullptr)
    add(fmt::format("Ensemble of {} member{}", of_planned(input, h.n_members),
                    h.n_members == 1 ? "" : "s"));
  else
    add("Single run");
  add(formulations(input.members));
  add(words(manifest_value(input, "design")));
  add(manifest_value(input, "started"));
  const std::string program = manifest_value(input, "program");
  add(program.empty() ? "sturz" : program);
  return fmt::format(
      "<header class=\"top\"><p class=\"kind\">{}</p><h1>{}</h1><p "
      "class=\"origin\">{}</p></header>",
      input.region != nullptr   ? "Regional hazard map report"
      : input.hazard != nullptr ? "Hazard map report"
                                : "Simulation report",
      html_escape(input.title.empty() ? "Untitled scene" : input.title), html_escape(origin));
}

std::string warnings_html(const ReportInput& input, const Headline& h) {
  std::vector<std::string> lines;
  const int lost = h.n_members - h.n_valid;
  if (h.n_members == 0 && input.region == nullptr)
    lines.emplace_back("No member has finished yet: this page holds no results.");
  else if (h.n_valid == 0 && h.n_members > 0)
    lines.push_back(
        h.n_members == 1
            ? std::string("The run is not valid: its maps must not be used.")
            : fmt::format("None of the {} members is valid: there is no hazard map.", h.n_members));
  if (missing(input) > 0)
    lines.push_back(fmt::format(
        "{} of the {} planned members are missing here: maps and numbers are of a part of the "
        "ensemble.",
        missing(input), input.n_planned));
  if (h.n_valid > 0 && lost > 0)
    lines.push_back(
        fmt::format("{} of {} members failed and {} left out of every map and number "
                    "below; the table of members gives the reasons.",
                    lost, h.n_members, lost == 1 ? "is" : "are"));
  if (h.censoring.censored() > 0 && banner_html(input, h).empty()) {
    const std::vector<std::string> said = censoring_sentences(h.censoring);
    lines.push_back(said[0] + " " + said[1] + " " + said[said.size() - 2]);
  }
  lines.insert(lines.end(), input.warnings.begin(), input.warnings.end());
  for (const auto& w : member_warnings(input.members)) {
    if (std::find(lines.begin(), lines.end(), w.text) != lines.end()) continue;
    lines.push_back(h.n_members == 1
                        ? sentence(w.text)
                        : fmt::format("{} of {} simulations: {}", w.count, h.n_members, w.text));
  }
  if (lines.empty()) return {};
  std::string html =
      "<section class=\"warnings\" aria-label=\"Warnings\"><h2>Read this first</h2><ul>";
  for (const auto& line : lines) html += "<li>" + html_escape(line) + "</li>";
  return html + "</ul></section>";
}

std::string banner_html(const ReportInput& input, const Headline& h) {
  const bool single = input.hazard == nullptr && h.n_members == 1;
  if (h.censoring.censored() == 0 || !(single || h.censoring.too_many())) return {};
  const std::vector<std::string> sentences = censoring_sentences(h.censoring);
  std::string html =
      "<section class=\"banner\" role=\"alert\"><h2>" + html_escape(sentences.front()) + "</h2><p>";
  for (std::size_t i = 1; i < sentences.size(); ++i)
    html.append(i > 1 ? " " : "").append(html_escape(sentences[i]));
  return html + "</p></section>";
}

namespace {

/// Facts joined by semicolons; empty ones are left out.
std::string joined(std::initializer_list<std::string> facts) {
  std::string text;
  for (const std::string& fact : facts)
    if (!fact.empty()) text += (text.empty() ? "" : "; ") + fact;
  return text;
}

std::string metres(double value) { return with_unit(value, "m"); }

/// A card of a median with its interval and what is cut off.
std::string median_card(const std::string& label, const CensoredEstimate& e,
                        const NumberWriter& number, bool single, const std::string& detail) {
  return card(single ? sentence(label) : "Median " + label, value_text(e, number),
              joined({single ? "" : interval_text(e, number), single ? "" : cut_text(e), detail}));
}

std::string area_card(const ReportInput& input, const Headline& h, bool single) {
  const auto area = [](double value) { return area_text(value); };
  if (single || std::isnan(h.likely_area_m2.value))
    return median_card("area reached", h.reached_area_m2, area, single,
                       "cells that the flow touched at any time");
  const bool cut = h.censoring.censored() > 0;
  return card(
      "Area likely reached", (cut ? "\u2265\u00A0" : "") + area_text(h.likely_area_m2.value),
      joined({"P(reached) \u2265 50 %", area_interval(h.likely_area_m2, cut),
              cut ? fmt::format("{} of {} cut off", h.censoring.censored(), h.censoring.valid) : "",
              "cells of " + metres(input.hazard->grid.cell_m)}));
}

std::string crown_to_toe_card(const Headline& h, bool single) {
  const CensoredEstimate& ratio = h.crown_to_toe_ratio;
  const auto angle = [](double tangent) {
    return shown_number(tangent) + " (" +
           shown_number(std::atan(tangent) * 180 / 3.14159265358979) + "\u00B0)";
  };
  return median_card("crown to toe, L", h.crown_to_toe_length_m, metres, single,
                     joined({"H " + value_text(h.crown_to_toe_drop_m, metres),
                             "H/L " + value_text(ratio, angle)}));
}

std::string energy_card(const Headline& h, bool single) {
  return card(
      "Largest kinetic energy",
      (h.censoring.censored() > 0 ? "\u2265\u00A0" : "") + with_unit(h.max_energy_j_m2, "J m-2"),
      joined({single ? "" : fmt::format("member {}", h.max_energy_member),
              fmt::format("fastest {}, thickest {}", with_unit(h.max_speed_m_s, "m s-1"),
                          metres(h.max_thickness_m))}));
}

std::string time_card(const ReportInput& input, const Headline& h, bool single) {
  std::string pace;
  if (!std::isnan(h.members_per_hour) && !single)
    pace = shown_number(h.members_per_hour) + " simulations per hour";
  const bool cpu = h.cpu_seconds > 0;
  return card(
      cpu ? "CPU time" : "Computing time", duration_text(cpu ? h.cpu_seconds : h.member_seconds),
      joined({single ? "of this run" : "summed over simulations",
              input.elapsed_s > 0 ? duration_text(input.elapsed_s) + " elapsed" : "", pace}));
}

std::string region_cards(const ReportInput& input) {
  const RegionShown& region = *input.region;
  std::int64_t valid = 0, planned = 0, cut = 0, with_members = 0;
  for (const RegionShown::Source& s : region.sources) {
    valid += s.valid;
    cut += s.cut_off;
    planned += s.planned;
    with_members += s.valid > 0;
  }
  std::string html = "<section aria-label=\"Key numbers\"><dl class=\"cards\">";
  html += card("Sources", fmt::format("{} of {}", with_members, region.sources.size()),
               "with valid simulations");
  html += card("Valid simulations", fmt::format("{} of {}", valid, planned),
               joined({fmt::format("{} of each source", region.members_planned),
                       cut > 0 ? fmt::format("{} cut off", cut) : ""}));
  html += card("Area that some source reaches", area_text(region.touched_area_m2),
               "cells that any simulation touched");
  std::size_t most = 0;
  for (std::size_t i = 0; i < region.lists.cells.size(); ++i)
    most = std::max(most, region.lists.begin[i + 1] - region.lists.begin[i]);
  html += card("Most sources at one cell", std::to_string(most), "with P > 0");
  return html + card("Elapsed", duration_text(input.elapsed_s), "all sources") + "</dl></section>";
}

/// "grains 830 m, liquid 1011 m" where they are told apart.
std::string runouts_of_each(const Headline& h) {
  if (!h.censoring.phases) return {};
  return "grains " + value_text(h.solid_runout_m, metres) + ", liquid " +
         value_text(h.liquid_runout_m, metres);
}

double cell_of(const ReportInput& input) {
  const LayerStack* maps = input.hazard != nullptr ? input.hazard : input.peaks;
  return maps != nullptr ? maps->grid.cell_m : nan_d;
}

}  // namespace

std::string headline_html(const ReportInput& input, const Headline& h) {
  if (input.region != nullptr) return region_cards(input);
  if (h.n_members == 0) return {};
  std::string html = "<section aria-label=\"Key numbers\"><dl class=\"cards\">";
  const bool single = input.hazard == nullptr && h.n_members == 1;
  if (single)
    html += card("Outcome", sentence(words(to_string(input.members.front().outcome))),
                 input.members.front().reason.empty()
                     ? "simulated " + duration_text(input.members.front().scalars.end_time_s)
                     : input.members.front().reason);
  else
    html += card("Valid simulations", fmt::format("{} of {}", h.n_valid, h.n_members),
                 outcome_counts(input, h));
  if (h.n_valid > 0) {
    html += area_card(input, h, single);
    html += median_card(
        "runout", h.runout_m, metres, single,
        joined({runouts_of_each(h), single ? "release's centre of mass to the farthest cell" : "",
                "read to a cell of " + metres(cell_of(input))}));
    html += crown_to_toe_card(h, single);
    html += median_card("centre-of-mass travel", h.com_travel_m, metres, single, "");
    html += energy_card(h, single);
  }
  return html + time_card(input, h, single) + "</dl></section>";
}

}  // namespace sturz
