// SPDX-License-Identifier: Apache-2.0
/// How much of the machine this process may really use.
#pragma once

#include <cstddef>

namespace sturz::workflow {

/// Cores of the process: its CPU set (taskset, Slurm, containers), cut to the quota of its control
/// group. At least 1.
int available_cores();

/// Memory that new work may take without swapping, or being killed by its control group [bytes];
/// 0 when the system does not say.
double available_memory_bytes();

/// Memory for members' values while maps are made [bytes]: an eighth of what is available, 128 MiB
/// to 1 GiB. More means fewer passes over the members, and the same bits.
/// \param max_process_bytes that this process may hold; 0: no limit
std::size_t records_memory_bytes(double max_process_bytes = 0);

/// Memory that this process holds now [bytes]; 0 when the system does not say.
double resident_memory_bytes();

}  // namespace sturz::workflow
