// SPDX-License-Identifier: Apache-2.0
/// A folder for what is measured and then thrown away.
#pragma once

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>

namespace sturz::workflow {

/// Its name is this process's alone; it is made by what is written into it, and goes away with the
/// scope.
class TemporaryFolder {
 public:
  /// \param in a folder; empty: that of temporary files
  explicit TemporaryFolder(const std::filesystem::path& in = {})
      : path_((in.empty() ? std::filesystem::temp_directory_path() : in) / name()) {}
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  static std::string name() {
    static std::atomic<int> count{0};
    return fmt::format("sturz_measure_{}_{}", ::getpid(), ++count);
  }

  std::filesystem::path path_;
};

}  // namespace sturz::workflow
