// SPDX-License-Identifier: Apache-2.0
// Columns where the ground is steep on the scale of their thickness: a pool in a bowl against its
// closed form, a pile at the foot of walls of 60, 70 and 80 degrees against full stress
// (docs/studies/columns_at_walls.md).
#include "engine/effects/fields.hpp"
#include "engine/neighbors/column_smoothing.hpp"
#include "scenarios/catalogue.hpp"
#include "tests/physics/verification.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace sturz::test {
namespace {

constexpr double internal_angle_deg = 32;

/// Free surface of columns, by their own smoothing in the map: every pair, no bins.
struct FreeSurface {
  double lowest = 1e300, highest = -1e300;  ///< where columns stand [m]
  double steep_share = 0;                   ///< of the mass, under more than the limit [-]
  double steepest_deg = 0;

  FreeSurface(const ParticleSet& p, double density, double limit_deg) {
    const auto& ground = p.components(fields::ground);
    const auto& radius = p.scalar(fields::support_radius);
    double mass = 0, steep = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
      double thickness = 0, east = ground[0][i], north = ground[1][i];
      for (std::size_t j = 0; j < p.size(); ++j) {
        const double x = p.x[i] - p.x[j], y = p.y[i] - p.y[j], r = std::hypot(x, y);
        const ColumnSmoothing w{std::min(radius[i], radius[j])};
        if (r >= w.support_radius) continue;
        const double volume = p.mass[j] / density;
        thickness += volume * w.value(r);
        east -= volume * w.gradient(r) * x, north -= volume * w.gradient(r) * y;
      }
      lowest = std::min(lowest, p.z[i] + thickness);
      highest = std::max(highest, p.z[i] + thickness);
      const double slope_deg = std::atan(std::hypot(east, north)) / degree;
      steepest_deg = std::max(steepest_deg, slope_deg);
      mass += p.mass[i];
      if (slope_deg > limit_deg) steep += p.mass[i];
    }
    steep_share = steep / mass;
  }
};

double density_of(const Scenario& s) {
  return s.grains->density_kg_m3.value * s.grains->solid_fraction.value;
}

/// A mass with hardly any friction in a bowl z = r^2/(2 R) comes to rest as a pool, level at
/// sqrt(V/(pi R)) above the bottom. At its edge the bowl stands at 51 degrees.
TEST(PoolInABowl, LiesLevel) {
  const double radius = 60, volume = 60 * 60 * 80;
  Scenario s = block_on_plane(0.02);
  s.formulation = Formulation::depth_averaged;
  s.grains->earth_pressure = LateralPressure::isotropic;
  s.terrain.synthetic =
      SyntheticTerrain{"bowl", 4, {{"curvature_radius_m", radius}, {"size_m", 400}}};
  s.release.box = ReleaseBox{{-30, 30}, {-30, 30}};
  s.release.thickness_m = Uncertain(80);
  s.numerics.spacing_m = 4;
  s.numerics.end_time_s = 400;
  const Finished f = run(s);
  const FreeSurface surface(f.simulation.parts().state.grains(), density_of(s), 5);
  const double level = std::sqrt(volume / (std::numbers::pi * radius));
  expect_within(relative("pool in a bowl, highest surface", "m", surface.highest, level, 0.05), f);
  expect_conserved(f);
}

/// 200 m x 300 m, 100 m thick, its long side at the foot of a wall of 150 m; 0: level ground.
Scenario pile_at_wall(double face_deg, double spacing_m, Formulation formulation) {
  Scenario s = block_on_plane(0.3);
  s.formulation = formulation;
  const double drop = face_deg > 0 ? 150 : 0.01, face = face_deg > 0 ? face_deg : 1;
  s.terrain.synthetic = SyntheticTerrain{
      "step", 10, {{"drop_m", drop}, {"face_deg", face}, {"length_m", 1800}, {"width_m", 1400}}};
  const double foot = drop / std::tan(face * degree);
  s.release.box = ReleaseBox{{foot, foot + 200}, {-150, 150}};
  s.release.thickness_m = Uncertain(100);
  s.grains->friction.reset();
  s.grains->friction_angle_deg = Uncertain(internal_angle_deg);
  s.numerics.spacing_m = spacing_m;
  s.numerics.end_time_s = 200;
  return s;
}

class PileAtWall : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Walls, PileAtWall, testing::Values(60.0, 70.0, 80.0),
                         [](const auto& i) { return fmt::format("Degrees{:.0f}", i.param); });

TEST_P(PileAtWall, RisesAndRestsAsGrainsDo) {
  const Finished full = run(pile_at_wall(GetParam(), 11, Formulation::full_stress));
  const MemberScalars& asked = full.result.scalars;
  expect_numerical_bounded(fmt::format("pile at a wall of {:.0f} deg, full stress", GetParam()),
                           full);
  for (const double spacing : {16.0, 8.0, 5.0}) {
    const Scenario s = pile_at_wall(GetParam(), spacing, Formulation::depth_averaged);
    const Finished f = run(s);
    const FreeSurface rest(f.simulation.parts().state.grains(), density_of(s),
                           internal_angle_deg + 5);
    const std::string name =
        fmt::format("pile at a wall of {:.0f} deg, columns of {:.0f} m", GetParam(), spacing);
    const MemberScalars& m = f.result.scalars;
    expect_within(relative(name + ", greatest thickness", "m", m.max_thickness_m,
                           asked.max_thickness_m, 0.15),
                  f);
    expect_within(relative(name + ", deposit", "m", m.max_deposit_m, asked.max_deposit_m, 0.15), f);
    record(relative(name + ", front", "m", m.front_travel_m, asked.front_travel_m), f);
    record({name + ", steepest free surface at rest", "deg", rest.steepest_deg, internal_angle_deg,
            std::max(0.0, rest.steepest_deg - internal_angle_deg)},
           f);
    EXPECT_LT(rest.steep_share, 0.01) << "a ridge that friction does not bear";
    EXPECT_EQ(f.result.outcome, Outcome::settled);
    expect_mass_and_momentum(f);
    expect_within({name + ", energy residual", "-", m.energy_residual, 0, m.energy_residual, 0.01},
                  f);
  }
}

}  // namespace
}  // namespace sturz::test
