// SPDX-License-Identifier: Apache-2.0
/// How much of the machine this process may really use.
#pragma once

namespace sturz::workflow {

/// Cores of the process: its CPU set (taskset, Slurm, containers), cut to the quota of its control
/// group. At least 1.
int available_cores();

/// Memory that new work may take without swapping [bytes]; 0 when the system does not say.
double available_memory_bytes();

/// Memory that this process holds now [bytes]; 0 when the system does not say.
double resident_memory_bytes();

}  // namespace sturz::workflow
