// SPDX-License-Identifier: Apache-2.0
// The whole finding in one sentence, and what it holds for.
#include "reports/page/estimate_text.hpp"
#include "reports/page/sections/sections.hpp"
#include "reports/page/text.hpp"
#include "reports/texts/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

constexpr std::size_t most_conditions = 4;

std::string metres(double value) { return with_unit(value, "m"); }

/// "at least 830 m" in a sentence, where a card has a sign; empty where it is not known.
std::string in_a_sentence(const CensoredEstimate& e) {
  if (std::isnan(e.value)) return {};
  const std::string number = metres(e.value);
  return e.at_least ? tr("plain.at_least", number) : number;
}

/// Latest median arrival [s] in cells that half of the members reach; NaN where it is not known.
double last_arrival(const LayerStack& hazard) {
  const Layer *reached = nullptr, *arrival = nullptr;
  for (const Layer& layer : hazard.layers) {
    const LayerMeaning& m = layer.meaning;
    if (m.quantity == Quantity::reached && m.statistic == Statistic::probability) reached = &layer;
    if (m.quantity == Quantity::arrival && m.statistic == Statistic::quantile) arrival = &layer;
  }
  if (reached == nullptr || arrival == nullptr) return nan_d;
  const auto& levels = arrival->axis.values;
  const auto median = std::find(levels.begin(), levels.end(), 0.5);
  if (median == levels.end()) return nan_d;
  const std::size_t n = hazard.grid.n_cells();
  const float* times =
      arrival->values.data() + static_cast<std::size_t>(median - levels.begin()) * n;
  double last = nan_d;
  for (std::size_t i = 0; i < n; ++i)
    if (reached->values[i] >= 0.5F && !std::isnan(times[i]) && !(last >= times[i])) last = times[i];
  return last;
}

/// With three digits: a sentence is no table.
double rounded(double value) {
  if (value == 0) return 0;
  const double unit = std::pow(10.0, std::floor(std::log10(std::abs(value))) - 2);
  return std::round(value / unit) * unit;
}

/// " of about 1.2 million m³", or a range where members release differently; empty: not known.
std::string volume_text(const std::vector<MemberSummary>& members) {
  double least = nan_d, most = nan_d;
  for (const MemberSummary& m : members) {
    const double v = m.scalars.release_volume_m3;
    if (!is_valid(m.outcome) || !(v > 0)) continue;
    if (!(least <= v)) least = v;
    if (!(most >= v)) most = v;
  }
  if (std::isnan(least)) return {};
  if (most <= 1.02 * least) return tr("plain.volume", with_unit(rounded(most), "m3"));
  return tr("plain.volume_range", shown_number(rounded(least)), with_unit(rounded(most), "m3"));
}

/// What the sampled values are, each with the range that was drawn.
std::string conditions_text(const ReportInput& input) {
  const ReportTable& samples = input.samples;
  std::string text;
  for (std::size_t k = 0; k < samples.columns.size() && !samples.rows.empty(); ++k) {
    if (k == most_conditions) {
      text += tr_count("plain.more_values",
                       static_cast<long long>(samples.columns.size() - most_conditions));
      break;
    }
    double least = nan_d, most = nan_d;
    for (const auto& row : samples.rows) {
      if (!(least <= row[k])) least = row[k];
      if (!(most >= row[k])) most = row[k];
    }
    const DisplayUnit unit = display_unit(k < samples.units.size() ? samples.units[k] : "1");
    least = rounded(least), most = rounded(most);
    const std::string label = unit.label.empty() ? "" : "\u00A0" + unit.label;
    text += (text.empty() ? "" : ", ") + key_label(samples, k) + " " +
            shown_number(unit.factor * least) + "\u2013" + shown_number(unit.factor * most) + label;
  }
  return text;
}

/// Of the assets the one that most members hit, how many are hit at all, and of how many nothing is
/// known; empty: none.
std::string assets_text(const ReportInput& input) {
  if (input.assets == nullptr || input.risk == nullptr || input.risk->rows.empty()) return {};
  const auto& rows = input.risk->rows;
  const auto hit =
      std::count_if(rows.begin(), rows.end(), [](const AssetRisk& r) { return r.probability > 0; });
  const auto unknown = std::count_if(rows.begin(), rows.end(),
                                     [](const AssetRisk& r) { return std::isnan(r.probability); });
  const auto known = std::ssize(rows) - unknown;
  std::string beyond;
  if (unknown > 0) beyond.append(1, ' ').append(tr_count("plain.assets_unknown", unknown));
  if (known == 0) return beyond.substr(1);
  if (hit == 0) return tr("plain.no_asset", known) + beyond;
  const auto worst = std::max_element(rows.begin(), rows.end(), [](const auto& a, const auto& b) {
    return (a.probability >= 0 ? a.probability : -1) < (b.probability >= 0 ? b.probability : -1);
  });
  const Asset& asset = input.assets->list[static_cast<std::size_t>(worst - rows.begin())];
  const std::string share = percent_text(worst->probability);
  std::string text = tr("plain.assets", hit, known, asset.name,
                        worst->not_known > 0 ? tr("plain.at_least", share) : share,
                        percent_text(worst->bounds_95.lower), percent_text(worst->bounds_95.upper));
  if (!std::isnan(worst->arrival_s[0]))
    text += tr("plain.asset_soon", duration_text(worst->arrival_s[0]));
  return text + "." + beyond;
}

