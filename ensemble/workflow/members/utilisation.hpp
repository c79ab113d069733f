// SPDX-License-Identifier: Apache-2.0
/// How much of the cores an ensemble used, and why not more.
#pragma once

#include "ensemble/workflow/members/ensemble_job.hpp"
#include "ensemble/workflow/members/run_ensemble.hpp"

#include <cstdint>
#include <string>

namespace sturz::workflow {

/// Of the members of one call; maps and pages are not in it.
struct Utilisation {
  std::int64_t members = 0;
  int workers = 1, threads = 1;  ///< members at a time, threads of each
  int cores = 1;                 ///< that might have been used
  double core_s = 0;             ///< computing time of all members
  double busy_s = 0;             ///< members' wall time times their threads
  double longest_s = 0;          ///< wall time of the longest member
  double storing_s = 0;          ///< spent on writing members, one at a time
  double wall_s = 0;             ///< from the first member's start to the last one's end

  /// Achieved core-seconds / (wall time x cores); NaN where no time went by.
  double fraction() const;
};

Utilisation utilisation_of(const EnsembleJob&, const MembersRun&);

/// "87 % of 2 cores (12.3 core-seconds in 7.1 s)"; empty where no member was computed.
std::string utilisation_text(const Utilisation&);

/// Why it is under one half, as far as it can be told: few members, one long member, the disk,
/// other work on the machine; empty from one half on, and within the first ten seconds.
std::string low_utilisation(const Utilisation&);

}  // namespace sturz::workflow
