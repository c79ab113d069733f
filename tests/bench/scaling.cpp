// SPDX-License-Identifier: Apache-2.0
// The same box of grains in ever finer particles.
#include "engine/simulation/parts.hpp"
#include "scenarios/assembly/assemble.hpp"
#include "tests/bench/commands.hpp"
#include "tests/bench/measure/memory.hpp"
#include "tests/bench/scenes.hpp"
#include "tests/bench/slices.hpp"

#include <fmt/core.h>

namespace sturz::bench {
namespace {

constexpr double sizes[] = {1'000, 2'000, 5'000, 10'000, 50'000, 200'000, 1'000'000};
constexpr double base_size = 2'000;

struct Sized {
  double size = 0;
  Simulation member;
  std::vector<double> ns_per_update;
};

std::vector<Sized> members_up_to(double most) {
  std::vector<Sized> out;
  for (double size : sizes) {
    if (size > most) continue;
    const Scene scene = dense_slide(size);
    out.push_back({size, assemble(scene.scenario, scene.inputs, 0, 1), {}});
  }
  return out;
}

void time_slice(Sized& s, bool keep) {
  State& state = s.member.parts().state;
  const double updates = slice_steps * static_cast<double>(state.grains().size());
  const double seconds = cpu_slice(state, s.member.parts().step);
  if (keep) s.ns_per_update.push_back(1e9 * seconds / updates);
}

}  // namespace

Report scaling(const Options& options) {
  std::vector<Sized> members = members_up_to(options.quick ? 10'000 : options.most);
  // Round after round over all sizes: the core's speed drifts alike for all of them.
  for (int round = -1; round < options.pairs; ++round)
    for (Sized& s : members) time_slice(s, round >= 0);
  const Sized* base = nullptr;
  for (const Sized& s : members)
    if (s.size == base_size) base = &s;

  Report report;
  Table table("scaling", "Cost of a particle-update in the dense slide, one core, thread time",
              {{"size", "asked for"},
               {"particles", "particles"},
               {"layers", "layers"},
               {"ns_per_update", "ns/update, median (range)"},
               {"relative", "relative to 2k [95 %]"},
               {"bytes", "bytes/particle"}});
  for (const Sized& s : members) {
    const SimulationParts& parts = s.member.parts();
    const Cell relative =
        base ? interval_cell(summarize(ratios(s.ns_per_update, base->ns_per_update)), 2)
             : cell("-");
    table.add({cell(static_cast<std::size_t>(s.size)), cell(parts.state.grains().size()),
               cell(parts.facts.release.layers, 1), range_cell(summarize(s.ns_per_update), 0),
               relative, cell(memory_per_particle(parts.state, parts.step).total(), 0)});
  }
  report.tables.push_back(std::move(table));
  report.notes = {fmt::format(
      "{} slices of {} steps from the release on, in turn over all sizes, without peak maps. Few "
      "layers have fewer neighbours each, so the first rows are cheaper for that alone.",
      options.pairs, slice_steps)};
  return report;
}

}  // namespace sturz::bench