/// "what the flow reaches", with its interval, its area and how soon.
std::string ensemble_sentence(const ReportInput& input, const Headline& h) {
  std::string text = tr("plain.if_released", volume_text(input.members));
  const std::string runout = in_a_sentence(h.runout_m);
  if (!runout.empty()) {
    text += input.weights.empty() ? tr("plain.runout", runout, h.n_valid)
                                  : tr("plain.runout_weighted", runout);
    if (!std::isnan(h.runout_m.lower)) text += " (" + interval_text(h.runout_m, metres) + ")";
  }
  if (!std::isnan(h.likely_area_m2.value)) {
    const std::string area = area_text(h.likely_area_m2.value);
    text += (runout.empty() ? " " : tr("plain.and")) +
            tr("plain.area", h.censoring.censored() > 0 ? tr("plain.at_least", area) : area);
  }
  const double last = std::isnan(h.likely_area_m2.value) ? nan_d : last_arrival(*input.hazard);
  if (last > 0) text += tr("plain.soon", duration_text(std::round(last)));
  return text + ".";
}

std::string single_sentence(const Headline& h, const MemberSummary& m) {
  const bool cut = is_censored(m.censoring);
  const std::string runout = in_a_sentence(h.runout_m);
  return tr("plain.single", runout.empty() ? "\u2013" : runout,
            (cut ? tr("plain.at_least", area_text(m.scalars.reached_area_m2))
                 : area_text(m.scalars.reached_area_m2)),
            with_unit(m.scalars.max_speed_m_s, "m s-1"), duration_text(m.scalars.end_time_s)) +
         (cut ? tr("plain.single_cut") : "");
}

/// How many of the members the sentence rests on, and which do not count or count as bounds.
std::string sureness_text(const ReportInput& input, const Headline& h) {
  std::string text = tr_count("plain.rests_on", h.n_valid);
  if (!input.weights.empty()) text += tr("plain.worth", shown_number(input.effective_members));
  if (h.n_members > h.n_valid) text += tr_count("plain.failed", h.n_members - h.n_valid);
  if (const auto cut = h.censoring.censored(); cut > 0) text += tr_count("plain.cut", cut);
  return text + ".";
}

PlainWords region_words(const RegionShown& region) {
  std::size_t most = 0;
  for (std::size_t i = 0; i < region.lists.cells.size(); ++i)
    most = std::max(most, region.lists.begin[i + 1] - region.lists.begin[i]);
  return {tr_count("plain.region", static_cast<long long>(region.sources.size()),
                   area_text(region.touched_area_m2), most),
          tr("plain.region_holds", region.members_planned)};
}

/// "+12" of a difference of probabilities, in percentage points.
std::string change_text(double difference) {
  const double points = std::round(100 * difference);
  const char* const sign = points > 0 ? "+" : points < 0 ? "\u2212" : "";
  return fmt::format("{}{:.0f}", sign, std::abs(points));
}

PlainWords comparison_words(const ComparisonShown& c) {
  PlainWords words;
  words.finding = tr("plain.comparison", c.name_a, c.name_b, change_text(c.least),
                     change_text(c.most), area_text(c.less_m2), area_text(c.more_m2));
  words.holds = c.pairs > 0 ? tr("plain.comparison_pairs", c.pairs, c.valid_a, c.valid_b)
                            : tr("plain.comparison_unpaired", c.valid_a, c.valid_b);
  if (c.cut_off > 0) words.holds.append(" ").append(tr("plain.comparison_cut", c.cut_off));
  std::string list;
  for (std::size_t k = 0; k < std::min(most_conditions, c.differences.size()); ++k)
    list += (list.empty() ? "" : "; ") + c.differences[k];
  if (c.differences.size() > most_conditions) list += "; \u2026";
  if (!list.empty()) words.holds.append(" ").append(tr("plain.comparison_scenes", list));
  return words;
}

}  // namespace

PlainWords plain_words(const ReportInput& input, const Headline& h) {
  if (input.region != nullptr) return region_words(*input.region);
  if (input.comparison != nullptr) return comparison_words(*input.comparison);
  if (h.n_valid == 0) return {};
  if (input.hazard == nullptr)
    return {single_sentence(h, input.members.front()), tr("plain.single_holds")};
  PlainWords words;
  words.finding = ensemble_sentence(input, h);
  if (const std::string assets = assets_text(input); !assets.empty()) words.finding += " " + assets;
  const std::string conditions = conditions_text(input);
  words.holds = conditions.empty() ? tr("plain.no_ranges") : tr("plain.ranges", conditions);
  words.holds.append(" ")
      .append(sureness_text(input, h))
      .append(" ")
      .append(tr("plain.not_how_often"));
  return words;
}

std::string plain_words_html(const ReportInput& input, const Headline& h) {
  const PlainWords words = plain_words(input, h);
  if (words.finding.empty()) return {};
  return "<section class=\"plain-words\" aria-label=\"" + html_escape(tr("plain.label")) +
         "\"><p class=\"finding\">" + html_escape(words.finding) + "</p><p class=\"holds\">" +
         html_escape(words.holds) + "</p></section>";
}

}  // namespace sturz
