// SPDX-License-Identifier: Apache-2.0
/// An ensemble given to Slurm: an array with a task for each shard, and the merge behind it.
///
///   record "not complete" --> array, held --> merge, after the array --> record --> array released
///
/// Killed anywhere in between, nothing runs: what was made is held, and the next call finds it by
/// its name, cancels it and submits anew.
#pragma once

#include "engine/core/cancel.hpp"
#include "ensemble/workflow/cluster/job_scripts.hpp"
#include "ensemble/workflow/cluster/shard_plan.hpp"
#include "ensemble/workflow/cluster/slurm.hpp"
#include "ensemble/workflow/cluster/submission.hpp"
#include "ensemble/workflow/members/ensemble_job.hpp"
#include "ensemble/workflow/observer.hpp"

#include <optional>
#include <string>
#include <vector>

namespace sturz::workflow {

struct SubmitRequest {
  EnsembleRequest ensemble;
  PlanRequest plan;          ///< its `shards` counts when it is not 0
  Resources asked;           ///< zeros: as the last time, or as the plan says
  bool cores_given = false;  ///< asked.cores is the user's
  JobOptions options;
  std::string work_folder;               ///< where the user stands
  std::string program;                   ///< that shards and merge run
  std::vector<std::string> words;        ///< of `sturz ensemble`, without folder and shard
  std::vector<std::string> merge_words;  ///< of `sturz merge`, without folder
  bool dry_run = false;                  ///< scripts only
};

struct Submitted {
  OutputFolder folder;
  Submission record;              ///< without jobs after a dry run
  std::optional<ShardPlan> plan;  ///< where one was made
  std::vector<int> shards;        ///< of the new array; empty: none was missing
  std::vector<int> queued;        ///< missing, but waiting or running already
  std::int64_t finished = 0, members = 0;
  bool nothing_to_do = false;  ///< members and maps are complete, or all of it is queued
};

/// Begins the folder where it is new, or finds out which shards lack members and are neither
/// running nor queued; only those are submitted. Warns of the rests of a call that was killed.
/// \throws SetupError: the scene, another scene's folder, no Slurm, or what Slurm said; Cancelled
Submitted submit(const SubmitRequest&, const RunCommand&, Observer&, CancelFlag cancel = {});

}  // namespace sturz::workflow
