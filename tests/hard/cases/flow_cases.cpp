// SPDX-License-Identifier: Apache-2.0
// I4, I12, I16, I17: rest, bands of shear, a gate that goes, the same bits.
#include "scenarios/assembly/assemble.hpp"
#include "scenarios/catalogue.hpp"
#include "tests/hard/cases/cases.hpp"
#include "tests/hard/random_members.hpp"
#include "tests/hard/spacing.hpp"
#include "tests/physics/verification.hpp"

#include <Eigen/Dense>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace sturz::test {
namespace {

/// sqrt(2 D:D) of the velocity field at every particle, D by least squares over 1.8 dx; NaN where
/// too few neighbours fix it [1/s].
std::vector<double> shear_rates(const SimulationParts& parts,
                                const std::vector<std::vector<Neighbor>>& around) {
  const ParticleSet& p = parts.state.grains();
  std::vector<double> rate(p.size(), std::nan(""));
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (around[i].size() < 12) continue;
    Eigen::Matrix3d moment = Eigen::Matrix3d::Zero(), mixed = Eigen::Matrix3d::Zero();
    for (const Neighbor& n : around[i]) {
      const Eigen::Vector3d r(n.dx, n.dy, n.dz);
      const Eigen::Vector3d v(p.vx[n.index] - p.vx[i], p.vy[n.index] - p.vy[i],
                              p.vz[n.index] - p.vz[i]);
      moment += r * r.transpose(), mixed += v * r.transpose();
    }
    const Eigen::Matrix3d gradient = mixed * moment.inverse();
    const Eigen::Matrix3d d = 0.5 * (gradient + gradient.transpose());
    rate[i] = std::sqrt(2.0) * d.norm();
  }
  return rate;
}

/// Scatter of the shear rate about its mean over the neighbours, over that mean (root mean
/// squares). On the lattice: checkerboard 0.83, a step between two layers 0.68, tanh(z/dx) 0.27,
/// a wave of 16 dx 0.10, linear 0.
double grid_scale_share(const SimulationParts& parts) {
  const auto around = neighbors_within(parts, 1.8);
  const auto rate = shear_rates(parts, around);
  double rough = 0, smooth = 0;
  for (std::size_t i = 0; i < rate.size(); ++i) {
    double sum = 0;
    int n = 0;
    for (const Neighbor& k : around[i])
      if (std::isfinite(rate[k.index])) sum += rate[k.index], ++n;
    if (n < 12 || !std::isfinite(rate[i])) continue;
    const double mean = sum / n;
    rough += (rate[i] - mean) * (rate[i] - mean);
    smooth += mean * mean;
  }
  return std::sqrt(rough / smooth);
}

/// What the ledger can still give back [J]; diffusion adds to the elastic part by its own account.
double mechanical_energy(const Ledger& l) {
  return l.kinetic + l.potential + l.elastic + l.spring - l.diffusion;
}

}  // namespace

/// A heap 4 m high on a slope of 20 degrees, inside and at the bed far from yielding, over 10 s.
CaseReport heap_on_a_slope(States states) {
  Scenario s = pile(1);
  s.terrain.synthetic->parameters["slope_deg"] = 20;
  s.release.paraboloid = ReleaseParaboloid{{0, 0}, {12, 12}};
  s.release.thickness_m = Uncertain(4);
  const double settled = 5 * std::sqrt(4 / gravity_m_s2);
  s.numerics.end_time_s = settled + 10;
  struct Place {
    MeanMotion centre;
    double front = -1e300;
  };
  auto place = [](const ParticleSet& p) {
    Place at{mean_motion(p)};
    for (double x : p.x) at.front = std::max(at.front, x);
    return at;
  };
  Place start;
  bool begun = false;
  const Finished f = run(with_states(s, states), {0.05, [&](double t, const SimulationParts& p) {
                                                    if (begun || t < settled) return;
                                                    start = place(p.state.grains()), begun = true;
                                                  }});
  const Place end = place(f.simulation.parts().state.grains());
  const double dx = s.numerics.spacing_m;
  const double moved = std::hypot(end.centre.x - start.centre.x, end.centre.y - start.centre.y,
                                  end.centre.z - start.centre.z) /
                       dx;
  const MemberScalars& m = f.result.scalars;
  return {{at_most("centre of mass, dx in 10 s", moved, 0.01),
           at_most("front, dx in 10 s", (end.front - start.front) / dx, 0.01),
           at_most("energy residual", std::abs(m.energy_residual), 0.01)},
          m.n_particles,
          m.wall_s};
}

