// SPDX-License-Identifier: Apache-2.0
#include "ensemble/assets/asset_risk.hpp"

#include "ensemble/hazard/sample_quantile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace sturz {
namespace {

template <class Value>
HitQuantiles quantiles_of(const std::vector<AssetHit>& hits, Value value, double units_per_si) {
  std::vector<float> sorted;
  for (const AssetHit& hit : hits) sorted.push_back(value(hit));
  std::sort(sorted.begin(), sorted.end());
  HitQuantiles q;
  for (std::size_t i = 0; i < q.size(); ++i)
    q[i] = sample_quantile(sorted, 0, hit_quantile_levels[i]) * units_per_si;
  return q;
}

std::string cut_off_text(const AssetRisk& r, bool damage) {
  std::string text;
  if (r.not_known > 0)
    text =
        fmt::format("{} cut off before they hit: probability{} at least, quantiles of the others",
                    r.not_known, damage ? ", damage, loss" : "");
  if (r.hit_cut_off > 0)
    text += fmt::format("{}{} cut off after they hit: thickness, speed, pressure{} at least",
                        text.empty() ? "" : "; ", r.hit_cut_off, damage ? ", damage, loss" : "");
  return text;
}

void count(const std::vector<AssetHit>& hits, const std::vector<Censoring>& censoring,
           AssetRisk& r) {
  r.valid = static_cast<std::int64_t>(censoring.size());
  r.hit = static_cast<std::int64_t>(hits.size());
  const std::int64_t censored = std::count_if(censoring.begin(), censoring.end(), is_censored);
  r.hit_cut_off = std::count_if(hits.begin(), hits.end(), [&](const AssetHit& hit) {
    return is_censored(censoring[hit.member]);
  });
  r.not_known = censored - r.hit_cut_off;
}

/// The interval that holds whether or not those would have hit of which it is not known.
ProbabilityBounds bounds_of(const AssetRisk& r, double z) {
  return {wilson_interval(r.hit, r.valid, z).lower,
          wilson_interval(r.hit + r.not_known, r.valid, z).upper};
}

AssetRisk risk_of(const Asset& asset, const std::vector<AssetHit>& hits,
                  const std::vector<Censoring>& censoring) {
  AssetRisk r;
  r.place = asset.place();
  count(hits, censoring, r);
  if (!hits.empty() && r.place == AssetPlace::outside) r.place = AssetPlace::partly_outside;
  if (r.valid == 0 || r.place == AssetPlace::outside) {
    r.not_known = r.valid;
    return r;
  }
  r.probability = static_cast<double>(r.hit) / static_cast<double>(r.valid);
  r.bounds_90 = bounds_of(r, z_90);
  r.bounds_95 = bounds_of(r, z_95);
  r.arrival_s = quantiles_of(
      hits, [](const AssetHit& h) { return h.arrival_s; }, 1);
  r.thickness_m = quantiles_of(
      hits, [](const AssetHit& h) { return h.thickness_m; }, 1);
  r.speed_m_s = quantiles_of(
      hits, [](const AssetHit& h) { return h.speed_m_s; }, 1);
  r.pressure_kpa = quantiles_of(
      hits, [](const AssetHit& h) { return h.pressure_pa; }, 1e-3);
  r.cut_off = cut_off_text(r, asset.curve.has_value());
  return r;
}

/// Damage by each hit, of its curve.
std::vector<double> damages_of(const DamageCurve& curve, const std::vector<AssetHit>& hits) {
  std::vector<double> damages;
  for (const AssetHit& hit : hits)
    damages.push_back(damage_at(curve, static_cast<double>(hit.peak(curve.intensity))));
  return damages;
}

}  // namespace

ExpectedValue expected_value(const std::vector<double>& not_zero, std::size_t n) {
  if (n == 0) return {};
  const auto size = static_cast<double>(n);
  double sum = 0, squares = 0;
  for (const double v : not_zero) sum += v;
  const double mean = sum / size;
  for (const double v : not_zero) squares += (v - mean) * (v - mean);
  squares += static_cast<double>(n - not_zero.size()) * mean * mean;
  return {mean, n > 1 ? std::sqrt(squares / (size - 1) / size) : nan_d};
}

RiskTable assess_assets(const Assets& assets, const AssetHits& hits) {
  RiskTable table;
  const std::size_t n = hits.members.size();
  std::vector<double> losses(n, 0.0);  // of each member, all assets together
  bool any_loss = false;
  for (std::size_t a = 0; a < assets.list.size(); ++a) {
    const Asset& asset = assets.list[a];
    AssetRisk r = risk_of(asset, hits.of[a], hits.censoring);
    if (asset.curve && !std::isnan(r.probability)) {
      const std::vector<double> damages = damages_of(assets.curves[*asset.curve], hits.of[a]);
      r.damage = expected_value(damages, n);
      if (!std::isnan(asset.value)) {
        any_loss = true;
        r.loss = {asset.value * r.damage.mean, asset.value * r.damage.standard_error};
        for (std::size_t i = 0; i < damages.size(); ++i)
          losses[hits.of[a][i].member] += asset.value * damages[i];
      }
    }
    table.n_without_loss += std::isnan(r.loss.mean);
    table.rows.push_back(std::move(r));
  }
  if (any_loss) table.total_loss = expected_value(losses, n);
  return table;
}

const char* to_string(AssetPlace place) {
  switch (place) {
    case AssetPlace::inside:
      return "inside";
    case AssetPlace::partly_outside:
      return "partly outside";
    default:
      return "outside";
  }
}

}  // namespace sturz
