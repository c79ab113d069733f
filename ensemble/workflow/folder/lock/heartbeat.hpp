// SPDX-License-Identifier: Apache-2.0
/// Shows other machines that a lock's process lives: its file is touched again and again.
///
/// A touch changes the time of the file alone, never its text: a lock that was taken over meanwhile
/// stays what it is, and is known as lost from the next beat on.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <thread>

namespace sturz::workflow {

class Heartbeat {
 public:
  explicit Heartbeat(std::chrono::milliseconds period) : period_(period) {}
  ~Heartbeat();
  Heartbeat(const Heartbeat&) = delete;
  Heartbeat& operator=(const Heartbeat&) = delete;

  /// Keeps the lock with that token alive from now on. From any thread.
  void keep(const std::filesystem::path& file, const std::string& token);
  void leave(const std::filesystem::path& file);
  /// A lock that was to be kept is there no longer, or of another process.
  bool lost() const { return lost_.load(); }

 private:
  void beat();
  void run();

  const std::chrono::milliseconds period_;
  std::atomic<bool> lost_{false};
  std::mutex mutex_;  ///< of what follows
  std::condition_variable wake_;
  bool ends_ = false;
  std::map<std::filesystem::path, std::string> kept_;  ///< file -> token
  std::thread thread_;                                 ///< begun with the first lock
};

}  // namespace sturz::workflow
