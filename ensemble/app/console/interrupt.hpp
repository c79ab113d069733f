// SPDX-License-Identifier: Apache-2.0
/// Ctrl-C and SIGTERM as a flag that long work looks at.
#pragma once

#include <atomic>

namespace sturz::app {

/// From now on SIGINT and SIGTERM end the process at once with the exit code of an interruption:
/// for the time in which files are only read. The library that reads a large raster looks at no
/// flag.
void end_on_interrupt();

/// From now on SIGINT and SIGTERM raise the flag; a second one ends the process at once.
void watch_for_interrupts();
const std::atomic<bool>& interrupt_flag();

}  // namespace sturz::app
