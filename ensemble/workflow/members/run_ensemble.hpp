// SPDX-License-Identifier: Apache-2.0
/// The members of a prepared ensemble: computed side by side, each stored when it is done.
#pragma once

#include "ensemble/members/runner.hpp"
#include "ensemble/workflow/members/ensemble_job.hpp"
#include "ensemble/workflow/observer.hpp"

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sturz::workflow {

/// How the members of this call's share came out, those of earlier calls included.
struct MembersRun {
  std::int64_t finished = 0, total = 0;
  std::vector<MemberSummary> computed;  ///< of this call, as they were stored
  std::vector<FailedMember> failed;     ///< of `computed`: not valid
  bool interrupted = false;             ///< cancelled before all were finished
  std::string stop_error;  ///< why the run stopped by itself, as RunReport says; empty: it did not
  std::optional<StopRecord> stop;  ///< of a stop rule, when it came to its end
  double wall_s = 0;               ///< of computing members
  double storing_s = 0;            ///< of that, writing them
};

/// Runs what is to do. The same request, prepared anew, goes on after whatever stopped this one.
/// \param cancel may be set at any time, from a signal handler too
MembersRun run_ensemble(const EnsembleJob&, Observer&, const std::atomic<bool>& cancel);

/// Computes one member of the design; nothing is written. From any thread, several at once.
/// \throws SetupError when this member's values make no scene
MemberResult run_member(const EnsembleJob&, std::int64_t member, const std::atomic<bool>& cancel);

/// Writes one member into the folder. \throws IoError
void store_member(const EnsembleJob&, const MemberResult&);

}  // namespace sturz::workflow
