// SPDX-License-Identifier: Apache-2.0
/// From the members of a folder to its maps, table and page.
#pragma once

#include "engine/core/cancel.hpp"
#include "engine/core/error.hpp"
#include "ensemble/censoring/censoring_report.hpp"
#include "ensemble/sampling/design.hpp"
#include "ensemble/scores/score_table.hpp"
#include "ensemble/workflow/folder/manifest.hpp"
#include "ensemble/workflow/folder/output_folder.hpp"
#include "ensemble/workflow/members/ensemble_job.hpp"
#include "ensemble/workflow/observer.hpp"
#include "io/members/member_store.hpp"
#include "scenarios/scene_inputs.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sturz::workflow {

/// How complete the maps are, and what identifies them.
struct MapsMade {
  OutputFolder folder;
  std::int64_t planned = 0, finished = 0, valid = 0;
  CensoringReport censoring;            ///< which members are cut off
  std::vector<MemberWarning> warnings;  ///< of the members' own, those that `describe` did not give
  std::int64_t warned_members = 0;      ///< members with a warning of their own
  double max_failed_fraction = 0;       ///< ensemble.max_failed_fraction of the scenario
  double seconds = 0;                   ///< of making them
  std::string hazard_hash;              ///< of every value of the maps
  std::optional<StopRecord> stop;       ///< what decided the number of members, as the manifest
  std::optional<ScoreTable> scores;     ///< where something was observed
  std::vector<std::int64_t> numbers;    ///< of the members, in the order of the scores' rows

  std::int64_t failed() const { return finished - valid; }
  /// More of the finished members failed than the scenario accepts, or there are none.
  bool too_many_failed() const;
};

/// Members that were finished are not there (any more). The same command computes them.
class MembersMissing : public SetupError {
 public:
  using SetupError::SetupError;
};

/// Whose maps, and where they go.
struct MapsRequest {
  const OutputFolder& folder;
  Manifest& manifest;  ///< gets the maps' hash and is saved
  const Scenario& scenario;
  const DesignTable& design;
  const SceneInputs& inputs;    ///< for where the ground is known, and the page's relief
  double max_memory_bytes = 0;  ///< of the whole process; 0: what is free
};

/// Scores the members where something was observed, reads their maps, writes members.csv, the
/// table of assets, hazard.nc, hazard/*.tif with their styles and list, and report.html. Memory
/// holds a few hundred MB whatever the size of terrain and ensemble. When it is cancelled or fails,
/// the manifest has no hash until all files belong together again. \throws SetupError; IoError when
/// the disk refuses (members are not touched); Cancelled
MapsMade make_maps(const MapsRequest&, const MemberStore&, Observer&, CancelFlag cancel = {});

/// The same at the end of an ensemble, whose computing time so far goes into the manifest.
/// \throws MembersMissing before anything is written
MapsMade make_maps(EnsembleJob&, Observer&, CancelFlag cancel = {});

}  // namespace sturz::workflow
