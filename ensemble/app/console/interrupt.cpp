// SPDX-License-Identifier: Apache-2.0
#include "ensemble/app/console/interrupt.hpp"

#include "ensemble/app/exit_codes.hpp"

#include <unistd.h>

#include <csignal>

namespace sturz::app {
namespace {

std::atomic<bool> flag{false};
static_assert(std::atomic<bool>::is_always_lock_free,
              "a signal handler may only touch such a flag");

void on_signal(int) { flag.store(true, std::memory_order_relaxed); }

/// Only calls that a signal handler may make.
void end_at_once(int) {
  static constexpr char text[] = "warning: interrupted before anything was begun\n";
  const ssize_t written = ::write(STDERR_FILENO, text, sizeof text - 1);
  static_cast<void>(written);
  ::_exit(interrupted);
}

void handle(void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = static_cast<int>(SA_RESTART | SA_RESETHAND);  // the second signal kills
  for (int signal : {SIGINT, SIGTERM}) sigaction(signal, &action, nullptr);
}

}  // namespace

void end_on_interrupt() { handle(end_at_once); }

void watch_for_interrupts() { handle(on_signal); }

const std::atomic<bool>& interrupt_flag() { return flag; }

}  // namespace sturz::app
