// SPDX-License-Identifier: Apache-2.0
/// From the members of a folder to its maps, table and page.
#pragma once

#include "engine/core/error.hpp"
#include "engine/terrain/raster.hpp"
#include "ensemble/censoring/censoring_report.hpp"
#include "ensemble/sampling/design.hpp"
#include "ensemble/workflow/folder/manifest.hpp"
#include "ensemble/workflow/folder/output_folder.hpp"
#include "ensemble/workflow/members/ensemble_job.hpp"
#include "ensemble/workflow/observer.hpp"

#include <cstdint>
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

  std::int64_t failed() const { return finished - valid; }
  /// More of the finished members failed than the scenario accepts, or there are none.
  bool too_many_failed() const;
};

/// Members that were finished are not there (any more). The same command computes them.
class MembersMissing : public SetupError {
 public:
  using SetupError::SetupError;
};

/// What to do when members of the design are missing.
enum class Missing { refuse, accept };

/// Reads all member files, writes hazard.nc, hazard/*.tif, members.csv and report.html, and puts
/// the maps' hash into the manifest, which is saved.
/// \param elevation for the page's relief; may be null
/// \throws SetupError; MembersMissing before anything is written; IoError when the disk refuses
///   (members are not touched)
MapsMade make_maps(const OutputFolder&, Manifest&, const Scenario&, const DesignTable&,
                   const Raster<double>* elevation, Observer&, Missing = Missing::refuse);

/// The same at the end of an ensemble, whose computing time so far goes into the manifest.
MapsMade make_maps(EnsembleJob&, Observer&);

}  // namespace sturz::workflow
