// SPDX-License-Identifier: Apache-2.0
#include "ensemble/app/command_line.hpp"

#include <unistd.h>

#include <cstdlib>

int main(int argc, char** argv) {
  // Threads that wait must sleep, not spin: cores are shared with other members and other people.
  // The OpenMP library reads this before main starts, so the program starts itself once more.
  if (!std::getenv("OMP_WAIT_POLICY") && setenv("OMP_WAIT_POLICY", "passive", 1) == 0) {
    setenv("OPENBLAS_NUM_THREADS", "1", 0);
    execv("/proc/self/exe", argv);  // comes back only when it fails; then spinning it is
  }
  return sturz::app::command_line(argc, argv);
}
