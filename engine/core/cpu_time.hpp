// SPDX-License-Identifier: Apache-2.0
/// Computing time of a team of threads.
#pragma once

#include "engine/core/thread_time.hpp"

namespace sturz {

/// Computing time so far of the `threads` threads that loops of the calling thread use [s]. Only
/// differences mean something. Time that a thread spins while it waits for work counts.
inline double team_cpu_seconds(int threads) {
  if (threads <= 1) return thread_cpu_seconds();
  double seconds = 0;
#pragma omp parallel num_threads(threads) reduction(+ : seconds)
  seconds += thread_cpu_seconds();
  return seconds;
}

}  // namespace sturz
