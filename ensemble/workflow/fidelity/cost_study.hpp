// SPDX-License-Identifier: Apache-2.0
/// What accuracy costs: one scene, the same draws, several formulations and spacings.
#pragma once

#include "ensemble/fidelity/choice.hpp"
#include "ensemble/fidelity/ladder.hpp"
#include "ensemble/fidelity/multilevel_gain.hpp"
#include "ensemble/workflow/members/ensemble_job.hpp"
#include "ensemble/workflow/observer.hpp"

#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

namespace sturz::workflow {

struct CostRequest {
  SceneRequest scene;
  std::filesystem::path folder;    ///< of the study; begun ensembles in it go on
  int members = 0;                 ///< at each spacing; 0: 16
  int workers = 0;                 ///< members at a time; 0: all cores available to the process
  std::vector<double> spacings_m;  ///< any order; empty: 2, 1.5 and 1 times the scene's
  std::vector<std::string> formulations;  ///< empty: the one that the scene is computed in
  /// "key=value": the scene with that change, at the middle spacing of the first formulation.
  std::vector<std::string> variants;
  std::vector<std::string> results;  ///< of scalar_table(), looked at besides the usual ones
  double check_m = 0;   ///< a finer spacing that no estimate may know, to check them by; 0: none
  std::string command;  ///< how the user asked for it
};

/// One ensemble of the study.
struct CostPart {
  std::string name;         ///< of its folder: "depth_averaged_8m"
  std::string formulation;  ///< as asked for
  double spacing_m = 0;
  std::string variant;     ///< empty: a rung of the ladder
  bool displaced = false;  ///< a rung again, with uncertain values displaced by next to nothing
  bool held_out = false;   ///< finer than all rungs; estimates are checked by it
};

/// Results of a variant beside the rung that it changes.
struct VariantCost {
  std::string variant, formulation;
  double spacing_m = 0, seconds_ratio = nan_d;
  std::vector<Change> changes;
};

/// How far two formulations lie apart at their finest, with the same values: no sampling and no
/// spacing removes it.
struct ModelDifference {
  std::string from, to;
  std::vector<Change> changes;
};

/// What an estimate would save that corrects many cheap members by few of the dearest rung.
struct MultilevelForecast {
  std::vector<std::string> levels;   ///< names of the parts, the dearest rung first
  std::vector<double> cost_s;        ///< [levels] seconds of a member
  std::vector<std::string> results;  ///< and `map`
  std::vector<std::vector<double>> squared_correlations;  ///< [results][levels] with the first
  MultilevelGain gain;                                    ///< its levels are indices into these
};

struct CostStudy {
  std::string title;  ///< of the scene
  std::filesystem::path folder;
  std::vector<CostPart> parts;
  std::vector<LadderAccuracy> ladders;  ///< one per formulation
  std::vector<VariantCost> variants;
  std::vector<ModelDifference> models;  ///< each pair of formulations
  /// For run-out, area and centre of mass together, and for the map; without what under eight
  /// members tell.
  std::vector<MultilevelForecast> multilevel;
  /// ensemble.members of the scenario; where it gives none, the members at each spacing.
  int planned_members = 0;
  bool planned_given = true;          ///< by the scenario
  int members = 0;                    ///< at each spacing
  std::vector<std::string> warnings;  ///< of the scenes, with the parts that they are of
};

/// The ensembles of a study, begun and not computed. Everything that can be wrong with one of them
/// is found here.
struct CostJob {
  CostRequest request;
  std::vector<CostPart> parts;
  std::vector<EnsembleJob> jobs;  ///< one per part
  int planned_members = 0;        ///< ensemble.members; 0: not given
};

/// \throws SetupError also for spacings or formulations that the scene cannot have, naming them
CostJob prepare_cost(const CostRequest&, Observer&);

/// Computes what is not finished, the coarsest first, and looks at all. Members lie in
/// folder/NAME/ as those of `sturz ensemble` do, without maps; cost.json and cost.csv beside them.
/// \throws Cancelled with all finished members kept; SetupError when a spacing has no valid member
CostStudy compute_cost(const CostJob&, Observer&, const std::atomic<bool>& cancel);

}  // namespace sturz::workflow
