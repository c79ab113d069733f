// SPDX-License-Identifier: Apache-2.0
/// What each asset has to expect of one event.
///
/// Rules, also in the user guide:
///   probability  members that hit it / valid members, with score intervals (Wilson 1927)
///   cut off      a hit by a member that was cut off counts. One that was cut off before it hit may
///                still have come: the probability is then a lower bound, the lower end of its
///                interval counts it as no hit, the upper end as a hit, so that the interval holds
///                whatever it would have done
///   quantiles    5, 50 and 95 % among the members that hit, of the largest over the cells that the
///                asset touches; linear between order statistics (Hyndman and Fan 1996, definition
///                7)
///   damage       of the asset's curve at the intensity of each member, 0 where it did not hit; its
///                mean over all valid members, with the standard error s / sqrt(n). Curves never
///                fall, so cut off members leave a lower bound
/// Every number is a function of the set of members, in the order of their numbers.
#pragma once

#include "ensemble/assets/asset_hits.hpp"
#include "ensemble/hazard/wilson.hpp"
#include "scenarios/assets/assets.hpp"
#include "scenarios/layers/feature_table.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace sturz {

/// A mean over members and its Monte Carlo standard error; NaN: not known, of a single member only
/// the error.
struct ExpectedValue {
  double mean = nan_d, standard_error = nan_d;
};

/// Mean and error over `n` members, of which those that are not listed have 0.
ExpectedValue expected_value(const std::vector<double>& not_zero, std::size_t n);

/// At 5, 50 and 95 %.
using HitQuantiles = std::array<double, 3>;
inline constexpr std::array<double, 3> hit_quantile_levels{0.05, 0.5, 0.95};

struct AssetRisk {
  AssetPlace place = AssetPlace::inside;  ///< outside: nothing below is known
  std::int64_t valid = 0, hit = 0;
  std::int64_t hit_cut_off = 0;  ///< of `hit`, members that were cut off afterwards
  std::int64_t not_known = 0;    ///< members that were cut off before they hit
  double probability = nan_d;
  ProbabilityBounds bounds_90{nan_d, nan_d}, bounds_95{nan_d, nan_d};
  HitQuantiles arrival_s{nan_d, nan_d, nan_d}, thickness_m = arrival_s, speed_m_s = arrival_s,
                                               pressure_kpa = arrival_s;  ///< NaN where none hit
  ExpectedValue damage;  ///< share of the value; NaN without curves
  ExpectedValue loss;    ///< in Assets::value_unit; NaN without curve or value
  /// Which of these are lower bounds because members were cut off, in words; mostly empty.
  std::string cut_off;
};

struct RiskTable {
  std::vector<AssetRisk> rows;     ///< in the order of the assets
  ExpectedValue total_loss;        ///< of all assets whose loss is known; NaN where none is
  std::size_t n_without_loss = 0;  ///< that it leaves out: outside, without curve or value
};

RiskTable assess_assets(const Assets&, const AssetHits&);

/// The rows with names and geometries, ready to be written. Units end the columns' names:
/// name, place, [class], [value_UNIT], valid_members, hit_members, not_known_members,
/// hit_cut_off_members, probability, probability_lower_90 ..., thickness_q05_m ...,
/// [expected_damage, ..._standard_error], [expected_loss_UNIT, ...], cut_off
FeatureTable risk_features(const Assets&, const RiskTable&, const std::string& crs_wkt);

/// "inside", "partly outside", "outside".
const char* to_string(AssetPlace);

}  // namespace sturz
