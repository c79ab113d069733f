// SPDX-License-Identifier: Apache-2.0
/// What each asset has to expect, from few members of the dearest level and many of cheaper ones.
///
/// Rules, also in the user guide:
///   probability  that a member of the dearest level hits it (find_hits()), and that the largest
///                over its cells exceeds a threshold of the maps, 0 where it is not hit: as maps
///                over several levels, with 90 % bounds. They fall with the threshold, and are
///                never above that of a hit
///   cut off      as plain ensembles: a member of the dearest level that was cut off before it
///                exceeded may still have done so; the upper end of the interval counts it as if
///   damage       mean over the members, with its standard error, held within 0 and 1
/// Quantiles among the members that hit are of plain ensembles alone.
#pragma once

#include "ensemble/assets/asset_risk.hpp"
#include "ensemble/fidelity/multilevel/level_draws.hpp"

#include <span>
#include <string>
#include <vector>

namespace sturz {

/// P(largest over an asset's cells > threshold).
struct AssetExceedance {
  PeakLayer layer = PeakLayer::thickness;  ///< thickness, speed, energy or pressure
  double threshold = 0;                    ///< in the unit of maps (map_unit())
  std::vector<ShareEstimate> of;           ///< [asset]; NaN where the asset lies outside
};

struct LevelledRisk {
  std::size_t n_levels = 1;
  /// Over several levels without quantiles and 95 % bounds; counts are of the dearest level. Of one
  /// level that of plain ensembles.
  RiskTable table;
  std::vector<AssetExceedance> exceedances;  ///< as they were asked for
};

/// \param levels hits of each, the dearest first \param draws of the same valid members
/// \param wanted `of` empty; of each layer together, thresholds rising
LevelledRisk assess_levels(const Assets&, std::span<const AssetHits> levels,
                           std::span<const LevelDraw> draws, std::vector<AssetExceedance> wanted);

/// As risk_features(), without the columns that are not known over several levels, with
/// pressure_gt_30_kpa, pressure_gt_30_kpa_lower_90 ... and `estimator` (multilevel or plain).
FeatureTable levelled_features(const Assets&, const LevelledRisk&, const std::string& crs_wkt);

/// "pressure > 30 kPa".
std::string exceedance_text(const AssetExceedance&);

}  // namespace sturz
