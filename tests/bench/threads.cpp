// SPDX-License-Identifier: Apache-2.0
// One big member on one and on all processors.
#include "engine/simulation/parts.hpp"
#include "scenarios/assembly/assemble.hpp"
#include "tests/bench/commands.hpp"
#include "tests/bench/measure/machine.hpp"
#include "tests/bench/measure/pairs.hpp"
#include "tests/bench/scenes.hpp"
#include "tests/bench/slices.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace sturz::bench {
namespace {

bool same_bits(const ParticleSet& a, const ParticleSet& b) {
  return a.x == b.x && a.y == b.y && a.z == b.z && a.vx == b.vx && a.vy == b.vy && a.vz == b.vz;
}

std::vector<int> thread_counts(const Options& options) {
  const int most = options.threads > 0 ? options.threads : available_cores();
  std::vector<int> counts;
  for (int n = 2; n < most; n *= 2) counts.push_back(n);
  if (most > 1) counts.push_back(most);
  return counts;
}

}  // namespace

Report threads(const Options& options) {
  Report report;
  Table table("threads", "One member on several threads, wall time of alternating slices",
              {{"scene", "scene"},
               {"particles", "particles"},
               {"threads", "threads"},
               {"one_ms", "one thread ms/step"},
               {"many_ms", "these threads ms/step"},
               {"speed_up", "speed-up [95 %]"},
               {"m_updates_s", "M updates/s"},
               {"same_bits", "same bits"}});
  for (const Scene& scene : {dense_slide(options.quick ? 12'000 : 51'000), column_slide(10'000)})
    for (int n : thread_counts(options)) {
      Simulation one = assemble(scene.scenario, scene.inputs, 0, 1);
      Simulation many = assemble(scene.scenario, scene.inputs, 0, n);
      SimulationParts &a = one.parts(), &b = many.parts();
      const double particles = static_cast<double>(a.state.grains().size());
      const Pairs pairs = alternate(
          options.pairs, [&] { return wall_slice(a.state, a.step); },
          [&] { return wall_slice(b.state, b.step); });
      const double ms = 1e3 / slice_steps;
      const Summary slow = summarize(pairs.a), fast = summarize(pairs.b);
      const Summary gain = pairs.ratio();
      report.tell(fmt::format("{}: speed-up on {} threads", scene.name, n), gain,
                  fmt::format("{}: one member on {} threads is {:.2f} times as fast as on one.",
                              scene.name, n, gain.median));
      table.add({cell(scene.name), cell(a.state.grains().size()), cell(n),
                 cell(ms * slow.median, 2), cell(ms * fast.median, 2), interval_cell(gain, 2),
                 cell(1e-6 * slice_steps * particles / fast.median, 2),
                 yes_no(same_bits(a.state.grains(), b.state.grains()))});
    }
  report.tables.push_back(std::move(table));
  report.notes = {"Wall time: worth something on a quiet machine only. Without peak maps."};
  return report;
}

}  // namespace sturz::bench
