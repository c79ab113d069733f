// SPDX-License-Identifier: Apache-2.0
/// cluster/submission.json: which jobs of a scheduler compute a folder.
#pragma once

#include "ensemble/workflow/folder/output_folder.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace sturz::workflow {

/// What is asked for.
struct Resources {
  int cores = 1;  ///< of a shard, and of the merge
  double shard_s = 0, shard_bytes = 0;
  double maps_s = 0, maps_bytes = 0;
};

struct Submission {
  /// False from before the first job is made until all of them are and may run: jobs of that name
  /// that the record does not list are then half a submission, held back, and are to be cancelled.
  bool complete = false;
  std::string name;               ///< of the array; the merge's is merge_name()
  std::string since;              ///< UTC, ISO 8601
  int shards = 0;                 ///< into which the members are divided
  std::vector<std::string> jobs;  ///< arrays that waited or ran when this was written, the last new
  std::string merge_job;
  Resources asked;

  std::string merge_name() const { return name + "-maps"; }
};

/// Names of what lies in the folder for a scheduler.
struct ClusterFolder {
  std::filesystem::path root;  ///< OUT/cluster
  explicit ClusterFolder(const OutputFolder& of) : root(of.root / "cluster") {}

  std::filesystem::path record() const { return root / "submission.json"; }
  std::filesystem::path lock() const { return root / "lock.json"; }
  std::filesystem::path shard_script() const { return root / "shard.sh"; }
  std::filesystem::path merge_script() const { return root / "merge.sh"; }
  std::filesystem::path logs() const { return root / "log"; }
};

/// Nothing when nothing was ever submitted. \throws SetupError when it is damaged
std::optional<Submission> read_submission(const std::filesystem::path& file);
void write_submission(const std::filesystem::path& file, const Submission&);

}  // namespace sturz::workflow
