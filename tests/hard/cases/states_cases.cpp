// SPDX-License-Identifier: Apache-2.0
// I5, I6, I13, I15, I16: grains on the borders between their states, and the particles that leave.
#include "engine/effects/fields.hpp"
#include "engine/effects/motion/accounts.hpp"
#include "engine/effects/motion/effect.hpp"
#include "io/site/scene_inputs.hpp"
#include "scenarios/assembly/assemble.hpp"
#include "scenarios/catalogue.hpp"
#include "tests/hard/cases/cases.hpp"
#include "tests/hard/random_members.hpp"
#include "tests/hard/survival.hpp"
#include "tests/physics/verification.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

namespace sturz::test {
namespace {

/// Grains without weight, 8 x 8 x 8 of them 1 m apart, high over level ground.
Simulation floating_box() {
  Scenario s;
  s.formulation = Formulation::full_stress;
  s.terrain.synthetic =
      SyntheticTerrain{"plane", 2, {{"slope_deg", 0}, {"length_m", 200}, {"width_m", 200}}};
  s.release.box = ReleaseBox{{-4, 4}, {-4, 4}};
  s.release.thickness_m = Uncertain(8);
  s.grains.emplace().friction.emplace();
  s.grains->solid_fraction = 0.6;
  s.numerics.spacing_m = 1;
  Simulation simulation = build(with_states(std::move(s), States::all));
  SimulationParts& parts = simulation.parts();
  parts.state.gravity = 0;
  for (double& z : parts.state.grains().z) z += 60;
  for (const FieldKey* key : {&fields::stress, &fields::density_change})
    for (auto& column : parts.state.grains().components(*key))
      std::fill(column.begin(), column.end(), 0.0);
  return simulation;
}

struct Flips {
  double mean = 0, most = 0;  ///< changes of name, for each grain and cycle
};

/// Blows the box up and presses it together, so that the fraction goes from `low` to `high` and
/// back in every cycle. A tremor of twenty times the frequency lies on it: the fraction then
/// crosses every border several times on the way up and on the way down, unless hysteresis holds
/// the state. \param tremor  amplitude of ln(fraction)
Flips breathe(double low, double high, int cycles, double period_s, double tremor) {
  Simulation simulation = floating_box();
  SimulationParts& parts = simulation.parts();
  ParticleSet& p = parts.state.grains();
  const double start = 0.6, middle = std::sqrt(low * high), swing = 0.5 * std::log(high / low);
  std::vector<double> changes(p.size()), before(p.size(), -1);
  const double lead_s = period_s;  // from the release to the middle of the swing
  while (parts.state.time < lead_s + cycles * period_s) {
    const double t = parts.state.time - lead_s, turn = 2 * std::numbers::pi / period_s;
    // d ln(fraction)/dt = -3 a
    const double a =
        t < 0
            ? -std::log(middle / start) / (3 * lead_s)
            : -(swing * turn * std::cos(turn * t) + 20 * tremor * turn * std::cos(20 * turn * t)) /
                  3;
    for (std::size_t i = 0; i < p.size(); ++i)
      p.vx[i] = a * p.x[i], p.vy[i] = a * p.y[i], p.vz[i] = a * (p.z[i] - 64);
    simulation.step();
    const auto& state = p.flags(fields::state);
    for (std::size_t i = 0; i < p.size(); ++i) {
      double& last = before[p.id[i]];
      if (t > 0 && last >= 0 && last != state[i]) ++changes[p.id[i]];
      last = state[i];
    }
  }
  Flips flips;
  for (double n : changes) {
    flips.mean += n / static_cast<double>(changes.size()) / cycles;
    flips.most = std::max(flips.most, n / cycles);
  }
  return flips;
}

double in_flight(const State& s) {
  return static_cast<double>(s.grains().size() - s.grains().n_listed) /
         static_cast<double>(s.grains().size());
}

}  // namespace

CaseReport breathing(States) {
  // A swing over both ends of a hysteresis changes a name twice a cycle, no more and no less:
  // grains leave the dense state below 0.58 and come back above 0.60, particles leave below 0.02
  // and come back above 0.03 (B.9). The tremor of 0.8 % (0.005 at 0.6; 15 % at 0.02) is narrower
  // than the hysteresis, and fast enough to turn back and cross a single border several times.
  // Between 0.585 and 0.61 nothing but the start changes a name: once in all five cycles. Corner
  // grains follow how full their support is.
  const Flips wide = breathe(0.565, 0.62, 5, 2, 0.008), narrow = breathe(0.587, 0.61, 5, 2, 0.002),
              thin = breathe(0.01, 0.15, 3, 4, 0.15);
  return {{at_most("changes a grain and cycle, 0.565 to 0.62, mean", wide.mean, 2.1),
           at_least("changes a grain and cycle, 0.565 to 0.62, least mean", wide.mean, 1.7),
           at_most("changes a grain and cycle, 0.565 to 0.62, most", wide.most, 3),
           at_most("changes a grain and cycle, 0.587 to 0.61, mean", narrow.mean, 0.25),
           at_most("changes a grain and cycle, 0.587 to 0.61, most", narrow.most, 1),
           at_most("changes a grain and cycle, 0.01 to 0.15, mean", thin.mean, 2.1),
           at_least("changes a grain and cycle, 0.01 to 0.15, least mean", thin.mean, 1.7),
           at_most("changes a grain and cycle, 0.01 to 0.15, most", thin.most, 3)},
          512,
          0};
}

CaseReport pressed_to_the_limit(States states) {
  Scenario s = thin_sheet(10);
  s.terrain.synthetic->parameters["slope_deg"] = 0;
  s.grains->solid_fraction = 0.62;
  s.release.velocity_m_s = {0, 0, -10};
  s.numerics.end_time_s = 3;
  s = with_states(std::move(s), states);
  s.grains->states->max_fraction = Uncertain(0.64);
  const double estimate = describe(s, load_scene_inputs(s)).dt_s;
  Simulation simulation = build(s);
  for (double& z : simulation.parts().state.grains().z) z += 3;
  simulation.parts().facts.release.top_m += 3;
  const Survival survived = survive(std::move(simulation), 10, estimate);
  return {checks_of(survived), survived.particles, survived.seconds};
}

CaseReport jet_breaks_up(States states) {
  Scenario s = cliff(1);
  s.terrain.synthetic =
      SyntheticTerrain{"plane", 2, {{"slope_deg", 0}, {"length_m", 400}, {"width_m", 400}}};
  s.release.box = ReleaseBox{{-4, 4}, {-4, 4}};
  s.release.thickness_m = Uncertain(8);
  s.release.velocity_m_s = {20, 0, 20};
  s.numerics.end_time_s = 3.5;
  Simulation simulation = build(with_states(std::move(s), states));
  ParticleSet& p = simulation.parts().state.grains();
  const MeanMotion before = mean_motion(p);
  for (std::size_t i = 0; i < p.size(); ++i) {
    p.vx[i] += 1.5 * (p.x[i] - before.x), p.vy[i] += 1.5 * (p.y[i] - before.y);
    p.vz[i] += 1.5 * (p.z[i] - before.z);
    p.z[i] += 10;
  }
  refresh_motion(simulation.parts().state, simulation.parts().state.grains(), 0);
  simulation.parts().facts.release.top_m += 10;
  double most_in_flight = 0, off = 0;
  Survival survived = survive(std::move(simulation), 40, 0, [&](const SimulationParts& parts) {
    most_in_flight = std::max(most_in_flight, in_flight(parts.state));
    const MeanMotion m = mean_motion(parts.state.grains());
    const double t = parts.state.time;
    off = std::max({off, std::abs(m.x - before.x - 20 * t), std::abs(m.y - before.y),
                    std::abs(m.z - before.z - 10 - 20 * t + 0.5 * gravity_m_s2 * t * t)});
  });
  std::vector<Check> checks = checks_of(survived, true);
  checks.push_back(at_least("share that is isolated", most_in_flight, 0.9));
  checks.push_back(at_most("centre of mass off its parabola, dx", off, 0.01));
  return {std::move(checks), survived.particles, survived.seconds};
}

CaseReport masses_mix(States states) {
  const HardMember m = RandomMembers::on_steep_ground(states).member(100);
  Simulation simulation = assemble(m.scenario, m.inputs, 100, 1);
  const auto& mass = simulation.parts().state.grains().mass;
  const auto [least, most] = std::minmax_element(mass.begin(), mass.end());
  const double n = static_cast<double>(mass.size());
  const double mean = std::accumulate(mass.begin(), mass.end(), 0.0) / n;
  // B.13 asks for 0.5 to 8 of the mass that an isolated particle meets; any may become isolated,
  // and what it meets has the mean mass.
  return {{at_most("heaviest particle / mean", *most / mean, 8),
           at_most("heaviest particle / mean, of a release by the volume", *most / mean, 2),
           at_least("lightest particle / mean", *least / mean, 0.5)},
          n,
          0};
}

CaseReport isolated_come_and_go(States states) {
  Scenario s = with_states(cliff(1), states);
  s.numerics.end_time_s = 8;
  double residual = 0, jump = 0, most_in_flight = 0;
  std::size_t listed = 0, events = 0;
  const Finished f = run(s, {0, [&](double, const SimulationParts& p) {
                               const double now = p.state.grains().ledger.residual();
                               if (listed != 0 && listed != p.state.grains().n_listed)
                                 ++events, jump = std::max(jump, std::abs(now - residual));
                               residual = now, listed = p.state.grains().n_listed;
                               most_in_flight = std::max(most_in_flight, in_flight(p.state));
                             }});
  const MemberScalars& m = f.result.scalars;
  const double released = f.simulation.parts().state.grains().ledger.released_energy();
  return {
      {at_most("energy from nothing as particles come and go, of released", jump / released, 1e-3),
       at_least("steps in which particles came or went", static_cast<double>(events), 10),
       at_least("share that is isolated", most_in_flight, 0.01),
       at_most("energy residual", std::abs(m.energy_residual), 0.01)},
      m.n_particles,
      m.wall_s};
}

}  // namespace sturz::test
