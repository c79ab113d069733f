// SPDX-License-Identifier: Apache-2.0
#include "ensemble/assets/asset_levels.hpp"

#include "engine/core/error.hpp"
#include "ensemble/hazard/map_units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <iterator>
#include <string_view>
#include <utility>

namespace sturz {
namespace {

/// Of names of columns that one level alone has.
constexpr std::array plain_parts{"er_95", "_q05_", "_q50_", "_q95_"};

/// Numbers of all draws at one asset.
class DrawsAtAssets {
 public:
  DrawsAtAssets(std::span<const AssetHits> levels, std::span<const LevelDraw> draws)
      : levels_(levels), draws_(draws.begin(), draws.end()) {
    for (const LevelDraw& draw : draws) {
      auto& places = places_.emplace_back();
      for (std::size_t l = draw.from; l < levels.size(); ++l) {
        const auto& numbers = levels[l].members;
        const auto at = std::lower_bound(numbers.begin(), numbers.end(), draw.number);
        expect(at != numbers.end() && *at == draw.number, "a level's hits are of its draws");
        places[l] = static_cast<std::size_t>(at - numbers.begin());
      }
    }
  }

  void look_at(std::size_t asset) {
    for (std::size_t l = 0; l < levels_.size(); ++l) {
      hits_[l].assign(levels_[l].members.size(), nullptr);
      for (const AssetHit& hit : levels_[l].of[asset]) hits_[l][hit.member] = &hit;
    }
  }

  /// 0 where a member did not hit.
  template <class Get>
  std::vector<LevelDraw> values(Get get) const {
    std::vector<LevelDraw> out = draws_;
    for (std::size_t k = 0; k < out.size(); ++k)
      for (std::size_t l = out[k].from; l < levels_.size(); ++l) {
        const AssetHit* hit = hits_[l][places_[k][l]];
        out[k].values[l] = hit != nullptr ? get(*hit) : 0.0;
      }
    return out;
  }

  /// P(value > threshold). Each draw of the dearest level that was cut off below it may still have
  /// exceeded it: the upper bound lies higher by their share.
  ShareEstimate share_above(const std::vector<LevelDraw>& draws, double threshold) const {
    ShareEstimate share = multilevel_share_above(draws, levels_.size(), threshold);
    double dear = 0, open = 0;
    for (std::size_t k = 0; k < draws.size(); ++k) {
      if (draws[k].from > 0) continue;
      dear += 1;
      if (is_open(k) && !(draws[k].values[0] > threshold)) open += 1;
    }
    if (open > 0 && std::isfinite(share.share))
      share.bounds_90.high = std::min(1.0, share.bounds_90.high + open / dear);
    return share;
  }

  /// Of the dearest level.
  void count(AssetRisk& r) const {
    for (std::size_t k = 0; k < draws_.size(); ++k) {
      if (draws_[k].from > 0) continue;
      const bool hit = hits_[0][places_[k][0]] != nullptr;
      r.valid += 1;
      r.hit += hit ? 1 : 0;
      r.hit_cut_off += hit && is_open(k) ? 1 : 0;
      r.not_known += !hit && is_open(k) ? 1 : 0;
    }
  }

 private:
  /// Of the dearest level, and cut off.
  bool is_open(std::size_t k) const {
    return draws_[k].from == 0 && is_censored(levels_[0].censoring[places_[k][0]]);
  }

