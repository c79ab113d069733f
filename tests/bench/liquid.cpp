// SPDX-License-Identifier: Apache-2.0
// A dam break of liquid, end to end through Simulation::run, and pass by pass.
#include "engine/simulation/parts.hpp"
#include "tests/bench/commands.hpp"
#include "tests/bench/measure/peers.hpp"
#include "tests/bench/slices.hpp"
#include "tests/support/liquid/impact_tank.hpp"

#include <fmt/core.h>

#include <string>
#include <utility>

namespace sturz::bench {
namespace {

/// Simulated before the clock runs: by then the column has fallen and its front is on its way [s].
constexpr double warm_s = 0.1;

struct Dam {
  const char* name;
  int across;  ///< particles over the tank's width
};

std::vector<double> millions(std::vector<double> v) {
  for (double& x : v) x *= 1e-6;
  return v;
}

Table passes_of(const Dam& c, const TimedRun& run) {
  Table t(fmt::format("passes_{}", c.across),
          fmt::format("Passes of the dam break, {}, wall time", c.name),
          {{"pass", "pass"}, {"share", "share %"}, {"ns_per_update", "ns/particle-update"}});
  for (const PassTime& p : run.passes)
    t.add({cell(p.name), cell(100 * p.seconds / run.total_wall_s(), 1),
           cell(1e9 * p.seconds / run.total_updates(), 1)});
  return t;
}

}  // namespace

Report liquid(const Options& options) {
  Report report;
  Table speed("liquid",
              "Dam break of SPHERIC test 2 after 0.1 s, one core, thread time; median (range)",
              {{"scene", "scene"},
               {"particles", "particles"},
               {"m_updates_s", "M updates/s/core"},
               {"slices", "slices of 16 steps"}});
  std::vector<Table> passes;
  std::string scene;
  double ours = 0;
  for (const Dam& c : {Dam{"coarse", 20}, Dam{"fine", 45}}) {
    if (options.quick && c.across > 20) continue;
    Simulation member = test::simulation_of(test::ImpactTank::scene(c.across), 10);
    SimulationParts& parts = member.parts();
    while (parts.state.time < warm_s) advance(parts.state, parts.step);
    const TimedRun run = time_run(member, options.pairs, {});
    const Summary rate = summarize(run.updates_per_s());
    const std::string name = fmt::format("dam break, {}", c.name);
    report.tell(name + ": updates/s/core", rate, peers_sentence(name, rate.median));
    ours = rate.median, scene = name;
    speed.add({cell(c.name), cell(parts.state.grains().size()),
               range_cell(summarize(millions(run.updates_per_s())), 2),
               cell(static_cast<int>(run.cpu_s.size()))});
    passes.push_back(passes_of(c, run));
  }
  report.tables.push_back(std::move(speed));
  report.tables.push_back(peers_table(scene, ours));
  for (Table& t : passes) report.tables.push_back(std::move(t));
  return report;
}

}  // namespace sturz::bench
