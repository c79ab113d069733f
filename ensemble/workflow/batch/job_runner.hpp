// SPDX-License-Identifier: Apache-2.0
/// One job of a batch, from its scenario to its page, whatever goes wrong in it.
#pragma once

#include "ensemble/workflow/batch/plan.hpp"
#include "ensemble/workflow/members/utilisation.hpp"
#include "ensemble/workflow/observer.hpp"

#include <atomic>
#include <optional>
#include <string>

namespace sturz::workflow {

struct JobLimits {
  int max_workers = 0;          ///< cores; 0: all available
  double max_memory_bytes = 0;  ///< of the process; 0: what is free
  bool retry_failed = false;
  std::string command;  ///< for the manifest
};

struct JobRun {
  JobEnd end = JobEnd::failed;
  std::string message;  ///< why it failed, or how far it came
  std::optional<BatchFigures> figures;
  std::optional<Utilisation> utilisation;  ///< of the members of this call
  double wall_s = 0;
};

/// Computes what is to do of the job and makes its maps. Whatever it throws is its end and no other
/// job's. \param cancel may be raised at any time: the job is interrupted then
JobRun run_job(const PlannedJob&, const JobLimits&, Observer&, const std::atomic<bool>& cancel);

}  // namespace sturz::workflow