  std::span<const AssetHits> levels_;
  std::vector<LevelDraw> draws_;
  std::vector<std::array<std::size_t, most_levels>> places_;    // [draw][level] among valid members
  std::array<std::vector<const AssetHit*>, most_levels> hits_;  // [level][place]; null: none
};

std::string cut_off_text(const AssetRisk& r, bool has_damage) {
  std::string text;
  const char* damage = has_damage ? ", damage, loss" : "";
  if (r.not_known > 0)
    text = fmt::format("{} of the dearest level cut off before they hit: probabilities{} at least",
                       r.not_known, damage);
  if (r.hit_cut_off > 0)
    text += fmt::format("{}{} cut off after they hit: exceedances{} at least",
                        text.empty() ? "" : "; ", r.hit_cut_off, damage);
  return text;
}

AssetRisk risk_of(const Assets& assets, const Asset& asset, const DrawsAtAssets& draws,
                  std::size_t n_levels) {
  AssetRisk r;
  r.place = asset.place();
  draws.count(r);
  if (r.hit > 0 && r.place == AssetPlace::outside) r.place = AssetPlace::partly_outside;
  if (r.valid == 0 || r.place == AssetPlace::outside) {
    r.not_known = r.valid;
    return r;
  }
  const ShareEstimate hit =
      draws.share_above(draws.values([](const AssetHit&) { return 1.0; }), 0.5);
  r.probability = hit.share;
  r.bounds_90 = {hit.bounds_90.low, hit.bounds_90.high};
  r.cut_off = cut_off_text(r, asset.curve.has_value());
  if (!asset.curve || std::isnan(r.probability)) return r;
  const DamageCurve& curve = assets.curves[*asset.curve];
  const MultilevelMean damage =
      multilevel_scalar(draws.values([&](const AssetHit& h) {
        return damage_at(curve, static_cast<double>(h.peak(curve.intensity)));
      }),
                        n_levels)
          .mean;
  // Not cut to the probability of a hit, which is an estimate too: losses add up to their total.
  r.damage = {std::clamp(damage.mean, 0.0, 1.0), damage.standard_error};
  if (!std::isnan(asset.value))
    r.loss = {asset.value * r.damage.mean, asset.value * r.damage.standard_error};
  return r;
}

/// Of all assets whose loss is known: draw by draw, as they are lost together.
ExpectedValue total_loss(const Assets& assets, const RiskTable& table,
                         std::span<const LevelDraw> draws, DrawsAtAssets& at,
                         std::size_t n_levels) {
  std::vector<LevelDraw> losses(draws.begin(), draws.end());
  for (LevelDraw& draw : losses) draw.values = {};
  bool any = false;
  for (std::size_t a = 0; a < assets.list.size(); ++a) {
    if (std::isnan(table.rows[a].loss.mean)) continue;
    any = true;
    at.look_at(a);
    const DamageCurve& curve = assets.curves[*assets.list[a].curve];
    const std::vector<LevelDraw> own = at.values([&](const AssetHit& h) {
      return assets.list[a].value * damage_at(curve, static_cast<double>(h.peak(curve.intensity)));
    });
    for (std::size_t k = 0; k < own.size(); ++k)
      for (std::size_t l = own[k].from; l < n_levels; ++l) losses[k].values[l] += own[k].values[l];
  }
  if (!any) return {};
  const MultilevelMean mean = multilevel_scalar(losses, n_levels).mean;
  return {std::max(mean.mean, 0.0), mean.standard_error};
}

/// Falling with the threshold, and never above those of a hit. \param first, last of one layer
void order(std::vector<AssetExceedance>& all, std::size_t first, std::size_t last,
           std::size_t asset, const AssetRisk& r) {
  if (std::isnan(r.probability)) return;
  const auto fall = [&](auto part, double most) {
    std::vector<double> values;
    for (std::size_t i = last; i-- > first;) values.push_back(part(all[i].of[asset]));
    make_rising(values);
    for (std::size_t i = last; i-- > first;)
      part(all[i].of[asset]) = std::min(values[last - 1 - i], most);
  };
  fall([](ShareEstimate& s) -> double& { return s.share; }, r.probability);
  fall([](ShareEstimate& s) -> double& { return s.bounds_90.low; }, r.bounds_90.lower);
  fall([](ShareEstimate& s) -> double& { return s.bounds_90.high; }, r.bounds_90.upper);
}

/// "thickness" of "peak_thickness".
std::string word_of(PeakLayer layer) {
  const std::string name = info(layer).name;
  return name.starts_with("peak_") ? name.substr(5) : name;
}

/// "pressure_gt_30_kpa", "speed_gt_0_5_m_s".
std::string column_name(const AssetExceedance& e) {
  std::string unit;
  for (const char c : std::string_view(map_unit(e.layer).name)) {
    if (c == '-' || c == '1') continue;  // "m s-1", "kJ m-2": as other columns have them
    unit += c == ' ' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  std::string threshold = fmt::format("{:g}", e.threshold);
  std::replace(threshold.begin(), threshold.end(), '.', '_');
  return fmt::format("{}_gt_{}_{}", word_of(e.layer), threshold, unit);
}

bool is_of_plain_alone(const std::string& column) {
  return std::any_of(std::begin(plain_parts), std::end(plain_parts),
                     [&](const char* part) { return column.find(part) != std::string::npos; });
}

}  // namespace

LevelledRisk assess_levels(const Assets& assets, std::span<const AssetHits> levels,
                           std::span<const LevelDraw> draws, std::vector<AssetExceedance> wanted) {
  LevelledRisk out;
  out.n_levels = levels.size();
  out.exceedances = std::move(wanted);
  DrawsAtAssets at(levels, draws);
  if (levels.size() == 1) out.table = assess_assets(assets, levels.front());
  for (std::size_t a = 0; a < assets.list.size(); ++a) {
    at.look_at(a);
    if (levels.size() > 1) {
      out.table.rows.push_back(risk_of(assets, assets.list[a], at, levels.size()));
      out.table.n_without_loss += std::isnan(out.table.rows.back().loss.mean) ? 1 : 0;
    }
    const AssetRisk& r = out.table.rows[a];
    for (AssetExceedance& e : out.exceedances)
      e.of.push_back(std::isnan(r.probability)
                         ? ShareEstimate{}
                         : at.share_above(at.values([&](const AssetHit& h) {
                             return static_cast<double>(h.peak(e.layer)) * map_unit(e.layer).per_si;
                           }),
                                          e.threshold));
    for (std::size_t first = 0, last = 0; first < out.exceedances.size(); first = last) {
      while (last < out.exceedances.size() &&
             out.exceedances[last].layer == out.exceedances[first].layer)
        ++last;
      order(out.exceedances, first, last, a, r);
    }
  }
  if (levels.size() > 1)
    out.table.total_loss = total_loss(assets, out.table, draws, at, levels.size());
  return out;
}

FeatureTable levelled_features(const Assets& assets, const LevelledRisk& risk,
                               const std::string& crs_wkt) {
  FeatureTable out = risk_features(assets, risk.table, crs_wkt);
  const bool several = risk.n_levels > 1;
  if (several)
    std::erase_if(out.columns, [](const FeatureColumn& c) { return is_of_plain_alone(c.name); });
  const auto add = [&](const std::string& name, const AssetExceedance& e, auto get) {
    std::vector<double> values;
    for (const ShareEstimate& s : e.of) values.push_back(get(s));
    out.columns.push_back({name, std::move(values)});
  };
  for (const AssetExceedance& e : risk.exceedances) {
    const std::string name = column_name(e);
    add(name, e, [](const ShareEstimate& s) { return s.share; });
    add(name + "_lower_90", e, [](const ShareEstimate& s) { return s.bounds_90.low; });
    add(name + "_upper_90", e, [](const ShareEstimate& s) { return s.bounds_90.high; });
  }
  out.columns.push_back(
      {"estimator", std::vector<std::string>(out.size(), several ? "multilevel" : "plain")});
  return out;
}

std::string exceedance_text(const AssetExceedance& e) {
  return fmt::format("{} > {:g} {}", word_of(e.layer), e.threshold, map_unit(e.layer).name);
}

}  // namespace sturz
