// SPDX-License-Identifier: Apache-2.0
/// What the workflow tells, in words on the console.
#pragma once

#include "ensemble/app/console/console.hpp"
#include "ensemble/workflow/observer.hpp"

#include <string>

namespace sturz::app {

class ConsoleObserver final : public workflow::Observer {
 public:
  explicit ConsoleObserver(Console& console) : console_(console) {}

  void warning(std::string_view text) override;
  void folder_ready(const workflow::OutputFolder&) override;
  void run_progress(const Progress&) override;
  void ensemble_progress(const RunnerProgress&, std::int64_t finished_before) override;
  void member_stored(const MemberResult&) override;
  void source_member_stored(const std::string& source, const MemberResult&) override;
  void looked(const StopRecord&) override;
  void maps_begin() override;

 private:
  Console& console_;
};

}  // namespace sturz::app
