// SPDX-License-Identifier: Apache-2.0
#include "reports/page/sections/sections.hpp"
#include "reports/page/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace sturz {
namespace {

std::string list(const std::vector<std::string>& lines) {
  std::string html = "<ul>";
  for (const auto& line : lines) html += "<li>" + html_escape(line) + "</li>";
  return html + "</ul>";
}

std::string timing_table(const NamedSeconds& timings) {
  double total = 0;
  for (const auto& [name, seconds] : timings) total += seconds;
  std::string html = "<table class=\"plain\"><tbody>";
  for (const auto& [name, seconds] : timings) {
    const double share = total > 0 ? seconds / total : 0;
    html += fmt::format(
        "<tr><th scope=\"row\">{}</th><td class=\"n\">{}</td><td class=\"n\">{}</td><td>"
        "<svg width=\"72\" height=\"8\" aria-hidden=\"true\"><rect class=\"bar\" height=\"8\" "
        "rx=\"2\" width=\"{:.1f}\"/></svg></td></tr>",
        html_escape(name), duration_text(seconds), html_escape(percent_text(share)), 72 * share);
  }
  return html + "</tbody></table>";
}

std::string times_html(const ReportInput& input) {
  std::string html = timing_table(input.timings);
  html += fmt::format(
      "<p class=\"note\">By the clock{}: more than the CPU time where the cores were shared.</p>",
      input.hazard != nullptr ? ", summed over the simulations" : "");
  if (!input.pass_timings.empty())
    html += "<details><summary>By pass of a step</summary>" + timing_table(input.pass_timings) +
            "</details>";
  return html;
}

}  // namespace

std::string computation_html(const ReportInput& input, const Headline&) {
  if (input.description.empty() && input.timings.empty() && input.notes.empty()) return {};
  std::string html =
      "<section id=\"computation\"><h2>What was computed</h2><div class=\"columns\">";
  if (!input.description.empty()) {
    html += "<div><h3>The scene as it was understood</h3><pre class=\"lines\">";
    for (const auto& line : input.description) html += html_escape(line) + "\n";
    html += "</pre></div>";
  }
  if (!input.timings.empty())
    html += "<div><h3>Where the time went</h3>" + times_html(input) + "</div>";
  if (input.hazard != nullptr) html += left_out_html(input.members);
  if (!input.notes.empty())
    html += "<div><h3>What was done to the input</h3>" + list(input.notes) + "</div>";
  return html + "</div></section>";
}

namespace {
/// "input elev_12_5m.tif": the name of a file keeps its underscores.
bool is_file(std::string_view key) { return key.starts_with("input "); }
}  // namespace

std::string provenance_html(const ReportInput& input) {
  if (input.manifest.empty() && input.scenario_yaml.empty()) return {};
  std::string html = "<section id=\"origin\"><h2>Where this comes from</h2>";
  if (!input.manifest.empty()) {
    html += "<dl class=\"manifest\">";
    for (const auto& [key, value] : input.manifest)
      html += "<div><dt>" + html_escape(is_file(key) ? key : words(key)) + "</dt><dd>" +
              html_escape(value) + "</dd></div>";
    html += "</dl>";
  }
  if (!input.scenario_yaml.empty())
    html += "<details><summary>Scenario file, with defaults filled in</summary><pre>" +
            html_escape(input.scenario_yaml) + "</pre></details>";
  return html + "</section>";
}

namespace {

std::vector<std::string> region_reading() {
  return {
      "Every probability holds if a source releases: it is the share of that source\u2019s valid "
      "simulations, \u201Cgiven the ranges in the scenario file\u201D. Nothing here says how often "
      "or how probably a source fails.",
      "\u201CThe likeliest source\u201D: the largest of the sources\u2019 probabilities. "
      "\u201CAny hit, independent\u201D: 1 \u2212 \u220F(1 \u2212 p), if all sources release, each "
      "with uncertain values of its own. \u201CAny hit, the same values\u201D: if all release and "
      "the uncertain values are the same everywhere, as these simulations were drawn; it is never "
      "less than the likeliest source\u2019s and can be far below the independent one. The truth "
      "lies where between them the sources share their ground and water.",
      "Quantiles of the worst source: of each source\u2019s quantile the largest. They are no "
      "quantiles over all sources.",
      "With few simulations of each source a probability is coarse: of 8, no value lies between 0 "
      "and 12.5 %, and 0 of 8 may be up to 32 % (95 % interval).",
  };
}

}  // namespace

std::string reading_html(const ReportInput& input) {
  const std::string level = percent_text(interval_confidence);
  std::vector<std::string> lines;
  if (input.region != nullptr) {
    lines = region_reading();
  } else if (input.hazard != nullptr) {
    lines = {
        ("Probability is the share of the valid simulations (members): it answers \u201Cgiven the "
         "ranges in the scenario file\u201D, not \u201Chow often does such a slide occur\u201D. It "
         "says nothing "
         "about the chance that the slope fails."),
        "Intervals at " + level +
            " of probabilities are Wilson's, for members drawn independently: they tell how much "
            "the "
            "map could change with other members of the same ensemble. Latin hypercube and "
            "Sobol\u2019 "
            "designs usually do better than that. Errors of the model, the terrain and the "
            "ranges themselves are not in them.",
        "Intervals of medians need no distribution (order statistics); they are left out where "
        "there are too few members.",
        "A member is cut off when mass left the known terrain, or still moved at the end. It "
        "counts "
        "in every probability with what it reached, which makes that a lower bound. Its runout, "
        "area and peaks are lower bounds, too: medians with such members are Kaplan and Meier's "
        "estimate, or \u201C\u2265\u201D where half of the members or more are cut off, and their "
        "intervals hold wherever those members would have ended. What lies at rest is not known "
        "while mass moves: medians of lengths and heights of the deposit leave such members out, "
        "and their intervals let them lie anywhere.",
        "L is the horizontal distance from the crown of the release to the farthest cell of the "
        "deposit, H the fall between the two, H/L the tangent of the travel angle "
        "(Fahrb\u00F6schung).",
    };
  }
  lines.emplace_back(
      "Peaks are the largest value of each product at one instant, never the largest thickness "
      "times the largest speed.");
  lines.emplace_back(
      "Thickness, speed, energy and pressure are smoothed and fade out up to two spacings beyond "
      "the edge of the mass. Reached area, arrival, runout and intensity end at the edge itself: "
      "cells just outside may show a thickness although nothing reached them.");
  if (input.resolved_thickness_m > 0)
    lines.push_back("Thickness thresholds below " + with_unit(input.resolved_thickness_m, "m") +
                    " (half a particle spacing) are not resolved and are marked so.");
  lines.emplace_back(
      "Maps in this page are rounded to about a thousandth of their largest value (finer near "
      "zero), probabilities not at all; the result files hold all digits.");
  return "<section id=\"reading\"><h2>How to read the numbers</h2>" + list(lines) + "</section>";
}

}  // namespace sturz
