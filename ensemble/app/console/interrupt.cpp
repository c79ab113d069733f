// SPDX-License-Identifier: Apache-2.0
#include "ensemble/app/console/interrupt.hpp"

#include <csignal>

namespace sturz::app {
namespace {

std::atomic<bool> flag{false};
static_assert(std::atomic<bool>::is_always_lock_free,
              "a signal handler may only touch such a flag");

void on_signal(int) { flag.store(true, std::memory_order_relaxed); }

}  // namespace

void watch_for_interrupts() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = static_cast<int>(SA_RESTART | SA_RESETHAND);  // the second signal kills
  for (int signal : {SIGINT, SIGTERM}) sigaction(signal, &action, nullptr);
}

const std::atomic<bool>& interrupt_flag() { return flag; }

}  // namespace sturz::app
