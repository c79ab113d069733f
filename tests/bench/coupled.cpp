// SPDX-License-Identifier: Apache-2.0
// Grains in a liquid beside the same two sets without each other.
#include "tests/bench/commands.hpp"
#include "tests/bench/slices.hpp"
#include "tests/support/liquid/immersed_grains.hpp"

#include <fmt/core.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace sturz::bench {
namespace {

test::ImmersedGrains box(int across, bool coupled, double slip) {
  test::ImmersedGrains g;
  g.spacing = 0.1;
  g.grain_length = g.liquid_length = g.grain_height = g.liquid_height = across * g.spacing;
  g.across = across;
  g.drag_diameter = 1;  // they go on slipping past each other
  g.sound_speed = 60;
  g.coupled = coupled;
  g.slip = {slip, 0, 0};
  return g;
}

Table passes_of(int across, const test::HandMade& made, double updates) {
  Table t(fmt::format("passes_{}", across),
          fmt::format("Passes of grains in a liquid in slip, 2 x {}^3, wall time", across),
          {{"pass", "pass"}, {"ns_per_update", "ns/particle-update"}});
  for (const PassTime& p : made.step.timings())
    t.add({cell(p.name), cell(1e9 * p.seconds / updates, 1)});
  return t;
}

}  // namespace

Report coupled(const Options& options) {
  Report report;
  Table ratio("coupled",
              "A step of both over a step of each alone, one core, thread time; median (range)",
              {{"particles", "particles"},
               {"weights", "weights"},
               {"ratio", "ratio"},
               {"us", "us/step"},
               {"slices", "slices of 16 steps"}});
  std::vector<Table> passes;
  for (const int across : {16, 32}) {
    if (options.quick && across > 16) continue;
    for (const double slip : {0.0, 12.0}) {
      test::HandMade both = test::immersed(box(across, true, slip));
      test::HandMade apart = test::immersed(box(across, false, slip));
      cpu_slice(both.state, both.step), cpu_slice(apart.state, apart.step);
      std::vector<double> over, us;
      for (int k = 0; k < options.pairs; ++k) {
        const double one = cpu_slice(both.state, both.step);
        over.push_back(one / cpu_slice(apart.state, apart.step));
        us.push_back(1e6 * one / slice_steps);
      }
      const std::size_t n = both.state.n_particles();
      const Summary cost = summarize(over);
      const char* const weights = slip > 0 ? "new weights" : "kept weights";
      report.tell(fmt::format("{} particles, {}: both / each alone", n, weights), cost,
                  fmt::format("Grains in a liquid, {} particles, {}: a step of both costs {:.2f} "
                              "times the steps of each alone.",
                              n, weights, cost.median),
                  false);
      ratio.add({cell(n), cell(std::string(slip > 0 ? "new in every step" : "kept")),
                 range_cell(cost, 2), range_cell(summarize(us), 0),
                 cell(static_cast<int>(over.size()))});
      if (slip > 0)
        passes.push_back(
            passes_of(across, both, static_cast<double>(n) * slice_steps * (options.pairs + 1)));
    }
  }
  report.tables.push_back(std::move(ratio));
  for (Table& t : passes) report.tables.push_back(std::move(t));
  return report;
}

}  // namespace sturz::bench
