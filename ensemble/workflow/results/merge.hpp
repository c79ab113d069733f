// SPDX-License-Identifier: Apache-2.0
/// Maps of an ensemble whose members were computed elsewhere or earlier.
#pragma once

#include "ensemble/workflow/observer.hpp"
#include "ensemble/workflow/results/maps.hpp"

#include <filesystem>

namespace sturz::workflow {

struct MergeRequest {
  std::filesystem::path folder;  ///< of an ensemble, whole or in shards
  bool partial = false;          ///< maps from the members that are there
};

/// Maps from the members that shards have left in a folder. Warns of damaged and missing members.
/// \throws SetupError when the folder holds no ensemble, no member, or not all without `partial`;
///   Cancelled
MapsMade merge_members(const MergeRequest&, Observer&, CancelFlag cancel = {});

}  // namespace sturz::workflow
