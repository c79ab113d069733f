// SPDX-License-Identifier: Apache-2.0
// Whole small members by the runner that `sturz ensemble` uses, on one and on all workers.
#include "engine/core/error.hpp"
#include "ensemble/members/runner.hpp"
#include "scenarios/assembly/assemble.hpp"
#include "tests/bench/commands.hpp"
#include "tests/bench/measure/clocks.hpp"
#include "tests/bench/measure/machine.hpp"
#include "tests/bench/scenes.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <mutex>
#include <numeric>
#include <thread>

namespace sturz::bench {
namespace {

/// What a run of the whole ensemble took.
struct EnsembleTime {
  double wall_s = 0;
  double members_wall_s = 0;  ///< sum over members, assemble included
  double members_cpu_s = 0;
  double idle_end_s = 0;  ///< workers that found no member left, until the last member was done
  double particles = 0, steps = 0;  ///< means over members
};

/// Adds up the members' own times, and when each worker was done with its last one.
class MemberClocks {
 public:
  template <class Work>
  auto measure(Work&& work) {
    const double cpu = thread_seconds(), wall = wall_seconds();
    auto result = work();
    const double now = wall_seconds(), cpu_s = thread_seconds() - cpu;
    const std::lock_guard guard(lock_);
    cpu_s_ += cpu_s;
    wall_s_ += now - wall;
    last_[std::this_thread::get_id()] = now;
    return result;
  }
  void write(EnsembleTime& out) const {
    out.members_cpu_s = cpu_s_;
    out.members_wall_s = wall_s_;
    double end = 0;
    for (const auto& [worker, at] : last_) end = std::max(end, at);
    for (const auto& [worker, at] : last_) out.idle_end_s += end - at;
  }

 private:
  std::mutex lock_;
  double cpu_s_ = 0, wall_s_ = 0;
  std::map<std::thread::id, double> last_;
};

EnsembleTime run_ensemble(const Scene& scene, int members, int workers) {
  EnsembleTime out;
  MemberClocks clocks;
  RunCallbacks callbacks;
  callbacks.run_member = [&](std::int64_t k, const std::atomic<bool>&) {
    return clocks.measure(
        [&] { return assemble(varied(scene.scenario, k), scene.inputs, k, 1).run(); });
  };
  callbacks.store = [&](const MemberResult& r) {
    out.particles += r.scalars.n_particles / members;
    out.steps += r.scalars.n_steps / members;
  };
  RunPlan plan;
  plan.members.resize(members);
  std::iota(plan.members.begin(), plan.members.end(), 0);
  plan.workers = workers;
  const double begin = wall_seconds();
  const RunReport report = run_members(plan, callbacks, std::atomic<bool>{false});
  out.wall_s = wall_seconds() - begin;
  clocks.write(out);
  require(report.complete() && report.failed.empty(),
          "a member of the ensemble failed: " +
              (report.failed.empty() ? "unknown reason" : report.failed.front().reason));
  return out;
}

void add_rows(const Scene& scene, const Options& options, int members, Table& table,
              Report& report) {
  const int all = options.threads > 0 ? options.threads : available_cores();
  const EnsembleTime one = run_ensemble(scene, members, 1);
  auto add = [&](int workers, const EnsembleTime& t) {
    table.add({cell(scene.name), cell(members), cell(t.particles, 0), cell(t.steps, 0),
               cell(workers), cell(t.wall_s, 2), cell(t.members_cpu_s / members, 2),
               cell(3600 * members / t.wall_s, 0), cell(one.wall_s / t.wall_s / workers, 3),
               cell(one.members_cpu_s / t.members_cpu_s, 3),
               cell(100 * (workers * t.wall_s - t.idle_end_s) / t.members_wall_s - 100, 2),
               cell(100 * t.idle_end_s / (workers * t.wall_s), 1),
               cell(1e-6 * t.particles * t.steps * members / t.members_cpu_s, 2)});
  };
  add(1, one);
  if (all < 2) return;
  const EnsembleTime many = run_ensemble(scene, members, all);
  add(all, many);
  const double efficiency = one.wall_s / many.wall_s / all;
  report.tell(fmt::format("{}: efficiency of {} workers", scene.name, all), summarize({efficiency}),
              fmt::format("{}: {} workers do {:.2f} times the members of one, {:.0f} an hour.",
                          scene.name, all, all * efficiency, 3600 * members / many.wall_s));
}

}  // namespace

Report ensemble(const Options& options) {
  Report report;
  Table table("ensemble", "Members by the runner, results kept in memory",
              {{"scene", "scene"},
               {"members", "members"},
               {"particles", "particles"},
               {"steps", "steps"},
               {"workers", "workers"},
               {"wall_s", "wall s"},
               {"cpu_s_per_member", "thread s/member"},
               {"members_per_hour", "members/hour"},
               {"efficiency", "efficiency"},
               {"cpu_efficiency", "thread time 1/all"},
               {"overhead_percent", "overhead %"},
               {"idle_end_percent", "idle end %"},
               {"m_updates_s", "M updates/s/core"}});
  const double end_time = options.quick ? 4 : options.end_time_s;
  add_rows(column_slide(2'500, end_time), options, 4 * options.members, table, report);
  add_rows(small_member(end_time), options, options.members, table, report);
  report.tables.push_back(std::move(table));
  report.notes = {
      fmt::format("{:.0f} s of flow a member at most, friction of the bed varied by +-10 % with "
                  "the member's number.",
                  end_time),
      "Efficiency: wall time on one worker over workers x wall time. Overhead: workers x wall time "
      "beyond the members' own wall time and the idle end, when fewer members than workers are "
      "left.",
      "Thread time 1/all: below one where workers slow each other down by caches, memory or "
      "clock. Nothing is written to files."};
  return report;
}

}  // namespace sturz::bench
