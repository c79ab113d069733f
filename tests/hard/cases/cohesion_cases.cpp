// SPDX-License-Identifier: Apache-2.0
// I1: cohesive grains under tension. Particles that attract each other gather in clumps where the
// scheme is not stable against tension; the mass then breaks where nothing breaks it.
#include "engine/effects/fields.hpp"
#include "tests/hard/cases/cases.hpp"
#include "tests/hard/spacing.hpp"
#include "tests/physics/verification.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sturz::test {
namespace {

constexpr double cohesion_pa = 5000, friction_deg = 25, density = 1560;

/// Above it a vertical face cannot stand: Coulomb's wedge on the cone tau = C + M p is 4C/(rho g
/// (1 - M)) [m]. That is 4c/(rho g) tan(45 + phi/2) where the cone is matched in plane strain (2.05
/// m), and 4c/(rho g (1 - tan phi)) where it is matched along a plane (2.45 m).
double critical_height(FrictionCone cone) {
  const double friction = std::tan(friction_deg * degree);
  return 4 * cone_cohesion(cone, friction, cohesion_pa) /
         (density * gravity_m_s2 * (1 - cone_slope(cone, friction)));
}

/// One slice, four particles thick and ten high, of a bank with a vertical face at both ends.
Scenario bank(double height, double times, FrictionCone cone) {
  const double dx = height / 10, half = 1.2 * height, runout = 5 * height;
  Scenario s;
  s.formulation = Formulation::full_stress;
  s.terrain.synthetic = SyntheticTerrain{
      "plane", 2 * dx, {{"slope_deg", 0}, {"length_m", 2 * runout}, {"width_m", 4 * dx}}};
  s.release.box = ReleaseBox{{-half, half}, {-2 * dx, 2 * dx}};
  s.release.thickness_m = Uncertain(height);
  s.grains.emplace().friction_angle_deg = Uncertain(friction_deg);
  s.grains->cohesion_pa = cohesion_pa;
  s.grains->friction_cone = cone;
  s.grains->diameter_m = 0.01;
  s.basal.friction_coefficient = std::tan(friction_deg * degree);
  s.basal.cohesion_pa = cohesion_pa;
  s.domain.periodic = {"y"};
  s.numerics.spacing_m = dx;
  s.numerics.end_time_s = times * std::sqrt(height / gravity_m_s2);
  s.numerics.stop_at_rest = false;
  return s;
}

struct Fall {
  Finished finished;
  double moved = 0;    ///< farthest any particle went [heights]
  double closest = 1;  ///< pair at any time looked at [dx]
};

/// \param share  of the critical height
/// \param times  as many sqrt(height/g)
Fall let_go(double share, double times, FrictionCone cone, States states) {
  const double height = share * critical_height(cone);
  const Scenario s = with_states(bank(height, times, cone), states);
  Simulation simulation = build(s);
  const MovingSet start = simulation.parts().state.grains();
  std::vector<Vec3> at(start.size());
  for (std::size_t i = 0; i < start.size(); ++i)
    at[start.id[i]] = Vec3(start.x[i], start.y[i], start.z[i]);
  double closest = 2;
  Finished f = run(std::move(simulation),
                   {0.05 * s.numerics.end_time_s.value(), [&](double, const SimulationParts& p) {
                      closest = std::min(closest, closest_pair(p));
                    }});
  const ParticleSet& p = f.simulation.parts().state.grains();
  double moved = 0;
  for (std::size_t i = 0; i < p.size(); ++i)
    moved = std::max(moved, std::hypot(p.x[i] - at[p.id[i]].x(), p.z[i] - at[p.id[i]].z()));
  return {std::move(f), moved / height, closest};
}

CaseReport report(const Fall& fall, std::vector<Check> checks) {
  const MemberScalars& m = fall.finished.result.scalars;
  checks.push_back(at_most("energy residual", std::abs(m.energy_residual), 0.01));
  return {std::move(checks), m.n_particles, m.wall_s};
}

CaseReport bank_stands(double share, FrictionCone cone, States states) {
  const Fall fall = let_go(share, 30, cone, states);
  return report(fall, {at_most("farthest particle, heights", fall.moved, 0.1),
                       at_least("closest pair, dx", fall.closest, 0.5)});
}

CaseReport bank_falls(FrictionCone cone, States states) {
  const Fall fall = let_go(1.2, 10, cone, states);
  return report(fall, {at_least("farthest particle, heights", fall.moved, 0.2),
                       at_least("closest pair, dx", fall.closest, 0.5)});
}

}  // namespace

CaseReport cohesive_bank_stands(States states) {
  return bank_stands(0.75, FrictionCone::simple_shear, states);
}
CaseReport bank_near_its_height(States states) {
  return bank_stands(0.9, FrictionCone::simple_shear, states);
}
CaseReport tall_bank_falls(States states) { return bank_falls(FrictionCone::simple_shear, states); }
CaseReport plane_strain_bank_near_its_height(States states) {
  return bank_stands(0.9, FrictionCone::plane_strain, states);
}
CaseReport plane_strain_bank_falls(States states) {
  return bank_falls(FrictionCone::plane_strain, states);
}

/// 24 x 6 x 6 particles without weight; the three outermost layers of both ends move apart.
CaseReport stretched_bar(States states) {
  constexpr double half = 12, speed = 0.5, strain = 0.3;
  Scenario s;
  s.formulation = Formulation::full_stress;
  s.terrain.synthetic =
      SyntheticTerrain{"plane", 2, {{"slope_deg", 0}, {"length_m", 100}, {"width_m", 40}}};
  s.release.box = ReleaseBox{{-half, half}, {-3, 3}};
  s.release.thickness_m = Uncertain(6);
  s.grains.emplace().friction_angle_deg = Uncertain(friction_deg);
  s.grains->cohesion_pa = 20000;
  s.numerics.spacing_m = 1;
  Simulation simulation = build(with_states(std::move(s), states));
  SimulationParts& parts = simulation.parts();
  ParticleSet& p = parts.state.grains();
  parts.state.gravity = 0;
  for (double& z : p.z) z += 30;
  for (const FieldKey* key : {&fields::stress, &fields::density_change})
    for (auto& column : p.components(*key)) std::fill(column.begin(), column.end(), 0.0);
  std::vector<double> pull(p.size());
  for (std::size_t i = 0; i < p.size(); ++i)
    pull[p.id[i]] = p.x[i] > half - 3 ? speed : p.x[i] < 3 - half ? -speed : 0;
  double closest = 2;
  while (parts.state.time * speed < strain * half) {
    simulation.step();
    for (std::size_t i = 0; i < p.size(); ++i)
      if (const double v = pull[p.id[i]]; v != 0) p.vx[i] = v, p.vy[i] = p.vz[i] = 0;
    if (parts.state.n_steps % 64 == 0) closest = std::min(closest, closest_pair(parts));
  }
  const auto sizes = pieces(parts, 1.9);
  std::size_t crumbs = 0;
  for (std::size_t size : sizes) crumbs += size < p.size() / 10 ? size : 0;
  return {{at_least("closest pair, dx", closest, 0.5),
           at_most("particles in crumbs, share", double(crumbs) / p.size(), 0.01),
           at_most("pieces", double(sizes.size()), 2)},
          double(p.size()),
          0};
}

}  // namespace sturz::test
