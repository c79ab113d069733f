// SPDX-License-Identifier: Apache-2.0
#include "ensemble/risk/asset_rates.hpp"

#include "engine/core/error.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace sturz {
namespace {

/// Sum of frequency times value; error of independent terms. Where a term is not known, neither is
/// the sum.
ExpectedValue by_year(const RiskSpec& spec, std::span<const ScenarioAtAssets> scenarios,
                      auto value_of) {
  ExpectedValue sum{0, 0};
  for (std::size_t i = 0; i < scenarios.size(); ++i) {
    const double f = spec.scenarios[i].frequency_per_year;
    const ExpectedValue v = value_of(scenarios[i].risk);
    sum.mean += f * v.mean;
    sum.standard_error += f * f * v.standard_error * v.standard_error;
  }
  sum.standard_error = std::sqrt(sum.standard_error);
  return sum;
}

std::vector<double> levels_of(const RiskSpec& spec, std::span<const ScenarioRate> rates,
                              std::span<const ScenarioAtAssets> scenarios, std::size_t asset,
                              PeakLayer layer, double unit) {
  std::vector<ScenarioPeak> peaks;
  for (std::size_t i = 0; i < scenarios.size(); ++i)
    for (const AssetHit& hit : scenarios[i].hits.of[asset]) peaks.push_back({hit.peak(layer), i});
  std::vector<double> levels = return_levels(rates, peaks, spec.return_periods_years);
  for (double& level : levels) level *= unit;
  return levels;
}

AssetRate rate_of(const RiskSpec& spec, std::span<const ScenarioRate> rates,
                  std::span<const ScenarioAtAssets> scenarios, std::size_t asset) {
  AssetRate out;
  std::vector<std::size_t> hits, most;
  out.place = AssetPlace::outside;
  bool before = false, after = false;
  for (const ScenarioAtAssets& s : scenarios) {
    const AssetRisk& r = s.risk.rows[asset];
    hits.push_back(static_cast<std::size_t>(r.hit));
    most.push_back(static_cast<std::size_t>(r.hit + r.not_known));
    if (r.place != AssetPlace::outside) out.place = r.place;
    before = before || r.not_known > 0;
    after = after || r.hit_cut_off > 0;
  }
  const auto layers = [&](PeakLayer layer, double unit) {
    return levels_of(spec, rates, scenarios, asset, layer, unit);
  };
  out.thickness_m = out.speed_m_s = out.pressure_kpa =
      std::vector<double>(spec.return_periods_years.size(), nan_d);
  if (out.place == AssetPlace::outside) return out;
  out.rate = annual_rate(rates, hits);
  out.rate_error = annual_rate_error(rates, hits);
  out.most = annual_rate(rates, most);
  out.thickness_m = layers(PeakLayer::thickness, 1);
  out.speed_m_s = layers(PeakLayer::speed, 1);
  out.pressure_kpa = layers(PeakLayer::pressure, 1e-3);
  out.loss = by_year(spec, scenarios, [asset](const RiskTable& t) { return t.rows[asset].loss; });
  if (before) out.cut_off = "members cut off before they hit: all at least";
  if (after && !before)
    out.cut_off = "members cut off after they hit: thickness, speed, pressure, loss at least";
  return out;
}

}  // namespace

RateTable assess_rates(const Assets& assets, const RiskSpec& spec,
                       std::span<const ScenarioAtAssets> scenarios) {
  expect(scenarios.size() == spec.scenarios.size(), "each scenario was looked at");
  std::vector<ScenarioRate> rates;
  for (std::size_t i = 0; i < scenarios.size(); ++i)
    rates.push_back({spec.scenarios[i].frequency_per_year, scenarios[i].hits.members.size()});
  RateTable table;
  for (std::size_t a = 0; a < assets.list.size(); ++a)
    table.n_without_loss +=
        std::isnan(table.rows.emplace_back(rate_of(spec, rates, scenarios, a)).loss.mean);
  table.total_loss = by_year(spec, scenarios, [](const RiskTable& t) { return t.total_loss; });
  return table;
}

FeatureTable rate_features(const Assets& assets, const RiskSpec& spec, const RateTable& table,
                           const std::string& crs_wkt) {
  FeatureTable out;
  out.name = "assets_by_year";
  out.crs_wkt = crs_wkt;
  const auto text = [&](const std::string& name, auto get) {
    std::vector<std::string> values;
    for (std::size_t a = 0; a < assets.list.size(); ++a) values.push_back(get(a));
    out.columns.push_back({name, std::move(values)});
  };
  const auto number = [&](const std::string& name, auto get) {
    std::vector<double> values;
    for (std::size_t a = 0; a < assets.list.size(); ++a) values.push_back(get(a));
    out.columns.push_back({name, std::move(values)});
  };
  const auto& rows = table.rows;
  for (const Asset& a : assets.list) out.wkb.push_back(a.wkb);
  text("name", [&](std::size_t a) { return assets.list[a].name; });
  text("place", [&](std::size_t a) { return std::string(to_string(rows[a].place)); });
  if (assets.has_classes)
    text("class", [&](std::size_t a) { return assets.list[a].vulnerability_class; });
  const std::string unit = "_" + assets.value_unit;
  if (assets.has_values)
    number("value" + unit, [&](std::size_t a) { return assets.list[a].value; });
  number("rate_per_year", [&](std::size_t a) { return rows[a].rate; });
  number("rate_standard_error_per_year", [&](std::size_t a) { return rows[a].rate_error; });
  number("rate_most_per_year", [&](std::size_t a) { return rows[a].most; });
  const auto levels = [&](const char* what, const char* ending,
                          std::vector<double> AssetRate::*member) {
    for (std::size_t p = 0; p < spec.return_periods_years.size(); ++p)
      number(fmt::format("{}_{:g}_years_{}", what, spec.return_periods_years[p], ending),
             [&rows, member, p](std::size_t a) { return (rows[a].*member)[p]; });
  };
  levels("thickness", "m", &AssetRate::thickness_m);
  levels("speed", "m_s", &AssetRate::speed_m_s);
  levels("pressure", "kpa", &AssetRate::pressure_kpa);
  if (assets.has_classes && assets.has_values) {
    number("expected_loss" + unit + "_per_year", [&](std::size_t a) { return rows[a].loss.mean; });
    number("expected_loss_standard_error" + unit + "_per_year",
           [&](std::size_t a) { return rows[a].loss.standard_error; });
  }
  text("cut_off", [&](std::size_t a) { return rows[a].cut_off; });
  return out;
}

}  // namespace sturz
