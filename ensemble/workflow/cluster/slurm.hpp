// SPDX-License-Identifier: Apache-2.0
/// Slurm through its own commands: no library, and nothing that its users could not type.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace sturz::workflow {

/// A program of the system that has ended.
struct Ran {
  bool found = true;  ///< false: there is no such program
  int exit_code = 0;  ///< 128 + the signal that ended it
  std::string out, err;
};
/// Runs the words as a program and waits; ends it should this process be killed meanwhile.
using RunCommand = std::function<Ran(const std::vector<std::string>&)>;

/// A job, or a task of an array, that waits or runs.
struct QueuedTask {
  std::string job;   ///< number of the job, for a task of the whole array
  int task = 0;      ///< number within the array; 0: no array
  std::string name;  ///< of the job
  std::string state;
};

class Slurm {
 public:
  explicit Slurm(RunCommand run) : run_(std::move(run)) {}

  /// \throws SetupError when there is no sbatch here
  void require_there() const;
  /// Largest number of a task that this cluster takes. \throws SetupError when it does not answer
  int largest_task() const;
  /// \return the number of the job \throws SetupError with what sbatch said
  std::string submit(const std::vector<std::string>& sbatch_words) const;
  /// What waits or runs under these names. \throws SetupError when the cluster does not answer
  std::vector<QueuedTask> queued(std::span<const std::string> names) const;
  void release(const std::string& job) const;
  /// Jobs that are over already are no error.
  void cancel(std::span<const std::string> jobs) const;

 private:
  std::string ask(const std::vector<std::string>& words) const;
  RunCommand run_;
};

}  // namespace sturz::workflow
