// SPDX-License-Identifier: Apache-2.0
/// What ends long work from outside: a signal, the time of day, a stop file, a full disk, memory.
#pragma once

#include "scenarios/batch/day_window.hpp"

#include <atomic>
#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace sturz::workflow {

enum class StopCause { none, interrupted, window, stop_file, disk, memory };

struct StopReason {
  StopCause cause = StopCause::none;
  std::string text;  ///< a sentence without its full stop
  explicit operator bool() const { return cause != StopCause::none; }
};

struct GuardLimits {
  std::optional<DayWindow> between;
  std::filesystem::path stop_file;  ///< empty: none
  std::filesystem::path disk;       ///< a folder on the disk that is watched
  double min_free_disk_bytes = 0;   ///< 0: no limit
  double max_memory_bytes = 0;      ///< that this process may hold; 0: no limit
};

/// Looks from a thread of its own: at the caller's flag twenty times a second, at the rest once.
class Guard {
 public:
  /// \param interrupt outlives it
  Guard(GuardLimits, const std::atomic<bool>& interrupt);
  Guard(const Guard&) = delete;
  Guard& operator=(const Guard&) = delete;
  ~Guard();

  /// For the work: raised as soon as there is a reason, until clear().
  const std::atomic<bool>& flag() const { return flag_; }
  /// Looks now. The first reason is kept until clear().
  StopReason look();
  void clear();
  /// Minutes until the window opens; 0 while it is open, or where there is none.
  int minutes_to_wait() const;
  const GuardLimits& limits() const { return limits_; }

 private:
  StopReason slow_reasons() const;
  void watch(const std::stop_token& over);

  GuardLimits limits_;
  const std::atomic<bool>& interrupt_;
  std::atomic<bool> flag_{false};
  std::mutex lock_;
  StopReason reason_;
  std::condition_variable_any wake_;
  std::jthread watcher_;
};

/// Bytes that this user may still write there, or where the folder would lie; infinite when the
/// system does not say.
double free_disk_bytes(const std::filesystem::path&);

}  // namespace sturz::workflow
