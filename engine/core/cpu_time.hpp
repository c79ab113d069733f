// SPDX-License-Identifier: Apache-2.0
/// Computing time of a team of threads.
#pragma once

#include <ctime>

namespace sturz {

/// Computing time so far of the calling thread [s].
inline double thread_cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

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
