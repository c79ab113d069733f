// SPDX-License-Identifier: Apache-2.0
#include "reports/page/cut_off_text.hpp"
#include "reports/page/estimate_text.hpp"
#include "reports/page/sections/sections.hpp"
#include "reports/page/text.hpp"
#include "reports/texts/text_table.hpp"

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
  return missing(input) > 0 ? tr("header.of_planned", n, input.n_planned) : std::to_string(n);
}

std::string card(const std::string& label, const std::string& value, const std::string& detail) {
  return fmt::format(
      "<div class=\"card\"><dt>{}</dt><dd class=\"value\">{}</dd><dd "
      "class=\"detail\">{}</dd></div>",
      html_escape(label), html_escape(value), html_escape(detail));
}

/// Of a number counted from the maps: each member that is cut off may have reached any cell.
std::string area_interval(const Estimate& e, bool cut) {
  if (std::isnan(e.lower)) return tr("cards.few_for_interval");
  return tr("cards.interval", percent_text(interval_confidence)) +
         (cut ? tr("cards.from_open", area_text(e.lower)) : area_text(e.lower, e.upper, e.value));
}

std::string sentence(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

std::string outcome_counts(const ReportInput& input, const Headline& h) {
  std::string out = h.n_valid > 0 ? cut_off_counts(h.censoring) : "";
  for (const auto& [outcome, n] : h.outcomes)
    if (!is_valid(outcome))
      out += (out.empty() ? "" : ", ") + std::to_string(n) + " " + outcome_text(outcome);
  if (missing(input) > 0) out.append(", ").append(tr("cards.not_computed", missing(input)));
  return out;
}

/// "depth averaged", or both where members differ.
std::string formulations(const std::vector<MemberSummary>& members) {
  std::set<std::string> names;
  for (const MemberSummary& m : members)
    if (is_valid(m.outcome) && !m.formulation.empty()) names.insert(words(m.formulation));
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : tr("header.and")) + name;
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
    add(tr_count("header.region", static_cast<long long>(input.region->sources.size()),
                 input.region->members_planned));
  else if (input.comparison != nullptr)
    add(tr("header.comparison", input.comparison->valid_a, input.comparison->valid_b));
  else if (input.hazard != nullptr)
    add(tr_count("header.ensemble", h.n_members, of_planned(input, h.n_members)));
  else
    add(tr("header.single"));
  add(formulations(input.members));
  add(words(manifest_value(input, "design")));
  add(moment_text(manifest_value(input, "started")));
  const std::string program = manifest_value(input, "program");
  add(program.empty() ? "sturz" : program);
  return fmt::format(
      "<header class=\"top\"><p class=\"kind\">{}</p><h1>{}</h1><p "
      "class=\"origin\">{}</p></header>",
      html_escape(tr(input.region != nullptr       ? "header.kind_region"
                     : input.comparison != nullptr ? "header.kind_comparison"
                     : input.hazard != nullptr     ? "header.kind_ensemble"
                                                   : "header.kind_single")),
      html_escape(input.title.empty() ? tr("header.untitled") : input.title), html_escape(origin));
}

namespace {

/// Sentences of the page in its language first, then those of the program, which are English.
struct WarningLines {
  std::vector<std::string> lines;
  std::size_t own = 0;  ///< so many of them are the page's

  std::string attribute(std::size_t k) const { return k < own ? "" : english_attribute(); }
  /// That the rest is English; empty where it is not, or nothing is.
  std::string note() const {
    return lines.size() > own && page_language() != "en" ? tr("warnings.english") : std::string();
  }
};

WarningLines warning_lines(const ReportInput& input, const Headline& h) {
  WarningLines all;
  std::vector<std::string>& lines = all.lines;
  const int lost = h.n_members - h.n_valid;
  if (h.n_members == 0 && input.region == nullptr && input.comparison == nullptr)
    lines.push_back(tr("warnings.none_yet"));
  else if (h.n_valid == 0 && h.n_members > 0)
    lines.push_back(h.n_members == 1 ? tr("warnings.run_not_valid")
                                     : tr("warnings.none_valid", h.n_members));
  if (missing(input) > 0) lines.push_back(tr("warnings.missing", missing(input), input.n_planned));
  if (h.n_valid > 0 && lost > 0) lines.push_back(tr_count("warnings.left_out", lost, h.n_members));
  if (h.censoring.censored() > 0 && banner_html(input, h).empty()) {
    const std::vector<std::string> said = cut_off_sentences(h.censoring);
    lines.push_back(said[0] + " " + said[1] + " " + said[said.size() - 2]);
  }
  all.own = lines.size();
  lines.insert(lines.end(), input.warnings.begin(), input.warnings.end());
  for (const auto& w : member_warnings(input.members)) {
    if (std::find(lines.begin(), lines.end(), w.text) != lines.end()) continue;
    lines.push_back(h.n_members == 1 ? sentence(w.text)
                                     : tr("warnings.of_members", w.count, h.n_members, w.text));
  }
  return all;
}

}  // namespace

