// SPDX-License-Identifier: Apache-2.0
/// How long work that is no member (maps, page, reading of many files) is told to stop.
#pragma once

#include <atomic>
#include <exception>

namespace sturz {

/// Thrown by what was asked to stop, with nothing half-written left behind.
class Cancelled : public std::exception {
 public:
  const char* what() const noexcept override { return "interrupted"; }
};

/// A caller's flag, or none. Cheap to look at: work looks at least ten times a second.
class CancelFlag {
 public:
  CancelFlag() = default;
  CancelFlag(const std::atomic<bool>& flag) : flag_(&flag) {}  // NOLINT: as good as the flag itself

  bool raised() const { return flag_ != nullptr && flag_->load(std::memory_order_relaxed); }
  /// \throws Cancelled when the flag is raised
  void check() const {
    if (raised()) throw Cancelled();
  }

 private:
  const std::atomic<bool>* flag_ = nullptr;
};

}  // namespace sturz
