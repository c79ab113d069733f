// SPDX-License-Identifier: Apache-2.0
#include "ensemble/comparison/asset_differences.hpp"

#include <cmath>
#include <utility>

namespace sturz {
namespace {

/// Losses of each pair at one asset, 0 without a hit.
std::vector<double> losses_of(const Asset& asset, const DamageCurve& curve,
                              const std::vector<AssetHit>& hits, const MemberPairs& pairs,
                              std::size_t first) {
  std::vector<double> losses(pairs.n, 0.0);
  for (const AssetHit& hit : hits) {
    const std::size_t pair = pairs.of_valid[first + hit.member];
    if (pair != no_pair)
      losses[pair] = asset.value * damage_at(curve, static_cast<double>(hit.peak(curve.intensity)));
  }
  return losses;
}

PairCounts counts_of(const std::vector<AssetHit>& a, const std::vector<AssetHit>& b,
                     const MemberPairs& pairs) {
  std::vector<int> deeds(pairs.n, 0);  // 1: A hit it, 2: B did
  for (const AssetHit& hit : a)
    if (const std::size_t p = pairs.of_valid[hit.member]; p != no_pair) deeds[p] |= 1;
  for (const AssetHit& hit : b)
    if (const std::size_t p = pairs.of_valid[pairs.n_a + hit.member]; p != no_pair) deeds[p] |= 2;
  PairCounts c;
  for (const int d : deeds) ++(d == 0 ? c.neither : d == 1 ? c.only_a : d == 2 ? c.only_b : c.both);
  return c;
}

ExpectedValue loss_of(const Asset& asset, const DamageCurve& curve, const MemberPairs& pairs,
                      const std::vector<AssetHit>& a, const std::vector<AssetHit>& b) {
  std::vector<double> difference = losses_of(asset, curve, b, pairs, pairs.n_a);
  const std::vector<double> of_a = losses_of(asset, curve, a, pairs, 0);
  for (std::size_t i = 0; i < difference.size(); ++i) difference[i] -= of_a[i];
  return expected_value(difference, pairs.n);
}

}  // namespace

std::vector<AssetDifference> asset_differences(const Assets& assets, const MemberPairs& pairs,
                                               const AssetHits& a, const AssetHits& b) {
  const RiskTable of_a = assess_assets(assets, a), of_b = assess_assets(assets, b);
  std::vector<AssetDifference> rows;
  for (std::size_t i = 0; i < assets.list.size(); ++i) {
    const AssetRisk &ra = of_a.rows[i], &rb = of_b.rows[i];
    AssetDifference d;
    d.place = ra.place == AssetPlace::outside ? rb.place : ra.place;
    d.probability_a = ra.probability;
    d.probability_b = rb.probability;
    d.cut_off = ra.not_known + ra.hit_cut_off + rb.not_known + rb.hit_cut_off > 0;
    if (ra.place != AssetPlace::outside && rb.place != AssetPlace::outside) {
      d.unpaired = unpaired_difference(ra.hit, ra.valid, rb.hit, rb.valid);
      if (pairs.n > 0) {
        const PairCounts counts = counts_of(a.of[i], b.of[i], pairs);
        d.paired = paired_difference(counts);
        d.unpaired = unpaired_difference(counts.a(), counts.n(), counts.b(), counts.n());
      }
      const Asset& asset = assets.list[i];
      if (asset.curve && pairs.n > 0 && !std::isnan(asset.value))
        d.loss = loss_of(asset, assets.curves[*asset.curve], pairs, a.of[i], b.of[i]);
      else if (pairs.n == 0)
        d.loss = {rb.loss.mean - ra.loss.mean,
                  std::hypot(ra.loss.standard_error, rb.loss.standard_error)};
    }
    rows.push_back(d);
  }
  return rows;
}

FeatureTable difference_features(const Assets& assets, const std::vector<AssetDifference>& rows,
                                 const std::string& crs_wkt) {
  FeatureTable out;
  out.name = "asset_differences";
  out.crs_wkt = crs_wkt;
  std::vector<std::string> names, places, cut_off;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    out.wkb.push_back(assets.list[i].wkb);
    names.push_back(assets.list[i].name);
    places.emplace_back(to_string(rows[i].place));
    cut_off.emplace_back(rows[i].cut_off ? "some members: may be more or less" : "");
  }
  const auto number = [&](const std::string& name, auto get) {
    std::vector<double> values;
    for (const AssetDifference& row : rows) values.push_back(get(row));
    out.columns.push_back({name, std::move(values)});
  };
  using Row = const AssetDifference&;
  out.columns.push_back({"name", std::move(names)});
  out.columns.push_back({"place", std::move(places)});
  number("probability_a", [](Row r) { return r.probability_a; });
  number("probability_b", [](Row r) { return r.probability_b; });
  number("difference_paired", [](Row r) { return r.paired.difference; });
  number("difference_paired_lower_95", [](Row r) { return r.paired.lower; });
  number("difference_paired_upper_95", [](Row r) { return r.paired.upper; });
  number("difference_unpaired", [](Row r) { return r.unpaired.difference; });
  number("difference_unpaired_lower_95", [](Row r) { return r.unpaired.lower; });
  number("difference_unpaired_upper_95", [](Row r) { return r.unpaired.upper; });
  if (assets.has_classes && assets.has_values) {
    number("loss_difference_" + assets.value_unit, [](Row r) { return r.loss.mean; });
    number("loss_difference_standard_error_" + assets.value_unit,
           [](Row r) { return r.loss.standard_error; });
  }
  out.columns.push_back({"cut_off", std::move(cut_off)});
  return out;
}

}  // namespace sturz
