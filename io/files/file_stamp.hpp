// SPDX-License-Identifier: Apache-2.0
/// Whether a file may have changed since it was read, without reading it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace sturz {

/// What the file system says of a file; any write changes one of them.
struct FileStamp {
  std::string path;
  std::uint64_t bytes = 0, inode = 0;
  std::int64_t written_ns = 0, changed_ns = 0;  ///< mtime and ctime, since 1970
  bool operator==(const FileStamp&) const = default;
};

/// Nothing when there is no such regular file.
std::optional<FileStamp> stamp_of(const std::string& path);

/// Written so shortly before `now_ns` that a later write may leave the same stamp: clocks of file
/// systems are coarse.
bool is_fresh(const FileStamp&, std::int64_t now_ns);
/// Nanoseconds since 1970 by this machine's clock.
std::int64_t now_ns();

}  // namespace sturz
