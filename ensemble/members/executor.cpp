// SPDX-License-Identifier: Apache-2.0
#include "ensemble/members/executor.hpp"

#include "engine/core/error.hpp"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define STURZ_THREAD_SANITIZER
#include <sanitizer/tsan_interface.h>
#endif
#endif

namespace sturz {
namespace {

/// What the workers of one loop share: the next piece, and the first exception.
class Loop {
 public:
  Loop(std::size_t n, const std::atomic<bool>& stop, const std::function<void(std::size_t)>& body)
      : n_(n), stop_(stop), body_(body) {}

  /// One worker's life: takes pieces until none is left.
  void work() noexcept {
    while (!stop_.load() && !broken_.load()) {
      const std::size_t piece = next_.fetch_add(1);
      if (piece >= n_) return;
      try {
        body_(piece);
      } catch (...) {
        const std::lock_guard guard(lock_);
        if (!error_) error_ = std::current_exception();
        broken_ = true;
      }
    }
  }

  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  const std::size_t n_;
  const std::atomic<bool>& stop_;
  const std::function<void(std::size_t)>& body_;
  std::atomic<std::size_t> next_{0};
  std::atomic<bool> broken_{false};
  std::mutex lock_;
  std::exception_ptr error_;
};

/// TBB orders a task behind the call that spawned it, and the wait behind the task. The thread
/// sanitizer cannot see that in the packaged TBB, which is not instrumented, and is told.
class TaskOrder {
 public:
#ifdef STURZ_THREAD_SANITIZER
  static void spawning() { __tsan_release(&spawned_); }
  static void begun() { __tsan_acquire(&spawned_); }
  static void ended() { __tsan_release(&done_); }
  static void waited() { __tsan_acquire(&done_); }

 private:
  inline static char spawned_ = 0, done_ = 0;  // only their addresses matter
#else
  static void spawning() {}
  static void begun() {}
  static void ended() {}
  static void waited() {}
#endif
};

/// Workers needed for n pieces.
std::size_t worker_count(int workers, std::size_t n) {
  return std::min(static_cast<std::size_t>(workers), n);
}

class TbbExecutor final : public Executor {
 public:
  explicit TbbExecutor(int workers)
      : workers_(workers),
        allowed_(tbb::global_control::max_allowed_parallelism,
                 std::max(static_cast<std::size_t>(workers),
                          tbb::global_control::active_value(
                              tbb::global_control::max_allowed_parallelism))),
        arena_(workers) {}

  int workers() const override { return workers_; }

  void for_each(std::size_t n, const std::atomic<bool>& stop,
                const std::function<void(std::size_t)>& body) override {
    Loop loop(n, stop, body);
    // One task per worker pulling from a counter, not a parallel_for: that keeps the order.
    arena_.execute([&] {
      tbb::task_group group;
      TaskOrder::spawning();
      for (std::size_t w = 1; w < worker_count(workers_, n); ++w)
        group.run([&] {
          TaskOrder::begun();
          loop.work();
          TaskOrder::ended();
        });
      loop.work();
      group.wait();
      TaskOrder::waited();
    });
    loop.rethrow();
  }

 private:
  int workers_;
  tbb::global_control allowed_;  // TBB alone would not go beyond the number of processors
  tbb::task_arena arena_;
};

class PlainExecutor final : public Executor {
 public:
  explicit PlainExecutor(int workers) : workers_(workers) {}

  int workers() const override { return workers_; }

  void for_each(std::size_t n, const std::atomic<bool>& stop,
                const std::function<void(std::size_t)>& body) override {
    Loop loop(n, stop, body);
    {
      std::vector<std::jthread> threads;
      for (std::size_t w = 1; w < worker_count(workers_, n); ++w)
        threads.emplace_back([&] { loop.work(); });
      loop.work();
    }  // joins
    loop.rethrow();
  }

 private:
  int workers_;
};

}  // namespace

std::unique_ptr<Executor> make_executor(int workers, ThreadLibrary library) {
  require(workers >= 1, "workers = " + std::to_string(workers) +
                            " (at least one is needed). Give the number of processors to use.");
  if (library == ThreadLibrary::plain) return std::make_unique<PlainExecutor>(workers);
  return std::make_unique<TbbExecutor>(workers);
}

}  // namespace sturz