CaseReport banding(States states) {
  CaseReport report;
  double coarser = 0;
  for (const int n : {10, 14, 20}) {
    Scenario s = column_collapse(1, n);
    const double fall = std::sqrt(1 / gravity_m_s2);
    s.numerics.end_time_s = 2.5 * fall;
    double sum = 0;
    int looks = 0;
    const Finished f =
        run(with_states(s, states), {0.25 * fall, [&](double t, const SimulationParts& p) {
                                       if (t < 0.9 * fall) return;
                                       sum += grid_scale_share(p), ++looks;
                                     }});
    report.checks.push_back(at_most(
        fmt::format("scatter of the shear rate within 1.8 dx, {} along", n), sum / looks, 0.25));
    if (coarser > 0)
      report.checks.push_back(
          at_most(fmt::format("the same over that of the coarser column, {} along", n),
                  sum / looks / coarser, 1.1));
    coarser = sum / looks;
    report.particles = f.result.scalars.n_particles;
    report.seconds += f.result.scalars.wall_s;
  }
  return report;
}

CaseReport gate_removal(States states) {
  constexpr double open_s = 1;
  Scenario s = column_collapse(1, 12);
  s.domain.walls.push_back(WallSpec{{1, 0, 0}, {-1, 0, 0}, 0, open_s});
  s.numerics.end_time_s = open_s + 2;
  double before = 0, residual_before = 0, jump = 0, residual_jump = 0, risen = -1e300,
         least = 1e300;
  int after = 0;
  const Finished f =
      run(with_states(s, states), {0, [&](double t, const SimulationParts& p) {
                                     const Ledger& l = p.state.grains().ledger;
                                     const double energy = mechanical_energy(l);
                                     if (t < open_s) {
                                       before = least = energy, residual_before = l.residual();
                                       return;
                                     }
                                     if (++after <= 3) {
                                       jump = std::max(jump, std::abs(energy - before));
                                       residual_jump = std::max(
                                           residual_jump, std::abs(l.residual() - residual_before));
                                     }
                                     least = std::min(least, energy);
                                     risen = std::max(risen, energy - least);
                                   }});
  const MemberScalars& m = f.result.scalars;
  const double whole = m.released_mass_kg * gravity_m_s2 * 0.5;  // 1 m high
  return {{at_most("energy that no account explains at the gate, of m g H/2", residual_jump / whole,
                   1e-3),
           at_most("mechanical energy, jump at the gate, of m g H/2", jump / whole, 1e-3),
           at_most("mechanical energy, any rise after it, of m g H/2", risen / whole, 1e-3),
           at_most("energy residual", std::abs(m.energy_residual), 0.01)},
          m.n_particles,
          m.wall_s};
}

CaseReport same_bits(States states) {
  constexpr int number = 8;
  HardMember m = RandomMembers::on_steep_ground(states).member(number);
  m.scenario.release.volume_m3->value *= 2;  // more than one block of the ordered sums
  m.scenario.numerics.end_time_s = 5;
  CaseReport report;
  auto hash = [&](int threads) {
    const MemberResult r = assemble(m.scenario, m.inputs, number, threads).run();
    report.particles = r.scalars.n_particles;
    report.seconds += r.scalars.wall_s;
    return r.state_hash;
  };
  const std::uint64_t first = hash(1);
  const int on_one = hash(1) != first, on_two = hash(2) != first;
  report.checks = {at_most("reruns with other bits, one thread", on_one, 0),
                   at_most("reruns with other bits, two threads", on_two, 0),
                   at_least("particles, for more than one block of sums", report.particles, 1025)};
  return report;
}

}  // namespace sturz::test
