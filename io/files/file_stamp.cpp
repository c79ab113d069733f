// SPDX-License-Identifier: Apache-2.0
#include "io/files/file_stamp.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <chrono>

namespace sturz {
namespace {

std::int64_t ns_of(const timespec& t) {
  return static_cast<std::int64_t>(t.tv_sec) * 1'000'000'000 + t.tv_nsec;
}

}  // namespace

std::optional<FileStamp> stamp_of(const std::string& path) {
  struct stat about {};
  if (::stat(path.c_str(), &about) != 0 || !S_ISREG(about.st_mode)) return std::nullopt;
  return FileStamp{path, static_cast<std::uint64_t>(about.st_size),
                   static_cast<std::uint64_t>(about.st_ino), ns_of(about.st_mtim),
                   ns_of(about.st_ctim)};
}

bool is_fresh(const FileStamp& stamp, std::int64_t now) {
  constexpr std::int64_t coarsest_ns = 2'000'000'000;  // FAT
  return now - std::max(stamp.written_ns, stamp.changed_ns) < coarsest_ns;
}

std::int64_t now_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

}  // namespace sturz
