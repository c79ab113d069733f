// SPDX-License-Identifier: Apache-2.0
/// Signals that ask the program to stop, and the promise that it then does.
///
///   SIGINT, SIGTERM, SIGHUP, SIGUSR1 --> flag, which long work looks at and comes back
///                                    --> watchdog: what is not back in time is ended past it
///
/// Ending past the work is safe: every file appears whole or not at all, as under kill -9, and part
/// files and locks are removed on the way.
#pragma once

#include <atomic>

namespace sturz::app {

/// While the program starts, and over an exec: they wait and are not lost.
void hold_signals_back(bool held);

/// From now on those signals raise the flag, and the program ends within about 1.5 s with exit code
/// `interrupted` and words, whatever it does; a second signal later than 0.3 s ends it at once.
/// \param json the words come as a JSON line too
void watch_for_interrupts(bool json);
const std::atomic<bool>& interrupt_flag();
/// The words were said: the watchdog needs none.
void interruption_told();
bool interruption_was_told();

}  // namespace sturz::app
