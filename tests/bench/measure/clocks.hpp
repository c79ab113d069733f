// SPDX-License-Identifier: Apache-2.0
/// The two clocks of the harness: time that this thread computed, and time on the wall.
#pragma once

#include <time.h>

namespace sturz::bench {

inline double seconds_of(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Computing time of this thread [s]: what others do on the machine meanwhile does not count.
inline double thread_seconds() { return seconds_of(CLOCK_THREAD_CPUTIME_ID); }
inline double wall_seconds() { return seconds_of(CLOCK_MONOTONIC); }

/// Seconds that `work` took on a clock.
template <class Clock, class Work>
double timed(Clock&& clock, Work&& work) {
  const double begin = clock();
  work();
  return clock() - begin;
}

}  // namespace sturz::bench
