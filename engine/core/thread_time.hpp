// SPDX-License-Identifier: Apache-2.0
/// Computing time of one thread: what others do on the machine meanwhile does not count.
#pragma once

#include <ctime>

namespace sturz {

/// Computing time so far of the calling thread [s].
inline double thread_cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

}  // namespace sturz
