// SPDX-License-Identifier: Apache-2.0
/// What long work tells its caller while it runs: the workflow has no other way to speak.
#pragma once

#include "engine/simulation/simulation.hpp"
#include "ensemble/members/runner.hpp"
#include "ensemble/stopping/stop_rule.hpp"
#include "ensemble/workflow/folder/output_folder.hpp"

#include <string>
#include <string_view>

namespace sturz::workflow {

/// Every event has an empty default: listen to what you need, or to nothing with this class. Events
/// come one at a time, those of running members from any thread. What a listener throws ends the
/// work: before and after the members it comes out as it is, out of `member_stored` it is a failure
/// to store.
class Observer {
 public:
  virtual ~Observer() = default;

  /// Something a person should read; the work goes on.
  virtual void warning(std::string_view /*text*/) {}
  /// From here on the folder is ours and exists: the first moment for a log file in it.
  virtual void folder_ready(const OutputFolder&) {}
  /// A single run, many times a second at most.
  virtual void run_progress(const Progress&) {}
  /// An ensemble, twice a second and after each member. `finished_before`: members of earlier
  /// calls; they count for the total, not for the pace.
  virtual void ensemble_progress(const RunnerProgress&, std::int64_t /*finished_before*/) {}
  /// The member, valid or not, is safely in its file.
  virtual void member_stored(const MemberResult&) {}
  /// The same of a region's member; `member_stored` is not called for it.
  virtual void source_member_stored(const std::string& /*source*/, const MemberResult&) {}
  /// A stop rule looked at the map, and whether it goes on. A run that goes on looks again at what
  /// was looked at before.
  virtual void looked(const StopRecord&) {}
  /// Reading members and making maps, or a page, begins; it may take a while and heeds its cancel
  /// flag.
  virtual void maps_begin() {}
};

}  // namespace sturz::workflow
