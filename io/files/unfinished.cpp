// SPDX-License-Identifier: Apache-2.0
#include "io/files/unfinished.hpp"

#include <unistd.h>

#include <chrono>
#include <mutex>
#include <set>
#include <string>
#include <thread>

namespace sturz {
namespace {

struct Register {
  std::mutex mutex;
  std::set<std::string> files;
};

/// Never destroyed: other threads may still write while the process ends.
Register& all() {
  static auto* one = new Register;
  return *one;
}

}  // namespace

void remember_unfinished(const std::filesystem::path& file) {
  const std::lock_guard guard(all().mutex);
  all().files.insert(file.string());
}

void forget_unfinished(const std::filesystem::path& file) {
  const std::lock_guard guard(all().mutex);
  all().files.erase(file.string());
}

void remove_unfinished() noexcept {
  constexpr int tries = 20;
  for (int i = 0; i < tries && !all().mutex.try_lock(); ++i) {
    if (i + 1 == tries) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  for (const std::string& file : all().files) ::unlink(file.c_str());
  all().mutex.unlock();
}

}  // namespace sturz
