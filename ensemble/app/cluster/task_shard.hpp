// SPDX-License-Identifier: Apache-2.0
/// Which shard this process is, by its command line or by the task that a scheduler gave it.
#pragma once

#include "ensemble/workflow/folder/shard.hpp"

#include <string>

namespace sturz::app {

/// "K/N", or "auto/N": then K is the number of the task, from HQ_TASK_ID (HyperQueue, which may
/// itself run within a job of Slurm) or else SLURM_ARRAY_TASK_ID. Empty text: everything.
/// \param first_task number of the task that computes shard 1
/// \throws SetupError when that is no shard, or no scheduler gave a number
workflow::Shard shard_of(const std::string& text, int first_task = 1);

/// Tells the locks which job of a scheduler this process belongs to.
void tell_scheduler_job();

}  // namespace sturz::app