std::string attention_html(const ReportInput& input, const Headline& h) {
  const WarningLines all = warning_lines(input, h);
  if (all.lines.empty()) return {};
  return "<p class=\"attention\"><a href=\"#warnings\"><b>" +
         html_escape(tr_count("attention", std::ssize(all.lines))) + "</b> <span" +
         all.attribute(0) + ">" + html_escape(all.lines.front()) + "</span></a></p>";
}

std::string warnings_html(const ReportInput& input, const Headline& h) {
  const WarningLines all = warning_lines(input, h);
  const std::vector<std::string>& lines = all.lines;
  // The banner is not on the printed sheets; what it says is.
  std::string cut;
  if (!banner_html(input, h).empty())
    for (const std::string& sentence : cut_off_sentences(h.censoring))
      cut.append(cut.empty() ? "" : " ").append(sentence);
  if (lines.empty() && cut.empty()) return {};
  std::string html = "<section id=\"warnings\" class=\"warnings";
  html += lines.empty() ? " print-only" : "";
  html += "\" aria-label=\"" + html_escape(tr("warnings.label")) + "\"><h2>" +
          html_escape(tr("warnings.title")) + "</h2><ul>";
  if (!cut.empty()) html += "<li class=\"print-only\">" + html_escape(cut) + "</li>";
  // A printed page holds so many lines beside the numbers, and says how many it does not.
  constexpr std::size_t most_letters = 1500;
  std::size_t letters = cut.size(), left_out = 0;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    letters += lines[k].size();
    const bool printed = letters <= most_letters;
    left_out += !printed;
    html += std::string(printed ? "<li" : "<li class=\"screen-only\"") + all.attribute(k) + ">" +
            html_escape(lines[k]) + "</li>";
  }
  if (left_out > 0)
    html += "<li class=\"print-only\">" + html_escape(tr("warnings.more", left_out)) + "</li>";
  html += "</ul>";
  if (const std::string note = all.note(); !note.empty())
    html += "<p class=\"note\">" + html_escape(note) + "</p>";
  return html + "</section>";
}

std::string banner_html(const ReportInput& input, const Headline& h) {
  const bool single = input.hazard == nullptr && h.n_members == 1;
  if (h.censoring.censored() == 0 || !(single || h.censoring.too_many())) return {};
  const std::vector<std::string> sentences = cut_off_sentences(h.censoring);
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
  return card(
      single ? sentence(label) : tr(e.weighted ? "cards.median_weighted" : "cards.median", label),
      value_text(e, number),
      joined({single ? "" : interval_text(e, number), single ? "" : cut_text(e), detail}));
}

std::string area_card(const ReportInput& input, const Headline& h, bool single) {
  const auto area = [](double value) { return area_text(value); };
  if (single || std::isnan(h.likely_area_m2.value))
    return median_card(tr("cards.area_reached"), h.reached_area_m2, area, single,
                       tr("cards.area_touched"));
  const bool cut = h.censoring.censored() > 0;
  return card(tr("cards.area_likely"),
              (cut ? "\u2265\u00A0" : "") + area_text(h.likely_area_m2.value),
              joined({tr("cards.p_half"), area_interval(h.likely_area_m2, cut),
                      cut ? tr("cards.cut_of", h.censoring.censored(), h.censoring.valid) : "",
                      tr("cards.cells_of", metres(input.hazard->grid.cell_m))}));
}

std::string crown_to_toe_card(const Headline& h, bool single) {
  const CensoredEstimate& ratio = h.crown_to_toe_ratio;
  const auto angle = [](double tangent) {
    return shown_number(tangent) + " (" +
           shown_number(std::atan(tangent) * 180 / 3.14159265358979) + "\u00B0)";
  };
  return median_card(tr("cards.crown_to_toe"), h.crown_to_toe_length_m, metres, single,
                     joined({"H " + value_text(h.crown_to_toe_drop_m, metres),
                             "H/L " + value_text(ratio, angle)}));
}

