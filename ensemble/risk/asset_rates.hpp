// SPDX-License-Identifier: Apache-2.0
/// What each asset has to expect by year.
#pragma once

#include "ensemble/assets/asset_risk.hpp"
#include "ensemble/risk/return_level.hpp"
#include "scenarios/risk/risk_spec.hpp"

#include <span>
#include <string>
#include <vector>

namespace sturz {

/// One scenario at all assets.
struct ScenarioAtAssets {
  AssetHits hits;
  RiskTable risk;
};

struct AssetRate {
  AssetPlace place = AssetPlace::inside;
  double rate = nan_d;        ///< of being hit [1/year]
  double rate_error = nan_d;  ///< its Monte Carlo standard error
  double most = nan_d;        ///< the rate if all members that were cut off before had hit it
  std::vector<double> thickness_m, speed_m_s,
      pressure_kpa;     ///< by return period, see return_levels
  ExpectedValue loss;   ///< by year; NaN: not known
  std::string cut_off;  ///< which of these are lower bounds, in words; mostly empty
};

struct RateTable {
  std::vector<AssetRate> rows;
  ExpectedValue total_loss;        ///< by year, of all assets whose loss is known
  std::size_t n_without_loss = 0;  ///< that it leaves out, of some scenario at least
};

/// Rates and losses add up over scenarios with their frequencies; standard errors as those of
/// independent ensembles. \pre one of `scenarios` for each of spec.scenarios, of the same assets,
/// with a valid member
RateTable assess_rates(const Assets&, const RiskSpec& spec,
                       std::span<const ScenarioAtAssets> scenarios);

/// The rows with names and geometries, ready to be written.
FeatureTable rate_features(const Assets&, const RiskSpec&, const RateTable&,
                           const std::string& crs_wkt);

}  // namespace sturz
