// SPDX-License-Identifier: Apache-2.0
/// Maps of an ensemble whose members were computed elsewhere or earlier.
#pragma once

#include "ensemble/workflow/folder/finished_folder.hpp"
#include "ensemble/workflow/folder/folder_lock.hpp"
#include "ensemble/workflow/observer.hpp"
#include "ensemble/workflow/results/maps.hpp"

#include <filesystem>
#include <memory>

namespace sturz::workflow {

struct MergeRequest {
  std::filesystem::path folder;  ///< of an ensemble, whole or in shards
  bool partial = false;          ///< maps from the members that are there
};

/// A folder whose members are there and may be mapped.
struct MergeInput {
  FinishedFolder finished;
  std::shared_ptr<FolderLock> lock;  ///< the folder is ours while this lives
  DesignTable design;
  MemberStore store;
};
/// Checks of merge_members(). \throws SetupError as there; Cancelled
MergeInput open_for_maps(const MergeRequest&, Observer&, CancelFlag cancel = {});

/// Maps from the members that shards have left in a folder. Warns of damaged and missing members.
/// \throws SetupError when the folder holds no ensemble, no member, or not all without `partial`;
///   Cancelled
MapsMade merge_members(const MergeRequest&, Observer&, CancelFlag cancel = {});

}  // namespace sturz::workflow
