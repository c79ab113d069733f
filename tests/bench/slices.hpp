// SPDX-License-Identifier: Apache-2.0
/// Slices of a member's run: the unit of all timings.
#pragma once

#include "engine/effects/state.hpp"
#include "engine/effects/step.hpp"
#include "engine/simulation/simulation.hpp"

#include <functional>
#include <vector>

namespace sturz::bench {

/// Steps of a slice: each then holds one sweep that smooths stress, which comes every 16 steps.
/// Simulation::run looks up at the same interval, so its slices are cut there.
inline constexpr int slice_steps = 16;

struct TimedRun {
  std::vector<double> cpu_s, wall_s;  ///< of each slice
  std::vector<double> updates;        ///< particles x steps of each slice
  std::vector<double> other_s;        ///< what `between` returned after each slice
  std::vector<PassTime> passes;       ///< by the wall clock, over all slices

  std::vector<double> updates_per_s() const;  ///< by thread time
  double total_wall_s() const;
  double total_updates() const;
};

/// Runs a fresh member by Simulation::run (peak maps, stop rule and bookkeeping included) for `n`
/// slices after one that is thrown away.
/// \param between called after each slice, outside its time
TimedRun time_run(Simulation&, int n, const std::function<double()>& between);

/// One step at the limit of the passes, growing by a twentieth at most, as Simulation::run does.
void advance(State&, Step&);
/// Thread seconds of a slice without what surrounds the step.
double cpu_slice(State&, Step&);
double wall_slice(State&, Step&);

}  // namespace sturz::bench
