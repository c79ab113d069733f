// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/members/run_ensemble.hpp"

#include "ensemble/workflow/folder/folder_members.hpp"
#include "ensemble/workflow/members/member_order.hpp"
#include "ensemble/workflow/members/member_summary.hpp"

#include <chrono>
#include <utility>

namespace sturz::workflow {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

}  // namespace

MemberResult run_member(const EnsembleJob& job, std::int64_t member,
                        const std::atomic<bool>& cancel) {
  const Scenario numbers = member_scenario(job.scene.scenario, job.design, member);
  RunControl control;
  control.on_progress = [&cancel](const Progress&) { return !cancel.load(); };
  control.max_wall_s = numbers.numerics.max_wall_time_s;
  return job.scene.ground->computed([&](const SceneInputs& inputs) {
    return assemble(numbers, inputs, member, job.threads).run(control);
  });
}

void store_member(const EnsembleJob& job, const MemberResult& result) {
  const MemberOrigin origin = origin_of(job.manifest, job.design, result.member);
  if (result.grid.n_cells() > 0) {
    job.writer->write(result, origin);
  } else {  // it failed before it knew its maps
    MemberResult with_grid = result;
    with_grid.grid = job.scene.inputs.hazard_grid;
    job.writer->write(with_grid, origin);
  }
}

MembersRun run_ensemble(const EnsembleJob& job, Observer& observer,
                        const std::atomic<bool>& cancel) {
  RunPlan plan;
  plan.members = start_order(job);
  plan.workers = job.workers;
  RunCallbacks callbacks;
  MembersRun run;
  callbacks.run_member = [&job](std::int64_t member, const std::atomic<bool>& stop) {
    return run_member(job, member, stop);
  };
  callbacks.store = [&](const MemberResult& result) {
    const auto begin = Clock::now();
    job.lock->require_ours();
    store_member(job, result);
    run.storing_s += seconds_since(begin);
    run.computed.push_back(summary_of(result));
    observer.member_stored(result);
  };
  callbacks.on_progress = [&](const RunnerProgress& progress) {
    observer.ensemble_progress(progress, job.finished_before);
  };
  const auto begin = Clock::now();
  RunReport report = run_members(plan, callbacks, cancel);
  run.wall_s = seconds_since(begin);
  run.finished = job.finished_before + report.progress.n_done;
  run.total = job.finished_before + report.progress.n_total;
  run.failed = std::move(report.failed);
  run.interrupted = report.interrupted;
  run.stop_error = std::move(report.stop_error);
  try {
    job.writer->sync();
  } catch (const SetupError& error) {
    if (run.stop_error.empty()) run.stop_error = error.what();
  }
  return run;
}

}  // namespace sturz::workflow