std::string energy_card(const Headline& h, bool single) {
  return card(
      tr("cards.energy"),
      (h.censoring.censored() > 0 ? "\u2265\u00A0" : "") + with_unit(h.max_energy_j_m2, "J m-2"),
      joined(
          {single ? "" : tr("cards.member", h.max_energy_member),
           tr("cards.fastest", with_unit(h.max_speed_m_s, "m s-1"), metres(h.max_thickness_m))}));
}

std::string time_card(const ReportInput& input, const Headline& h, bool single) {
  std::string pace;
  if (!std::isnan(h.members_per_hour) && !single)
    pace = tr("cards.per_hour", shown_number(h.members_per_hour));
  const bool cpu = h.cpu_seconds > 0;
  return card(
      tr(cpu ? "cards.cpu_time" : "cards.computing_time"),
      duration_text(cpu ? h.cpu_seconds : h.member_seconds),
      joined({tr(single ? "cards.of_this_run" : "cards.summed"),
              input.elapsed_s > 0 ? tr("cards.elapsed", duration_text(input.elapsed_s)) : "",
              pace}));
}

std::string cards_head() {
  return "<section id=\"numbers\" aria-label=\"" + html_escape(tr("cards.label")) +
         "\"><h2 class=\"print-only\">" + html_escape(tr("cards.title")) +
         "</h2><dl class=\"cards\">";
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
  std::string html = cards_head();
  html += card(tr("cards.sources"), tr("header.of_planned", with_members, region.sources.size()),
               tr("cards.with_valid"));
  html += card(tr("cards.valid"), tr("header.of_planned", valid, planned),
               joined({tr("cards.of_each_source", region.members_planned),
                       cut > 0 ? tr("cards.n_cut", cut) : ""}));
  html += card(tr("cards.area_some_source"), area_text(region.touched_area_m2),
               tr("cards.any_simulation"));
  std::size_t most = 0;
  for (std::size_t i = 0; i < region.lists.cells.size(); ++i)
    most = std::max(most, region.lists.begin[i + 1] - region.lists.begin[i]);
  html += card(tr("cards.most_sources"), std::to_string(most), tr("cards.p_above_0"));
  return html +
         card(tr("cards.elapsed_title"), duration_text(input.elapsed_s), tr("cards.all_sources")) +
         "</dl></section>";
}

/// "grains 830 m, liquid 1011 m" where they are told apart.
std::string runouts_of_each(const Headline& h) {
  if (!h.censoring.phases) return {};
  return tr("cards.each_runout", value_text(h.solid_runout_m, metres),
            value_text(h.liquid_runout_m, metres));
}

double cell_of(const ReportInput& input) {
  const LayerStack* maps = input.hazard != nullptr ? input.hazard : input.peaks;
  return maps != nullptr ? maps->grid.cell_m : nan_d;
}

}  // namespace

std::string headline_html(const ReportInput& input, const Headline& h) {
  if (input.region != nullptr) return region_cards(input);
  if (h.n_members == 0) return {};
  std::string html = cards_head();
  const bool single = input.hazard == nullptr && h.n_members == 1;
  if (single)
    html +=
        card(tr("cards.outcome"), sentence(outcome_text(input.members.front().outcome)),
             input.members.front().reason.empty()
                 ? tr("cards.simulated", duration_text(input.members.front().scalars.end_time_s))
                 : input.members.front().reason);
  else
    html += card(tr("cards.valid"), tr("header.of_planned", h.n_valid, h.n_members),
                 outcome_counts(input, h));
  if (h.n_valid > 0) {
    html += area_card(input, h, single);
    html += median_card(tr("cards.runout"), h.runout_m, metres, single,
                        joined({runouts_of_each(h), single ? tr("cards.runout_from") : "",
                                tr("cards.read_to_cell", metres(cell_of(input)))}));
    html += crown_to_toe_card(h, single);
    html += median_card(tr("cards.com_travel"), h.com_travel_m, metres, single, "");
    html += energy_card(h, single);
  }
  return html + time_card(input, h, single) + "</dl></section>";
}

}  // namespace sturz
