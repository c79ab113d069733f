// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/batch/job_runner.hpp"

#include "engine/core/cancel.hpp"
#include "engine/core/error.hpp"
#include "ensemble/workflow/members/run_ensemble.hpp"
#include "ensemble/workflow/members/single_run.hpp"
#include "ensemble/workflow/results/maps.hpp"

#include <fmt/core.h>
#include <malloc.h>

#include <chrono>
#include <exception>
#include <new>

namespace sturz::workflow {
namespace {

EnsembleRequest request_of(const PlannedJob& plan, const JobLimits& limits) {
  EnsembleRequest request;
  request.scene = plan.job.scene;
  request.folder = plan.folder;
  request.max_cores = limits.max_workers;
  request.max_memory_bytes = limits.max_memory_bytes;
  request.retry_failed = limits.retry_failed;
  request.command = limits.command;
  return request;
}

std::string too_many_text(const MapsMade& made) {
  return fmt::format(
      "{} of {} members failed, more than the accepted share (ensemble.max_failed_fraction = {}); "
      "their reasons are in members.csv",
      made.failed(), made.finished, made.max_failed_fraction);
}

void compute_ensemble(const PlannedJob& plan, const JobLimits& limits, Observer& observer,
                      const std::atomic<bool>& cancel, JobRun& out) {
  EnsembleJob job = prepare_ensemble(request_of(plan, limits), observer);
  for (const std::string& warning : job.scene.description.warnings) observer.warning(warning);
  const MembersRun run = run_ensemble(job, observer, cancel);
  out.utilisation = utilisation_of(job, run);
  out.message = fmt::format("{} of {} members finished", run.finished, run.total);
  if (!run.stop_error.empty()) throw SetupError(run.stop_error);
  if (run.interrupted) throw Cancelled();
  const MapsMade made = make_maps(job, observer, CancelFlag(cancel));
  const bool too_many = made.too_many_failed() || made.valid == 0;
  out.message = too_many ? too_many_text(made) : "";
  out.figures = figures_of(plan.folder, observer, CancelFlag(cancel));
  out.end = too_many ? JobEnd::too_many_failed : JobEnd::done;
}

void compute_single(const PlannedJob& plan, const JobLimits& limits, Observer& observer,
                    const std::atomic<bool>& cancel, JobRun& out) {
  RunRequest request;
  request.scene = plan.job.scene;
  request.folder = plan.folder;
  request.threads = limits.max_workers;
  request.command = limits.command;
  request.replace = true;
  SingleRun run = prepare_run(request, observer);
  for (const std::string& warning : run.scene.description.warnings) observer.warning(warning);
  out.message = "0 of 1 members finished";
  const MemberResult result = compute_run(run, observer, cancel);
  if (result.outcome == Outcome::cancelled) throw Cancelled();
  store_run(run, result);
  out.figures = figures_of(plan.folder, observer, CancelFlag(cancel));
  const bool valid = is_valid(result.outcome);
  out.message = valid ? "" : fmt::format("{}: {}", to_string(result.outcome), result.reason);
  out.end = valid ? JobEnd::done : JobEnd::too_many_failed;
}

}  // namespace

JobRun run_job(const PlannedJob& plan, const JobLimits& limits, Observer& observer,
               const std::atomic<bool>& cancel) {
  const auto begin = std::chrono::steady_clock::now();
  JobRun out;
  try {
    if (plan.job.single_run)
      compute_single(plan, limits, observer, cancel, out);
    else
      compute_ensemble(plan, limits, observer, cancel, out);
  } catch (const Cancelled&) {
    out.end = JobEnd::interrupted;
  } catch (const SetupError& problem) {
    out.end = JobEnd::failed;
    out.message = at_places_in_list(problem.what(), plan.job);
  } catch (const std::bad_alloc&) {
    out.end = JobEnd::failed;
    out.message =
        "out of memory; what is finished is kept. A coarser spacing or fewer workers "
        "need less";
  } catch (const std::exception& problem) {
    out.end = JobEnd::failed;
    out.message =
        fmt::format("{} (this should not have happened; please report it)", problem.what());
  }
  out.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  ::malloc_trim(0);  // the next job's memory is measured without this one's
  return out;
}

}  // namespace sturz::workflow
