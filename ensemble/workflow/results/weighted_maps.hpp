// SPDX-License-Identifier: Apache-2.0
/// The maps of a finished ensemble under the posterior that a calibration found, without new
/// members: its members with their importance weights.
#pragma once

#include "ensemble/workflow/results/merge.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace sturz::workflow {

struct WeightedMapsMade {
  OutputFolder folder;  ///< DIR/weighted, with hazard.nc, hazard/ and report.html
  std::int64_t valid = 0;
  double effective_members = 0;
  std::string hazard_hash;
  std::vector<std::string> warnings;  ///< whole sentences
};

/// Writes DIR/weighted; the ensemble's own maps stay as they are.
/// \param posterior folder of a calibration that weighed these very members
/// \throws SetupError when it did not, or as merge_members(); Cancelled
WeightedMapsMade make_weighted_maps(const MergeRequest&, const std::filesystem::path& posterior,
                                    Observer&, CancelFlag cancel = {});

}  // namespace sturz::workflow
