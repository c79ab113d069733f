// SPDX-License-Identifier: Apache-2.0
#include "ensemble/app/command_line.hpp"
#include "ensemble/app/console/interrupt.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>

namespace {

/// The number of a closed stream would go to the next file that is opened, and what is meant for
/// the stream into that file. Opened the wrong way round, using it still fails as it should.
void occupy_closed_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(stream, F_GETFD) < 0)
      static_cast<void>(open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY));
}

}  // namespace

int main(int argc, char** argv) {
  sturz::app::hold_signals_back(true);
  occupy_closed_streams();
  // A file beyond `ulimit -f` is then a write that fails, with a message, and not the end.
  std::signal(SIGXFSZ, SIG_IGN);
  // Threads that wait must sleep, not spin: cores are shared with other members and other people.
  // The OpenMP library reads this before main starts, so the program starts itself once more.
  if (!std::getenv("OMP_WAIT_POLICY") && setenv("OMP_WAIT_POLICY", "passive", 1) == 0) {
    setenv("OPENBLAS_NUM_THREADS", "1", 0);
    // A few microseconds first, though: passes of a step are that short, and to be woken takes
    // longer (a quarter of the time of 8,842 particles on two threads).
    setenv("GOMP_SPINCOUNT", "1000", 0);
    execv("/proc/self/exe", argv);  // comes back only when it fails; then spinning it is
  }
  prctl(PR_SET_NAME, "sturz");  // it began as /proc/self/exe, and `top` would say "exe"
  return sturz::app::command_line(argc, argv);
}
