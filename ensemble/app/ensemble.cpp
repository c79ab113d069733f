// SPDX-License-Identifier: Apache-2.0
// sturz ensemble: draw or read the design, run what is not finished, make the maps.
#include "ensemble/app/commands.hpp"
#include "ensemble/app/ensemble_job.hpp"
#include "ensemble/app/exit_codes.hpp"
#include "ensemble/app/interrupt.hpp"
#include "ensemble/app/maps.hpp"
#include "ensemble/app/member_order.hpp"
#include "ensemble/app/progress_bar.hpp"
#include "ensemble/members/runner.hpp"
#include "io/members/member_file.hpp"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>

namespace sturz::app {
namespace {

void announce(const EnsembleJob& job, const EnsembleOptions& options, Console& console) {
  const double seconds = job.scene.description.predicted_seconds;
  const double total =
      seconds * static_cast<double>(job.to_do.size()) / (job.workers * job.threads);
  console.event(nlohmann::json{
      {"event", "start"},
      {"folder", job.folder.root.string()},
      {"members", job.design.n_members()},
      {"finished_before", job.finished_before},
      {"to_do", job.to_do.size()},
      {"workers", job.workers},
      {"threads_per_member", job.threads},
      {"predicted_seconds",
       total}}.dump());
  for (const std::string& warning : job.scene.description.warnings) console.warn(warning);
  for (const std::string& note : job.scene.inputs.notes) console.note(note);
  console.note(command_text(options));
  std::string text = fmt::format("{} members", job.design.n_members());
  if (!options.shard.empty()) text += fmt::format(", shard {}", options.shard);
  if (job.finished_before > 0) text += fmt::format(", {} finished before", job.finished_before);
  if (!job.to_do.empty())
    text += fmt::format(", {} to do on {} workers: at most {}", job.to_do.size(), job.workers,
                        duration_text(total));
  console.say(text);
}

MemberResult run_one(const EnsembleJob& job, std::int64_t k, const std::atomic<bool>& cancel) {
  const Scenario numbers = member_scenario(job.scene.scenario, job.design, k);
  RunControl control;
  control.on_progress = [&cancel](const Progress&) { return !cancel.load(); };
  control.max_wall_s = numbers.numerics.max_wall_time_s;
  return assemble(numbers, job.scene.inputs, k, job.threads).run(control);
}

void keep(const EnsembleJob& job, const MemberResult& result, Console& console) {
  if (result.grid.n_cells() > 0) {
    write_member(job.folder.members(), result);
  } else {  // it failed before it knew its maps
    MemberResult with_grid = result;
    with_grid.grid = job.scene.inputs.hazard_grid;
    write_member(job.folder.members(), with_grid);
  }
  const MemberScalars& s = result.scalars;
  console.note(fmt::format("member {} {}{}{} ({:.1f} s, front {:.0f} m)", result.member,
                           to_string(result.outcome), result.reason.empty() ? "" : ": ",
                           result.reason, s.wall_s, s.front_travel_m));
  console.event(nlohmann::json{{"event", "member"},
                               {"member", result.member},
                               {"outcome", to_string(result.outcome)},
                               {"reason", result.reason},
                               {"wall_s", s.wall_s},
                               {"front_travel_m", s.front_travel_m}}
                    .dump());
}

RunReport run_all(const EnsembleJob& job, Console& console) {
  RunPlan plan;
  plan.members = start_order(job);
  plan.workers = job.workers;
  RunCallbacks callbacks;
  callbacks.run_member = [&job](std::int64_t k, const std::atomic<bool>& cancel) {
    return run_one(job, k, cancel);
  };
  callbacks.store = [&](const MemberResult& result) { keep(job, result, console); };
  callbacks.on_progress = [&](const RunnerProgress& p) {
    console.progress(ensemble_bar(p, job.finished_before, console.columns()));
  };
  RunReport report = run_members(plan, callbacks, interrupt_flag());
  console.clear_progress();
  return report;
}

/// An exit code other than ok when the members did not all come to an end.
int how_it_ended(const EnsembleJob& job, const RunReport& report, Console& console) {
  const std::int64_t finished = job.finished_before + report.progress.n_done;
  const std::int64_t total = job.finished_before + report.progress.n_total;
  if (!report.store_error.empty()) {
    console.error(fmt::format("{} The {} finished members are kept; the same command will resume.",
                              report.store_error, finished));
    return usage_or_scenario_error;
  }
  if (report.interrupted) {
    console.event(nlohmann::json{{"event", "interrupted"}, {"finished", finished}}.dump());
    console.warn(
        fmt::format("interrupted with {} of {} members finished. Resume with the same "
                    "command.",
                    finished, total));
    return interrupted;
  }
  return ok;
}

}  // namespace

int ensemble_command(const EnsembleOptions& options, Console& console) {
  const auto begin = std::chrono::steady_clock::now();
  EnsembleJob job = prepare_ensemble(options, console);
  announce(job, options, console);
  watch_for_interrupts();
  const RunReport report = run_all(job, console);
  if (const int code = how_it_ended(job, report, console); code != ok) return code;
  if (!options.shard.empty()) {
    console.event(nlohmann::json{{"event", "shard_done"}, {"failed", report.failed.size()}}.dump());
    console.say(fmt::format("Shard {} is finished. When all are: sturz merge {}", options.shard,
                            job.folder.root.string()));
    return ok;
  }
  job.manifest.compute_s +=
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const MapsMade made = make_maps(job.folder, job.manifest, job.scene.scenario, job.design,
                                  job.scene.inputs.elevation.get(), console);
  return verdict(made, job.folder, job.manifest, job.scene.scenario.ensemble.max_failed_fraction,
                 console);
}

}  // namespace sturz::app
