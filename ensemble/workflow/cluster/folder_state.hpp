// SPDX-License-Identifier: Apache-2.0
/// How far a results folder is, while others compute in it: nothing is locked or written.
#pragma once

#include "engine/core/cancel.hpp"
#include "ensemble/workflow/cluster/shard_layout.hpp"
#include "ensemble/workflow/folder/lock_file.hpp"
#include "ensemble/workflow/folder/manifest.hpp"
#include "ensemble/workflow/folder/output_folder.hpp"
#include "ensemble/workflow/folder/shard.hpp"
#include "io/members/member_store.hpp"

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace sturz::workflow {

/// A process that computes, or has left its lock.
struct Worker {
  Shard shard;  ///< n = 1: all members
  LockHolder holder;
  double silent_s = 0;  ///< since its last beat, by this machine's clock
  bool gone = false;
};

enum class MapsState {
  none,
  older,     ///< of other members than are there now
  partial,   ///< of all members that are there; some are missing
  complete,  ///< of all members
};
const char* to_string(MapsState);

struct FolderState {
  OutputFolder folder;
  Manifest manifest;
  std::int64_t planned = 0;
  std::vector<ShardState> shards;
  std::vector<Worker> workers;
  MapsState maps = MapsState::none;
  std::shared_ptr<const MemberStore> store;
  std::int64_t recent_members = 0;  ///< of which the pace is told
  double recent_member_s = 0;       ///< their mean computing time; 0: none is

  std::span<const MemberSummary> members() const { return store->members(); }
  std::int64_t finished() const { return static_cast<std::int64_t>(members().size()); }
  std::int64_t missing() const { return planned - finished(); }
  /// Mean computing time of the members that were finished last, some rounds of them [s]; 0: none
  /// is. Longest ones come first, and machines are busier at one time than at another: the mean of
  /// all would tell of what is over.
  double member_s() const { return recent_member_s; }
  /// Members that the living workers compute at a time.
  int at_a_time() const;
  /// Until all members are there, at this pace; NaN when nothing is known of it [s].
  double remaining_s() const;
};

/// \param shards into which the members are divided; 0: as the folder says
/// \throws SetupError when it holds no ensemble; Cancelled
FolderState folder_state(const OutputFolder&, int shards, CancelFlag cancel = {});

}  // namespace sturz::workflow
