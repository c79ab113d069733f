// SPDX-License-Identifier: Apache-2.0
/// Appends finished members to the packs of one shard.
///
/// One process writes a pack at a time: it holds a lock on the file (flock), and who finds one
/// locked takes the next number. A program that is killed leaves whole records and perhaps a piece
/// of one at the end; the next writer of the pack cuts that off. Bytes reach the disk every few
/// seconds and at the end: a killed program loses nothing that was stored, a power cut at most the
/// members of the last seconds, which are found damaged or missing and computed again.
#pragma once

#include "engine/simulation/member_result.hpp"
#include "io/members/member_origin.hpp"
#include "io/members/packs/pack_file.hpp"

#include <chrono>
#include <cstdint>
#include <filesystem>

namespace sturz {

class PackWriter {
 public:
  /// A pack that is longer is followed by the next.
  static constexpr std::uint64_t most_bytes = std::uint64_t{1} << 30;
  static constexpr std::chrono::seconds sync_every{5};

  /// Nothing is opened or made before the first member. \param shard its k and n
  PackWriter(std::filesystem::path folder, PackName shard,
             std::uint64_t most_bytes_of_one = most_bytes);
  /// The last members go to the disk.
  ~PackWriter();
  PackWriter(const PackWriter&) = delete;
  PackWriter& operator=(const PackWriter&) = delete;

  /// Whole or not at all. \throws IoError; what was there before is unharmed
  void append(const MemberResult&, const MemberOrigin&);
  /// \throws IoError
  void sync();

 private:
  void open_next();
  bool open_this();
  void close();
  [[noreturn]] void fail(const char* what, int code) const;

  std::filesystem::path folder_, path_;
  PackName name_;
  std::uint64_t most_bytes_;
  int descriptor_ = -1;
  std::uint64_t end_ = 0;
  bool dirty_ = false;
  std::chrono::steady_clock::time_point synced_{};
};

}  // namespace sturz
