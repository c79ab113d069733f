// SPDX-License-Identifier: Apache-2.0
/// Which process on which machine: enough to tell a live one from one that only left its name.
#pragma once

#include <cstdint>
#include <string>

namespace sturz::workflow {

struct ProcessIdentity {
  std::string host;     ///< name of the machine
  std::string machine;  ///< its own number (/etc/machine-id); empty where there is none
  std::string boot;     ///< another after each start of the machine
  std::string pids;  ///< in which set of process numbers `pid` counts (containers have their own)
  std::int64_t pid = 0;
  std::uint64_t start = 0;  ///< when it began, in ticks since the machine's start; tells a process
                            ///< from a later one with the same number
  std::string job;          ///< of a scheduler, "slurm/CLUSTER/123"; empty: started by hand
  std::int64_t restarts = 0;  ///< how often the scheduler had begun that job anew
  bool operator==(const ProcessIdentity&) const = default;
};

const ProcessIdentity& this_process();
/// Told once, before anything is locked: which job of a scheduler this process belongs to.
void this_process_is_of(const std::string& job, std::int64_t restarts);

/// True when the scheduler has given up on `earlier` and begun the same job anew as this process.
/// What it gave up on may still compute, on a machine that it cannot reach.
bool replaces(const ProcessIdentity& earlier);

enum class Liveness {
  alive,
  gone,
  unknown,  ///< on another machine or in another container: cannot be asked from here
};
Liveness liveness_of(const ProcessIdentity&);

}  // namespace sturz::workflow
