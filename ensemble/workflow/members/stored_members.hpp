// SPDX-License-Identifier: Apache-2.0
/// The members of a folder as its files hold them, of whatever scene: listed, or taken out of
/// packs.
#pragma once

#include "engine/core/cancel.hpp"
#include "ensemble/workflow/observer.hpp"
#include "io/members/member_store.hpp"

#include <cstdint>
#include <filesystem>
#include <utility>
#include <vector>

namespace sturz::workflow {

struct StoredMembers {
  std::int64_t n_members = 0, n_failed = 0;  ///< failed: not valid
  std::int64_t n_files = 0;                  ///< members in files of their own
  std::int64_t n_damaged = 0;                ///< files and records that cannot be read
  /// Members that are taken from each pack.
  std::vector<std::pair<std::filesystem::path, std::int64_t>> packs;
};

/// All members of a folder. Warns of what is damaged.
/// \throws SetupError when the folder holds no members; Cancelled
MemberStore open_members(const std::filesystem::path& folder, Observer&, CancelFlag cancel = {});

/// Warns of what is damaged. \throws SetupError when the folder holds no members; Cancelled
StoredMembers stored_members(const std::filesystem::path& folder, Observer&,
                             CancelFlag cancel = {});

/// Both ends included.
struct MemberRange {
  std::int64_t first = 0, last = 0;
};
struct ExtractRequest {
  std::filesystem::path folder;
  std::vector<MemberRange> members;
  std::filesystem::path out;  ///< empty: a folder `extracted` in `folder`
};

/// Writes members as netCDF files of their own, byte for byte what a folder without packs holds.
/// \return the files \throws SetupError naming a member that is not there; IoError; Cancelled
std::vector<std::filesystem::path> extract_members(const ExtractRequest&, Observer&,
                                                   CancelFlag cancel = {});

}  // namespace sturz::workflow
