// SPDX-License-Identifier: Apache-2.0
/// Runs the members of an ensemble side by side; one member's trouble is never another's.
///
///   worker:  take next member -> run_member (may throw) -> [one lock] store -> on_progress
///   watcher: every 50 ms looks at the caller's cancel flag and the clock -> stop flag
#pragma once

#include "engine/core/error.hpp"
#include "engine/simulation/member_result.hpp"
#include "ensemble/members/executor.hpp"

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace sturz {

/// What is wrong with all members alike, though only some of them meet it. Were these counted as
/// failed, the maps would be those of the others, say of all that did not run far. So the run
/// stops, and the member remains to be done.
class StopsRun : public SetupError {
 public:
  using SetupError::SetupError;
};

/// What is to be run, and how.
struct RunPlan {
  std::vector<std::int64_t> members;  ///< still to do, in the order in which they start;
                                      ///< see longest_first()
  int workers = 1;                    ///< members at a time (times the threads of each member)
  double progress_every_s = 0.5;      ///< on_progress is called at least this often
  ThreadLibrary threads = ThreadLibrary::tbb;
};

/// How far the run is.
struct RunnerProgress {
  std::int64_t n_total = 0;
  std::int64_t n_done = 0;    ///< stored, failed ones included
  std::int64_t n_failed = 0;  ///< of these: neither settled, out of time nor left the terrain
  std::int64_t n_running = 0;
  double elapsed_s = 0;
  double members_per_hour = 0;  ///< 0 until the first is done
  double eta_s = 0;             ///< seconds to go at this pace; NaN until the first is done
  /// Under a stop rule: the largest half width of P(reached) of the members so far, and the wanted
  /// one; n_total and eta_s are then those of the look at which it will probably stop. NaN: no
  /// rule.
  double half_width = nan_d, wanted_half_width = nan_d;
};

struct RunCallbacks {
  /// Computes one member; on any thread, several at once. When `cancel` turns true it should come
  /// back soon with Outcome::cancelled. Whatever it throws makes the member a failed one, except
  /// StopsRun.
  std::function<MemberResult(std::int64_t member, const std::atomic<bool>& cancel)> run_member;
  /// Keeps a finished member; one call at a time, in order of finishing. Cancelled members do not
  /// come here. If it throws, nothing more is stored and the run stops.
  std::function<void(const MemberResult&)> store;
  /// May be empty. One call at a time, never at the same time as `store`.
  std::function<void(const RunnerProgress&)> on_progress;
};

struct FailedMember {
  std::int64_t member = 0;
  Outcome outcome = Outcome::failed;
  std::string reason;
};

struct RunReport {
  RunnerProgress progress;           ///< at the end
  std::vector<FailedMember> failed;  ///< stored members that are not valid, ascending
  bool interrupted = false;          ///< cancelled or out of time before all members were done
  std::string stop_error;            ///< why the run stopped by itself: storing failed, or StopsRun
  bool complete() const { return progress.n_done == progress.n_total; }
};

/// Runs the plan and returns when no member runs any more. Throws only for a broken plan
/// (SetupError) or when on_progress throws.
/// \param cancel set by the caller at any time, for instance from a signal handler
RunReport run_members(const RunPlan& plan, const RunCallbacks& callbacks,
                      const std::atomic<bool>& cancel);

}  // namespace sturz
