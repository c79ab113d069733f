// SPDX-License-Identifier: Apache-2.0
/// Packs: files that hold thousands of members, one record behind the other (pack_record.hpp).
#pragma once

#include "io/members/packs/pack_record.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace sturz {

/// Whose members a pack holds: those of shard k of n, and which of its packs it is.
struct PackName {
  int k = 1, n = 1, number = 1;
  auto operator<=>(const PackName&) const = default;
};
/// "3_of_1000.001.pack"
std::string pack_file_name(const PackName&);
/// Nothing for a name that pack_file_name does not make.
std::optional<PackName> pack_named(const std::filesystem::path& file);
/// In ascending order of their names' numbers.
std::vector<std::filesystem::path> packs_in(const std::filesystem::path& folder);

/// An open pack.
class PackFile {
 public:
  /// \throws IoError when it cannot be opened
  explicit PackFile(std::filesystem::path path);
  ~PackFile();
  PackFile(PackFile&& other) noexcept
      : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)) {}
  PackFile& operator=(PackFile&&) = delete;
  PackFile(const PackFile&) = delete;
  PackFile& operator=(const PackFile&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::uint64_t size() const;
  /// All of `out`; from any thread. \throws IoError when there are fewer bytes
  void read(std::uint64_t offset, std::span<std::byte> out) const;
  /// "1_of_1.001.pack, member 17 at byte 8128": how messages name a record.
  std::string record_name(std::int64_t member, std::uint64_t offset) const;

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
};

/// What a look through a pack finds, in its order.
struct PackVisitor {
  /// A record whose head and tail are sound. Its content is not looked at.
  std::function<void(const RecordHead&, std::uint64_t offset)> record;
  /// Bytes that are no whole record: damaged, or what a program left that was killed.
  /// \param member whose they were, where that can be told
  std::function<void(std::optional<std::int64_t> member, std::uint64_t offset,
                     std::uint64_t n_bytes)>
      damage;
};

/// \return where the last whole record ends: what follows is to be overwritten
std::uint64_t look_through(const PackFile&, const PackVisitor&);

}  // namespace sturz
