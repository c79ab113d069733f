// SPDX-License-Identifier: Apache-2.0
/// How much two ensembles differ at each asset.
#pragma once

#include "ensemble/assets/asset_risk.hpp"
#include "ensemble/comparison/member_pairs.hpp"
#include "ensemble/comparison/paired_difference.hpp"

#include <string>
#include <vector>

namespace sturz {

struct AssetDifference {
  AssetPlace place = AssetPlace::inside;  ///< outside: nothing below is known
  double probability_a = nan_d, probability_b = nan_d;
  DifferenceBounds paired{nan_d, nan_d, nan_d};    ///< P(B) - P(A); NaN without pairs
  DifferenceBounds unpaired{nan_d, nan_d, nan_d};  ///< of the same members as if they were none;
                                                   ///< without pairs of all
  ExpectedValue loss;    ///< expected loss of B less that of A, by one event, with the standard
                         ///< error of the mean over pairs; without pairs of both means
  bool cut_off = false;  ///< members that were cut off may make it more or less
};

/// One row per asset. \param a, b of the same assets
std::vector<AssetDifference> asset_differences(const Assets&, const MemberPairs&,
                                               const AssetHits& a, const AssetHits& b);

/// The rows with names and geometries, ready to be written.
FeatureTable difference_features(const Assets&, const std::vector<AssetDifference>&,
                                 const std::string& crs_wkt);

}  // namespace sturz
