// SPDX-License-Identifier: Apache-2.0
/// What a multilevel ensemble says: headlines with three numbers each, maps with bounds, and what
/// each level brought and took.
#pragma once

#include "ensemble/assets/asset_levels.hpp"
#include "ensemble/censoring/censoring_report.hpp"
#include "ensemble/workflow/multilevel/estimates.hpp"
#include "ensemble/workflow/multilevel/multilevel_run.hpp"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace sturz::workflow {

/// One number of all members. Errors are in its unit.
struct MultilevelHeadline {
  std::string name, units;
  MultilevelScalar scalar;                  ///< over the used levels
  std::vector<QuantileEstimate> quantiles;  ///< at hazard.quantiles
  double sampling = nan_d;                  ///< half width of the 90 % bounds of the mean
  /// Estimated distance of the mean at this spacing from that at ever finer ones, from the levels
  /// of the same formulation; NaN: there is only one.
  double resolution = nan_d;
  /// Largest difference to another formulation with the same draws, each at its finest here: what
  /// the two spacings differ by is part of it. NaN: there is none.
  double model = nan_d, model_error = nan_d;  ///< and its standard error
  std::string model_of;                       ///< the level it is a difference to
  double plain_seconds = nan_d;               ///< CPU, of plain sampling for the same error
  std::int64_t left_out = 0;  ///< members of the dearest level whose end does not tell it
};

/// What one level brought.
struct LevelShare {
  std::string name;
  std::int64_t members = 0, valid = 0;
  double member_cpu_s = nan_d, seconds = nan_d;
  bool used = false;
  CensoringReport censoring;  ///< of the members that count
  /// Valid members that no estimate has, because a cheaper used level's member of the same draw
  /// failed: nothing foretells them, and the sum over the levels would count them twice.
  std::int64_t unpaired = 0;
  /// [headlines, and the map] of the estimate's variance.
  std::vector<double> variance_shares;
};

/// One probability map with its place among the layers' names.
struct NamedMap {
  std::string name;  ///< "probability_of_reach", "thickness_exceedance"
  PeakLayer layer = PeakLayer::arrival;
  std::vector<double> thresholds;   ///< in the scenario's units; empty: a plain map
  std::vector<MultilevelMap> maps;  ///< one per threshold
};

struct MultilevelMade {
  std::filesystem::path folder;
  std::string title;
  std::vector<PlanRound> rounds;
  std::vector<LevelPart> parts;
  int pilot = 0;                  ///< members of each level before the first round
  std::vector<std::size_t> used;  ///< of parts; {0}: plain sampling
  std::vector<MultilevelHeadline> headlines;
  std::vector<LevelShare> levels;
  std::vector<NamedMap> maps;            ///< empty where plain sampling was kept
  std::shared_ptr<const Assets> assets;  ///< null: the scene has none
  LevelledRisk risk;                     ///< of them
  std::size_t dear_draws = 0;            ///< of the dearest level, that maps are made of
  double map_error = nan_d;              ///< as ensemble.target.map_error, of P(reached)
  double map_plain_seconds = nan_d;      ///< CPU, of plain sampling for the same map_error
  double seconds = 0;                    ///< CPU of all members
  std::int64_t failed = 0;               ///< members of any level
  std::int64_t censored = 0;             ///< valid ones whose end was not seen
  /// As plain ensembles: of used levels of which more members than ensemble.max_censored_fraction
  /// are cut off, a sentence each. Every door says it first.
  std::vector<std::string> cut_off;
  std::vector<std::string> missed;  ///< of ensemble.target, a sentence each
  double max_failed_fraction = 1;   ///< of the scene
  std::vector<std::string> warnings;

  /// Of a level that is used, as ensemble.max_failed_fraction.
  bool too_many_failed() const;
};

/// \throws Cancelled
MultilevelMade look_at_members(const MultilevelJob&, const MultilevelMembers&, CancelFlag);

/// multilevel.json, hazard.nc and hazard/*.tif in the folder, with assets assets.csv and
/// assets.gpkg. With plain sampling the maps are those of the dearest level's ensemble. \throws
/// IoError; Cancelled
void write_multilevel_files(const MultilevelJob&, const MultilevelMembers&, const MultilevelMade&,
                            CancelFlag);
std::string multilevel_json_text(const MultilevelMade&);

}  // namespace sturz::workflow
