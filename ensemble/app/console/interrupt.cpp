// SPDX-License-Identifier: Apache-2.0
#include "ensemble/app/console/interrupt.hpp"

#include "ensemble/app/exit_codes.hpp"
#include "io/files/unfinished.hpp"

#include <poll.h>
#include <pthread.h>
#include <semaphore.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <ctime>
#include <string_view>
#include <thread>

namespace sturz::app {
namespace {

using namespace std::chrono_literals;

std::atomic<bool> flag{false}, told{false};
static_assert(std::atomic<bool>::is_always_lock_free,
              "a signal handler may only touch such a flag");
sem_t signals;  // its count: how many came

void on_signal(int) {
  const int kept = errno;
  flag.store(true, std::memory_order_relaxed);
  sem_post(&signals);
  errno = kept;
}

/// Past the C library, whose locks the work may hold; a reader that does not read is not waited
/// for.
void say(int stream, std::string_view words) {
  pollfd ready{stream, POLLOUT, 0};
  if (poll(&ready, 1, 100) == 1 && (ready.revents & POLLOUT) != 0) {
    const ssize_t written = ::write(stream, words.data(), words.size());
    static_cast<void>(written);
  }
}

[[noreturn]] void end_now(bool json) {
  if (!told.load()) {
    say(STDERR_FILENO,
        "\nwarning: interrupted. What is finished is kept; resume with the same command.\n");
    if (json) say(STDOUT_FILENO, "{\"event\":\"interrupted\"}\n");
  }
  remove_unfinished();
  _exit(interrupted);
}

/// True when another signal came within that time.
bool another_within(std::chrono::milliseconds time) {
  timespec until{};
  clock_gettime(CLOCK_REALTIME, &until);
  const auto ns = until.tv_nsec + std::chrono::nanoseconds(time).count();
  until.tv_sec += static_cast<time_t>(ns / 1000000000);
  until.tv_nsec = static_cast<long>(ns % 1000000000);
  while (sem_timedwait(&signals, &until) != 0)
    if (errno != EINTR) return false;
  return true;
}

void watchdog(bool json) {
  while (sem_wait(&signals) != 0) {
  }
  // `timeout` and schedulers send twice in a row and mean it once.
  constexpr auto twice_in_a_row = 300ms, patience = 1000ms;
  const auto begin = std::chrono::steady_clock::now();
  while (std::chrono::steady_clock::now() - begin < twice_in_a_row) another_within(twice_in_a_row);
  another_within(patience);
  end_now(json);
}

}  // namespace

void watch_for_interrupts(bool json) {
  sem_init(&signals, 0, 0);
  std::thread(watchdog, json).detach();
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;
  for (const int signal : {SIGINT, SIGTERM, SIGUSR1}) sigaction(signal, &action, nullptr);
  struct sigaction before {};
  sigaction(SIGHUP, nullptr, &before);
  if (before.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);  // nohup means it
  hold_signals_back(false);
}

const std::atomic<bool>& interrupt_flag() { return flag; }

void hold_signals_back(bool held) {
  sigset_t stopping;
  sigemptyset(&stopping);
  for (const int signal : {SIGINT, SIGTERM, SIGUSR1, SIGHUP}) sigaddset(&stopping, signal);
  pthread_sigmask(held ? SIG_BLOCK : SIG_UNBLOCK, &stopping, nullptr);
}

void interruption_told() { told.store(true); }

bool interruption_was_told() { return told.load(); }

}  // namespace sturz::app
