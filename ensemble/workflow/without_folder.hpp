// SPDX-License-Identifier: Apache-2.0
/// The listener of a whole, handed to its parts.
#pragma once

#include "ensemble/workflow/observer.hpp"

#include <cstdint>
#include <string_view>

namespace sturz::workflow {

/// Passes everything on but folders: the log of a part's folder is not the whole's log.
class WithoutFolder final : public Observer {
 public:
  explicit WithoutFolder(Observer& to) : to_(to) {}
  void warning(std::string_view text) override { to_.warning(text); }
  void ensemble_progress(const RunnerProgress& progress, std::int64_t before) override {
    to_.ensemble_progress(progress, before);
  }
  void member_stored(const MemberResult& result) override { to_.member_stored(result); }

 private:
  Observer& to_;
};

}  // namespace sturz::workflow
