// SPDX-License-Identifier: Apache-2.0
/// An ensemble as its shards see it: which of them lack members.
#pragma once

#include "engine/simulation/member_result.hpp"
#include "ensemble/workflow/folder/manifest.hpp"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace sturz::workflow {

/// How far one shard is.
struct ShardState {
  int k = 1;  ///< counted from 1
  std::int64_t members = 0, valid = 0, failed = 0;
  std::int64_t missing() const { return members - valid - failed; }
};

/// Of every shard of n. \param planned members of the design
std::vector<ShardState> shard_states(std::span<const MemberSummary>, std::int64_t planned, int n);

/// The numbers of those that lack members, ascending.
std::vector<int> missing_shards(std::span<const ShardState>);

/// "2,5,9-12": as schedulers and people write lists.
std::string ranges_text(std::span<const int> ascending);

/// How to compute what is missing, as sentences: the command that began the folder, for the first
/// missing shard, and the numbers of the others.
std::string how_to_resume(const Manifest&, const std::filesystem::path& folder,
                          std::span<const int> missing);

/// A word as a shell takes it: quoted where it must be.
std::string shell_word(const std::string&);

}  // namespace sturz::workflow
