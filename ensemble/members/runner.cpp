// SPDX-License-Identifier: Apache-2.0
#include "ensemble/members/runner.hpp"

#include "engine/core/error.hpp"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <new>
#include <thread>

namespace sturz {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds watch_every{50};

MemberResult failed_member(std::int64_t member, std::string reason) {
  MemberResult result;
  result.member = member;
  result.outcome = Outcome::failed;
  result.reason = std::move(reason);
  result.formulation.clear();  // not known: the member may not even have been assembled
  return result;
}

/// Any exception of a member becomes its outcome, save one.
MemberResult run_guarded(const RunCallbacks& callbacks, std::int64_t member,
                         const std::atomic<bool>& stop) {
  try {
    MemberResult result = callbacks.run_member(member, stop);
    result.member = member;
    return result;
  } catch (const StopsRun&) {
    throw;
  } catch (const std::bad_alloc&) {
    return failed_member(member, "out of memory");
  } catch (const std::exception& error) {
    return failed_member(member, error.what());
  } catch (...) {
    return failed_member(member, "unknown exception");
  }
}

class Run {
 public:
  Run(const RunPlan& plan, const RunCallbacks& callbacks, const std::atomic<bool>& cancel)
      : plan_(plan), callbacks_(callbacks), cancel_(cancel) {
    report_.progress.n_total = static_cast<std::int64_t>(plan.members.size());
  }

  RunReport run() {
    const std::unique_ptr<Executor> executor = make_executor(plan_.workers, plan_.threads);
    if (cancel_.load()) stop_ = true;
    {
      const std::jthread watcher([this](const std::stop_token& over) { watch(over); });
      executor->for_each(plan_.members.size(), stop_, [this](std::size_t i) { run_member(i); });
    }  // the watcher ends here
    if (progress_error_) std::rethrow_exception(progress_error_);
    update_pace();
    report_.interrupted = !report_.complete() && report_.stop_error.empty();
    std::sort(report_.failed.begin(), report_.failed.end(),
              [](const auto& a, const auto& b) { return a.member < b.member; });
    return std::move(report_);
  }

 private:
  void run_member(std::size_t i) {
    if (cancel_.load()) {  // between two looks of the watcher
      stop_ = true;
      return;
    }
    {
      const std::lock_guard guard(lock_);
      ++report_.progress.n_running;
    }
    MemberResult result;
    std::string stops;
    try {
      result = run_guarded(callbacks_, plan_.members[i], stop_);
    } catch (const StopsRun& error) {
      stops = error.what();
    }
    const std::lock_guard guard(lock_);
    --report_.progress.n_running;
    if (!stops.empty()) return stop_because(stops);
    if (result.outcome == Outcome::cancelled) {
      stop_ = true;  // a member is cancelled only when the user wants to stop
      return;
    }
    if (store(result)) count(result);
    report_progress();
  }

  /// Under the lock. The first reason is the one that is told.
  void stop_because(const std::string& reason) {
    if (report_.stop_error.empty()) report_.stop_error = reason.empty() ? "unknown reason" : reason;
    stop_ = true;
  }

  /// Under the lock. False: the result is lost, and the run stops.
  bool store(const MemberResult& result) {
    if (!report_.stop_error.empty()) return false;
    try {
      callbacks_.store(result);
      return true;
    } catch (const std::exception& error) {
      stop_because(error.what());
    } catch (...) {
      stop_because("");
    }
    return false;
  }

  void count(const MemberResult& result) {
    ++report_.progress.n_done;
    if (is_valid(result.outcome)) return;
    ++report_.progress.n_failed;
    report_.failed.push_back({result.member, result.outcome, result.reason});
  }

  void update_pace() {
    RunnerProgress& p = report_.progress;
    p.elapsed_s = std::chrono::duration<double>(Clock::now() - start_).count();
    const bool known = p.n_done > 0 && p.elapsed_s > 0;
    const auto done = static_cast<double>(p.n_done);
    p.members_per_hour = known ? 3600 * done / p.elapsed_s : 0;
    p.eta_s = known ? p.elapsed_s * static_cast<double>(p.n_total - p.n_done) / done : nan_d;
  }

  /// Under the lock. An exception of the caller's display ends the run, after the members.
  void report_progress() {
    last_report_ = Clock::now();
    if (!callbacks_.on_progress || progress_error_) return;
    update_pace();
    try {
      callbacks_.on_progress(report_.progress);
    } catch (...) {
      progress_error_ = std::current_exception();
      stop_ = true;
    }
  }

  void watch(const std::stop_token& over) {
    std::unique_lock guard(lock_);
    while (!wake_.wait_for(guard, over, watch_every, [&] { return over.stop_requested(); })) {
      if (cancel_.load()) stop_ = true;
      if (Clock::now() - last_report_ >= std::chrono::duration<double>(plan_.progress_every_s))
        report_progress();
    }
  }

  const RunPlan& plan_;
  const RunCallbacks& callbacks_;
  const std::atomic<bool>& cancel_;
  const Clock::time_point start_ = Clock::now();
  std::atomic<bool> stop_{false};
  std::mutex lock_;  // guards everything below, and store and on_progress themselves
  std::condition_variable_any wake_;
  Clock::time_point last_report_ = start_;
  RunReport report_;
  std::exception_ptr progress_error_;
};

}  // namespace

RunReport run_members(const RunPlan& plan, const RunCallbacks& callbacks,
                      const std::atomic<bool>& cancel) {
  expect(callbacks.run_member && callbacks.store, "a run needs run_member and store");
  return Run(plan, callbacks, cancel).run();
}

}  // namespace sturz
