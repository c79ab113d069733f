// SPDX-License-Identifier: Apache-2.0
/// Where finished members go: a file for each, or packs of thousands.
#pragma once

#include "engine/simulation/member_result.hpp"
#include "io/members/member_origin.hpp"
#include "io/members/packs/pack_writer.hpp"

#include <cstdint>
#include <filesystem>
#include <memory>

namespace sturz {

enum class MemberLayout { files, packs };

/// An ensemble of more members than this is kept in packs. A file of its own is what GIS and
/// scripts open at once; beyond some thousands, folders become slow to list and file systems run
/// out of inodes (ADR 0052).
inline constexpr std::int64_t most_member_files = 4096;

/// A folder keeps the way that it began with: packs where one is there, else files where one is
/// there; an empty one gets packs above most_member_files. \param planned members of the ensemble
MemberLayout layout_of(const std::filesystem::path& folder, std::int64_t planned);

/// One per process and folder; one call at a time.
class MemberWriter {
 public:
  virtual ~MemberWriter() = default;
  /// Keeps a member, whole or not at all. \throws IoError
  virtual void write(const MemberResult&, const MemberOrigin&) = 0;
  /// What was kept survives a power cut from now on. \throws IoError
  virtual void sync() = 0;
};

/// Nothing is made before the first member. \param shard k and n of those that this process
/// computes
std::unique_ptr<MemberWriter> member_writer(const std::filesystem::path& folder, MemberLayout,
                                            PackName shard = {});

}  // namespace sturz
