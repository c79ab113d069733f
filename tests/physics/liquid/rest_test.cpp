// SPDX-License-Identifier: Apache-2.0
// V3, liquid: water at rest carries its own weight, between periodic images and between walls.
#include "tests/physics/liquid/liquid_books.hpp"
#include "tests/support/liquid/liquid_scene.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>

namespace sturz::test {
namespace {

constexpr double height_m = 1, density = 1000;
constexpr int columns = 8;

/// 1 m deep, 8 x 8 particles wide, for five times sqrt(H/g).
LiquidBox basin(int layers, bool walls) {
  LiquidBox b;
  b.spacing = height_m / layers;
  b.n = {columns, columns, layers};
  b.half_width = 4;
  b.settings.sound_speed = 10 * std::sqrt(gravity_m_s2 * height_m);
  const double width = columns * b.spacing;
  if (walls) {
    b.domain.walls = {Wall{{0, 0, 0}, {1, 0, 0}}, Wall{{width, 0, 0}, {-1, 0, 0}},
                      Wall{{0, 0, 0}, {0, 1, 0}}, Wall{{0, width, 0}, {0, -1, 0}}};
  } else {
    b.domain.x = b.domain.y = {true, 0, width, 0};
  }
  return b;
}

struct Rest {
  double pressure = 0;  ///< L2 against rho g depth
  double kinetic = 0;   ///< / (m g H)
  double shift = 0;     ///< of the centre of mass / H
};

Rest examine(const Finished& f, double start_z) {
  const State& s = f.simulation.parts().state;
  const ParticleSet& p = s.sets[0];
  double off = 0, all = 0, z = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double expected = height_m - p.z[i];
    const double found = pressure_of(p, i) / (density * gravity_m_s2);
    off += (found - expected) * (found - expected);
    all += expected * expected;
    z += p.z[i] / static_cast<double>(p.size());
  }
  const Ledger l = s.ledger();
  return {std::sqrt(off / all), l.kinetic / (l.released_mass * gravity_m_s2 * height_m),
          (z - start_z) / height_m};
}

class LiquidAtRest : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Between, LiquidAtRest, testing::Bool(),
                         [](const auto& i) { return i.param ? "Walls" : "PeriodicImages"; });

TEST_P(LiquidAtRest, CarriesItsWeightAndStaysWhereItIs) {
  for (const int layers : resolutions({5, 10, 20}, {30})) {
    const LiquidBox b = basin(layers, GetParam());
    const Finished f = run(simulation_of(b, 5 * std::sqrt(height_m / gravity_m_s2)));
    const std::string name =
        fmt::format("V3 liquid {}, layers {}", GetParam() ? "box" : "column", layers);
    const Rest r = examine(f, 0.5 * height_m);
    expect_within({name + ", pressure", "L2 of the profile", r.pressure, 0, r.pressure, 0.02}, f);
    expect_within({name + ", kinetic energy", "/ m g H", r.kinetic, 0, r.kinetic, 1e-5}, f);
    expect_within({name + ", shift", "/ H", r.shift, 0, r.shift, 0.005}, f);
    if (GetParam())
      expect_liquid_books(name, f, {});
    else
      expect_liquid_books(name, f, {0, 1, 2});
  }
}

/// Walls mirror: the box does what the column does that its images repeat.
TEST(LiquidBetweenWalls, IsAsStillAsBetweenPeriodicImages) {
  std::array<Rest, 2> r;
  for (const bool walls : {false, true})
    r[walls] =
        examine(run(simulation_of(basin(10, walls), 1 / std::sqrt(gravity_m_s2))), 0.5 * height_m);
  EXPECT_NEAR(r[1].pressure, r[0].pressure, 1e-3);
  EXPECT_NEAR(r[1].shift, r[0].shift, 1e-5);
  EXPECT_LT(r[1].kinetic, 2 * r[0].kinetic + 1e-8);
}

}  // namespace
}  // namespace sturz::test
