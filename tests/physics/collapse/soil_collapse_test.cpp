// SPDX-License-Identifier: Apache-2.0
// V8c: another solver's test case at its own spacing, a soil column 0.2 m long and 0.1 m high
// (SPHinXsys, tests/2d_examples/test_2d_column_collapse).
#include "scenarios/catalogue.hpp"
#include "tests/physics/verification.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <utility>
#include <vector>

namespace sturz::test {
namespace {

constexpr double length_m = 0.2, height_m = 0.1;
/// What that code keeps of its result is the column's mechanical energy, 19.992 J/m at the start
/// and 13.8013 J/m at the end of 0.8 s, at rest: run 12 of its regression data, commit 78827146,
/// spacing of 2 mm. The toe is in no file of it. Energy over rho V g is the height of the centre of
/// mass.
constexpr double sunk = 1 - 13.8013 / 19.992;

/// Its material: 2040 kg/m3, 21.9 degrees as a Drucker-Prager cone matched in plane strain, tau = 3
/// tan/sqrt(9 + 12 tan^2) p, without dilatancy; walls and floor as rough as the soil. Here the cone
/// is tau = k p with the angle atan k.
Scenario soil(int layers) {
  const double t = std::tan(21.9 * degree), k = 3 * t / std::sqrt(9 + 12 * t * t);
  const double spacing = height_m / layers, run = 0.5;
  Scenario s = column_collapse();
  s.terrain.synthetic = SyntheticTerrain{
      "plane", 2 * spacing, {{"slope_deg", 0}, {"length_m", 2 * run}, {"width_m", 4 * spacing}}};
  s.release.box = ReleaseBox{{0, length_m}, {-2 * spacing, 2 * spacing}};
  s.release.thickness_m = Uncertain(height_m);
  s.grains->friction.reset();
  s.grains->friction_angle_deg = Uncertain(std::atan(k) / degree);
  s.grains->diameter_m = 0.001;
  s.grains->density_kg_m3 = 2040 / s.grains->solid_fraction.value;
  s.basal.friction_coefficient = k;
  s.domain.walls = {WallSpec{{0, 0, 0}, {1, 0, 0}, k, std::nullopt}};
  s.numerics.spacing_m = spacing;
  s.numerics.end_time_s = 0.8;
  s.numerics.stop_at_rest = false;
  return s;
}

/// 20 layers take 12 s and its own spacing of 50 takes minutes: by command only, as the finest of
/// V8.
bool finest() { return std::getenv("STURZ_FINE_COLLAPSE") != nullptr; }

TEST(SoilCollapse, SinksAsFarAsInAnotherSolver) {
  std::vector<int> all{10, 14};
  if (finest()) all.insert(all.end(), {20, 50});
  for (const int layers : all) {
    Simulation simulation = build(soil(layers));
    const double before = mean_motion(simulation.parts().state.grains()).z;
    const Finished f = run(std::move(simulation));
    const MeanMotion m = mean_motion(f.simulation.parts().state.grains());
    const std::string name = fmt::format("V8c soil column, {} layers", layers);
    expect_within(relative(name, "share of its height that the centre of mass sinks",
                           1 - m.z / before, sunk, 0.05),
                  f);
    const double moving = m.energy_height / height_m;
    expect_within({name + ", kinetic energy at the end", "/ m g H", moving, 0, moving, 1e-4}, f);
    expect_conserved(name, f);
  }
}

}  // namespace
}  // namespace sturz::test
