// SPDX-License-Identifier: Apache-2.0
/// From the stored members of all sources to the region's maps, tables and page.
#pragma once

#include "engine/core/cancel.hpp"
#include "ensemble/workflow/observer.hpp"
#include "ensemble/workflow/region/region_job.hpp"
#include "ensemble/workflow/region/region_members.hpp"
#include "scenarios/layers/source_lists.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace sturz::workflow {

struct RegionMade {
  OutputFolder folder;
  std::size_t n_sources = 0, n_failed_sources = 0;
  std::string first_failure;                                       ///< "name: reason"
  std::int64_t planned = 0, finished = 0, valid = 0, cut_off = 0;  ///< members of all sources
  std::int64_t failed = 0;  ///< members that failed, those of failed sources among them
  double max_failed_fraction = 0;
  std::size_t reached_cells = 0;
  std::size_t most_sources = 0;  ///< at one cell
  double seconds = 0;            ///< of making the maps
  std::string hazard_hash;       ///< of every value of the maps and lists

  bool too_many_failed() const {
    return planned == 0 ||
           static_cast<double>(failed) > max_failed_fraction * static_cast<double>(planned);
  }
};

/// Writes hazard.nc, hazard/*.tif with styles, sources.csv and report.html at the region's root.
/// Memory follows the cells that members touched; it holds no field of the whole raster.
/// \throws MembersMissing before anything is written; SetupError; IoError; Cancelled
RegionMade make_region_results(RegionJob&, Observer&, CancelFlag cancel = {});

struct RegionMergeRequest {
  std::filesystem::path folder;
  bool partial = false;  ///< maps from the members that are there
};
/// The same from what shards have left. The features are those of today's layer, and the inputs of
/// each are held against what its members were computed from.
RegionMade merge_region(const RegionMergeRequest&, Observer&, CancelFlag cancel = {});

}  // namespace sturz::workflow
