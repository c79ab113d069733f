// SPDX-License-Identifier: Apache-2.0
/// The scripts that a scheduler runs.
#pragma once

#include "ensemble/workflow/cluster/submission.hpp"

#include <string>
#include <vector>

namespace sturz::workflow {

struct JobOptions {
  std::string partition, account;   ///< empty: the cluster's defaults
  int at_a_time = 0;                ///< shards that run at most; 0: all that find room
  std::vector<std::string> sbatch;  ///< further options of sbatch, as they stand
};

struct ScriptRequest {
  const ClusterFolder& folder;
  const Submission& submission;
  const JobOptions& options;
  std::string work_folder;           ///< names in the commands start here
  std::vector<std::string> command;  ///< the program and its words
  std::vector<int> shards;           ///< of the array; empty: of the merge
};

/// A batch script that runs the command, tells it a minute before the time limit, and puts itself
/// back into the queue when it then stopped with what is finished kept. \throws SetupError for
/// names that a script cannot hold
std::string job_script(const ScriptRequest&);

}  // namespace sturz::workflow
