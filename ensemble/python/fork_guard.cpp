// SPDX-License-Identifier: Apache-2.0
#include "ensemble/python/fork_guard.hpp"

#include <pthread.h>

#include <atomic>
#include <stdexcept>

namespace sturz::python {
namespace {

std::atomic<int> computing{0};
std::atomic<bool> is_forked{false}, is_torn{false};

void in_child() {
  is_forked.store(true);
  if (computing.load() > 0) is_torn.store(true);
}

}  // namespace

void watch_forks() { pthread_atfork(nullptr, nullptr, in_child); }

int threads_here(int wanted) { return is_forked.load() ? 1 : wanted; }

void require_whole_process() {
  if (is_torn.load())
    throw std::runtime_error(
        "this process was forked while a member was computed, and would wait for threads that it "
        "has not. Start processes with multiprocessing's \"spawn\" or \"forkserver\", or before "
        "the first member.");
}

Computing::Computing() {
  require_whole_process();
  ++computing;
}

Computing::~Computing() { --computing; }

}  // namespace sturz::python
