// SPDX-License-Identifier: Apache-2.0
/// A file that appears whole or not at all, whatever happens to the process or the disk.
///
///   NAME.<unique>.part  --write, fsync-->  --rename-->  NAME  --fsync of the folder-->
///
/// Every format of this folder is made in memory and goes to disk through this one door, so a full
/// disk gives the same message everywhere and never leaves half a file under the final name. The
/// unique part of the name lets two processes that compute the same member write side by side.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

namespace sturz {

class AtomicFile {
 public:
  /// Opens the part file beside `target`, which may exist and then stays until commit().
  /// \throws IoError if the folder is missing or closed, or `target` is not a regular file
  explicit AtomicFile(const std::filesystem::path& target);
  /// Removes the part file unless committed.
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  const std::filesystem::path& part() const { return part_; }
  /// Appends. \throws IoError with the reason and the free space
  void write(std::span<const std::byte> bytes);
  /// Makes the content durable and gives it its name. \throws IoError
  void commit();
  /// For those who write the part file by other means: says why in this class's words.
  /// \param code errno, 0: not known
  [[noreturn]] void fail(const char* what, int code) const;

 private:
  std::filesystem::path target_, part_;
  int descriptor_ = -1;
};

/// All of `bytes` as the new content of `target`. \throws IoError
void write_bytes_atomic(const std::filesystem::path& target, std::span<const std::byte> bytes);

/// What a system call said of a file, in words, with what the user can do about it.
/// \param what "cannot write" \param code errno, 0: not known
[[noreturn]] void fail_to_write(const char* what, const std::filesystem::path& target, int code);

/// Makes a folder's list of names durable, as far as its file system does that.
void sync_folder(const std::filesystem::path& folder);

/// Makes a folder with its parents; one that exists is fine. \throws IoError
void make_folder(const std::filesystem::path& folder);

/// Removes what writers that were killed have left in a folder (not in folders below it). To be
/// called only while no process writes there.
void remove_part_files(const std::filesystem::path& folder);

}  // namespace sturz
