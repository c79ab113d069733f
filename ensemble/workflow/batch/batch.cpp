// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/batch/batch.hpp"

#include "engine/core/cancel.hpp"
#include "ensemble/workflow/batch/batch_summary.hpp"
#include "ensemble/workflow/batch/job_runner.hpp"
#include "ensemble/workflow/batch/old_results.hpp"
#include "ensemble/workflow/folder/folder_lock.hpp"
#include "ensemble/workflow/machine/cores.hpp"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <memory>
#include <numeric>
#include <thread>
#include <utility>

namespace sturz::workflow {
namespace fs = std::filesystem;
namespace {

using Clock = std::chrono::steady_clock;
constexpr double giga = 1e9;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// Of this process so far, all threads.
double process_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

BatchJobs jobs_of(const BatchRequest& request) {
  BatchJobs jobs = read_batch_jobs(request.list, request.speed_cache, request.only,
                                   request.results.value_or(fs::path()));
  BatchSpec& spec = jobs.spec;
  if (request.max_workers) spec.max_workers = *request.max_workers;
  if (request.keep) spec.keep = *request.keep;
  if (request.between) spec.between = request.between;
  spec.wait = spec.wait || request.wait;
  return jobs;
}

GuardLimits guard_limits(const BatchJobs& jobs) {
  return {jobs.spec.between, jobs.stop_file, jobs.root, jobs.spec.min_free_disk_gb * giga,
          jobs.spec.max_memory_gb * giga};
}

BatchRow row_of(const PlannedJob& plan) {
  BatchRow row;
  row.name = plan.job.name;
  row.title = plan.job.scenario.title;
  row.single_run = plan.job.single_run;
  row.state = !plan.job.wanted        ? RowState::skipped
              : !plan.failure.empty() ? RowState::failed
              : plan.to_do            ? RowState::waiting
                                      : RowState::unchanged;
  row.why = plan.why;
  row.message = plan.failure;
  row.folder = plan.folder;
  row.figures = plan.record.figures;
  row.utilisation = plan.record.utilisation;
  row.forecast = plan.forecast;
  row.members = plan.members;
  row.finished = plan.finished;
  if (row.state == RowState::unchanged && plan.record.end == JobEnd::too_many_failed) {
    row.state = RowState::failed;
    row.message = plan.record.message.empty() ? "too many members failed" : plan.record.message;
  }
  return row;
}

class Batch {
 public:
  Batch(const BatchRequest& request, BatchObserver& observer, const std::atomic<bool>& interrupt)
      : request_(request), observer_(observer), interrupt_(interrupt), jobs_(jobs_of(request)) {
    done_.root = jobs_.root;
    done_.spec = jobs_.spec;
    done_.cores = jobs_.spec.max_workers > 0 ? std::min(jobs_.spec.max_workers, available_cores())
                                             : available_cores();
  }

  BatchDone run() {
    observer_.list_read(jobs_.spec);
    if (!request_.dry_run) lock_ = FolderLock::alone({jobs_.root}, request_.command);
    state_ = BatchState::read(state_file());
    plan_all();
    for (const PlannedJob& plan : plans_) done_.rows.push_back(row_of(plan));
    if (request_.dry_run) return std::move(done_);
    compute_all();
    measure();
    write_summary(done_, state_, CancelFlag(interrupt_));
    state_.write(state_file());
    return std::move(done_);
  }

 private:
  fs::path state_file() const { return jobs_.root / "batch.json"; }

  void plan_all() {
    PlanOptions options;
    options.check_all = request_.check_all;
    options.retry_failed = request_.retry_failed;
    options.forecast = request_.dry_run;
    options.max_workers = jobs_.spec.max_workers;
    const std::size_t n = jobs_.list.size();
    for (std::size_t i = 0; i < n; ++i) {
      CancelFlag(interrupt_).check();
      const BatchJob& job = jobs_.list[i];
      plans_.push_back(job.wanted ? plan_job(job, state_, options, observer_, interrupt_)
                                  : not_looked_at(job));
      if (job.wanted) observer_.job_planned(plans_.back(), i, n);
    }
  }

  /// As the last call left it.
  PlannedJob not_looked_at(const BatchJob& job) const {
    PlannedJob plan;
    plan.job = job;
    if (const auto known = state_.jobs.find(job.name); known != state_.jobs.end()) {
      plan.record = known->second;
      plan.folder = plan.record.folder;
    }
    return plan;
  }

