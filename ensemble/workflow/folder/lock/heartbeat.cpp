// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/folder/lock/heartbeat.hpp"

#include "ensemble/workflow/folder/lock_file.hpp"
#include "io/files/unfinished.hpp"

#include <fcntl.h>
#include <sys/stat.h>

#include <exception>
#include <iterator>

namespace sturz::workflow {

Heartbeat::~Heartbeat() {
  {
    const std::lock_guard guard(mutex_);
    ends_ = true;
  }
  wake_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void Heartbeat::keep(const std::filesystem::path& file, const std::string& token) {
  const std::lock_guard guard(mutex_);
  kept_[file] = token;
  if (!thread_.joinable()) thread_ = std::thread([this] { run(); });
}

void Heartbeat::leave(const std::filesystem::path& file) {
  const std::lock_guard guard(mutex_);
  kept_.erase(file);
}

/// Under the mutex: a lock that leave() has let go is touched no more.
void Heartbeat::beat() {
  for (auto kept = kept_.begin(); kept != kept_.end();) {
    bool ours = true;
    try {
      const auto holder = holder_in(kept->first);
      ours = holder && holder->token == kept->second;
    } catch (const std::exception&) {  // a disk that hiccups is asked again with the next beat
      ++kept;
      continue;
    }
    if (ours) {
      ::utimensat(AT_FDCWD, kept->first.c_str(), nullptr, 0);  // the file server's own clock
    } else {
      forget_unfinished(kept->first);  // not ours to remove, however this process ends
      lost_.store(true);
    }
    kept = ours ? std::next(kept) : kept_.erase(kept);
  }
}

void Heartbeat::run() {
  std::unique_lock guard(mutex_);
  while (!wake_.wait_for(guard, period_, [this] { return ends_; })) beat();
}

}  // namespace sturz::workflow
