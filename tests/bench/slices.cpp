// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/slices.hpp"

#include "engine/core/error.hpp"
#include "engine/simulation/parts.hpp"
#include "tests/bench/measure/clocks.hpp"
#include "tests/bench/measure/statistics.hpp"

#include <algorithm>
#include <numeric>

namespace sturz::bench {
namespace {

/// Cuts a run into slices from within its progress callback.
class Cutter {
 public:
  Cutter(const Simulation& member, int n, const std::function<double()>& between, TimedRun& out)
      : step_(member.parts().step), n_(n), between_(between), out_(out) {}

  bool operator()(const Progress& p) {
    const double cpu = thread_seconds(), wall = wall_seconds();
    const double other = between_ ? between_() : 0;
    if (!warm_) {
      warm_ = true;
      out_.passes = step_.timings();
    } else {
      out_.cpu_s.push_back(cpu - cpu_begin_);
      out_.wall_s.push_back(wall - wall_begin_);
      out_.updates.push_back(double(p.n_steps - steps_begin_) * double(p.n_particles));
      out_.other_s.push_back(other);
    }
    steps_begin_ = p.n_steps;
    const bool more = static_cast<int>(out_.cpu_s.size()) < n_;
    cpu_begin_ = thread_seconds();
    wall_begin_ = wall_seconds();
    return more;
  }

 private:
  const Step& step_;
  int n_;
  const std::function<double()>& between_;
  TimedRun& out_;
  bool warm_ = false;
  std::size_t steps_begin_ = 0;
  double cpu_begin_ = 0, wall_begin_ = 0;
};

template <class Clock>
double slice(Clock&& clock, State& state, Step& step) {
  return timed(clock, [&] {
    for (int k = 0; k < slice_steps; ++k) advance(state, step);
  });
}

}  // namespace

std::vector<double> TimedRun::updates_per_s() const { return ratios(updates, cpu_s); }

double TimedRun::total_wall_s() const { return std::accumulate(wall_s.begin(), wall_s.end(), 0.0); }

double TimedRun::total_updates() const {
  return std::accumulate(updates.begin(), updates.end(), 0.0);
}

TimedRun time_run(Simulation& member, int n, const std::function<double()>& between) {
  TimedRun out;
  RunControl control;
  control.progress_every_s = 0;
  control.on_progress = Cutter(member, n, between, out);
  const MemberResult result = member.run(control);
  expect(result.outcome == Outcome::cancelled && static_cast<int>(out.cpu_s.size()) == n,
         "the scene moves for as long as it is timed");
  // Only the passes' time within the slices; the last slice ends where the run was cancelled.
  const auto& at_end = member.parts().step.timings();
  for (std::size_t k = 0; k < at_end.size(); ++k)
    out.passes[k].seconds = at_end[k].seconds - out.passes[k].seconds;
  return out;
}

void advance(State& state, Step& step) {
  const double limit = step.limit(state).dt;
  step.apply(state, state.previous_dt > 0 ? std::min(limit, 1.05 * state.previous_dt) : limit);
}

double cpu_slice(State& state, Step& step) { return slice(thread_seconds, state, step); }
double wall_slice(State& state, Step& step) { return slice(wall_seconds, state, step); }

}  // namespace sturz::bench