  /// In the order of the list; those that the program ended in come last, for the others' sake.
  std::vector<std::size_t> order() const {
    std::vector<std::size_t> all(plans_.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    std::stable_partition(all.begin(), all.end(),
                          [&](std::size_t i) { return !plans_[i].crashed; });
    return all;
  }

  void compute_all() {
    Guard guard(guard_limits(jobs_), interrupt_);
    for (const std::size_t i : order()) {
      const PlannedJob& plan = plans_[i];
      BatchRow& row = done_.rows[i];
      if (!plan.job.wanted) continue;
      if (!plan.failure.empty())
        remember(plan, JobEnd::failed, plan.failure);
      else if (!plan.to_do)
        settle(plan);
      else if (!done_.stop)
        compute(i, guard);
      if (row.state != RowState::waiting) observer_.job_ended(row);
    }
    state_.write(state_file());
  }

  /// Until it is done, or there is a reason to end.
  void compute(std::size_t i, Guard& guard) {
    const PlannedJob& plan = plans_[i];
    BatchRow& row = done_.rows[i];
    bool begun = false;
    while (true) {
      StopReason reason = guard.look();
      if (reason.cause == StopCause::memory && !begun) {  // of the job before; let go meanwhile
        guard.clear();
        reason = guard.look();
      }
      if (reason.cause == StopCause::memory) return too_much_memory(i, reason, guard);
      if (reason && !may_go_on(reason, guard)) {
        done_.stop = guard.look();
        return;
      }
      if (!std::exchange(begun, true)) observer_.job_begins(plan, i, plans_.size());
      remember(plan, JobEnd::running, "");
      state_.write(state_file());
      const JobRun run = run_job(plan, limits(), observer_, guard.flag());
      take(plan, run, row);
      state_.write(state_file());
      if (run.end != JobEnd::interrupted) return;
    }
  }

  JobLimits limits() const {
    return {jobs_.spec.max_workers, jobs_.spec.max_memory_gb * giga, request_.retry_failed,
            request_.command};
  }

  void take(const PlannedJob& plan, const JobRun& run, BatchRow& row) {
    JobRecord& record = remember(plan, run.end, run.message);
    record.figures = run.figures;
    row.message = run.message;
    row.figures = run.figures;
    if (run.utilisation && run.utilisation->members > 0) {
      record.utilisation = row.utilisation = run.utilisation->fraction();
      if (const std::string why = sturz::workflow::low_utilisation(*run.utilisation); !why.empty())
        done_.low_utilisation = plan.job.name + ": " + why;
    }
    row.state = run.end == JobEnd::done          ? RowState::computed
                : run.end == JobEnd::interrupted ? RowState::interrupted
                                                 : RowState::failed;
    if (record.is_finished()) settle_folder(plan);
  }

  void too_much_memory(std::size_t i, const StopReason& reason, Guard& guard) {
    done_.rows[i].state = RowState::failed;
    done_.rows[i].message = reason.text + ". Fewer workers or a coarser spacing need less";
    remember(plans_[i], JobEnd::failed, done_.rows[i].message);
    guard.clear();
  }

  /// Waits for the window where that is wanted. \return false: the batch ends
  bool may_go_on(const StopReason& reason, Guard& guard) {
    if (reason.cause != StopCause::window || !jobs_.spec.wait) return false;
    const auto begin = Clock::now();
    observer_.waits(guard.minutes_to_wait());
    StopReason now = reason;
    while (now.cause == StopCause::window) {
      std::this_thread::sleep_for(std::chrono::milliseconds(200));
      guard.clear();
      now = guard.look();
    }
    waited_s_ += seconds_since(begin);
    return !now;
  }

  JobRecord& remember(const PlannedJob& plan, JobEnd end, const std::string& message) {
    JobRecord& record = state_.jobs[plan.job.name];
    record = plan.record;
    record.end = end;
    record.message = message;
    return record;
  }

  /// Nothing was to do.
  void settle(const PlannedJob& plan) {
    JobRecord& record = state_.jobs[plan.job.name];
    const std::string message = record.message;
    record = plan.record;
    record.message = plan.record.end == JobEnd::done ? "" : message;
    settle_folder(plan);
  }

  void settle_folder(const PlannedJob& plan) {
    if (const std::string why = point_to(plan.job.base, plan.folder); !why.empty())
      observer_.warning(why + "; summary.csv says where the results are.");
    if (jobs_.spec.keep == 0) return;
    for (fs::path& folder : remove_old_results(plan.job.base, plan.folder, jobs_.spec.keep))
      done_.removed.push_back(std::move(folder));
  }

  void measure() {
    done_.wall_s = seconds_since(begin_) - waited_s_;
    done_.core_s = process_s() - process_begin_s_;
    constexpr double too_short_s = 10, enough = 0.5;
    if (done_.wall_s < too_short_s || done_.utilisation() >= enough)
      done_.low_utilisation.clear();
    else if (done_.low_utilisation.empty())
      done_.low_utilisation =
          "reading scenes and making maps take one core, and so do the last members of each job";
  }

  const BatchRequest& request_;
  BatchObserver& observer_;
  const std::atomic<bool>& interrupt_;
  const Clock::time_point begin_ = Clock::now();
  const double process_begin_s_ = process_s();
  double waited_s_ = 0;
  BatchJobs jobs_;
  std::shared_ptr<FolderLock> lock_;
  BatchState state_;
  std::vector<PlannedJob> plans_;
  BatchDone done_;
};

}  // namespace

const char* to_string(RowState state) {
  switch (state) {
    case RowState::unchanged:
      return "unchanged";
    case RowState::computed:
      return "computed";
    case RowState::failed:
      return "failed";
    case RowState::interrupted:
      return "interrupted";
    case RowState::waiting:
      return "waiting";
    case RowState::skipped:
      return "skipped";
  }
  return "";
}

std::size_t BatchDone::count(RowState state) const {
  return static_cast<std::size_t>(std::count_if(
      rows.begin(), rows.end(), [state](const BatchRow& row) { return row.state == state; }));
}

BatchDone run_batch(const BatchRequest& request, BatchObserver& observer,
                    const std::atomic<bool>& interrupt) {
  return Batch(request, observer, interrupt).run();
}

}  // namespace sturz::workflow
