// SPDX-License-Identifier: Apache-2.0
// A block of wet columns: what becomes of one does not depend on those beside it in the block, and
// is what a column by itself does.
#include "engine/effects/columns/wet_block.hpp"

#include "engine/core/constants.hpp"
#include "engine/core/random.hpp"
#include "tests/support/wet_box.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace sturz {
namespace {

double between(double low, double high, int number, int which) {
  return low + (high - low) * unit_random(11, static_cast<std::uint64_t>(number), which);
}

/// Puts column `number` of an unending list at place k: films and masses, at rest and fast, some at
/// their first step, some hardly touching.
void put(WetBlock& b, std::size_t k, int number) {
  auto draw = [number, which = 0](double low, double high) mutable {
    return between(low, high, number, which++);
  };
  const double h = std::pow(10, draw(-2, 1)), area = draw(0.5, 20);
  const double m0 = draw(0.2, 0.75), m = m0 * draw(0.9, 1.1);
  b.thickness[k] = h, b.solids[k] = m0 * h * area, b.water[k] = (1 - m0) * h * area;
  b.mass[k] = 2700 * b.solids[k] + 1100 * b.water[k];
  b.normal_gravity[k] = draw(2, 12), b.gravity_seen[k] = number % 7 ? draw(2, 12) : -1;
  b.strain_rate[k] = draw(-5, 5), b.fraction[k] = m;
  b.excess[k] = h * draw(-1e4, 1e4);
  const double speed = number % 5 ? draw(0, 30) : 0, way = draw(0, 6.3);
  b.vx[k] = speed * std::cos(way), b.vy[k] = speed * std::sin(way), b.vz[k] = -0.3 * speed;
  b.pull_x[k] = draw(-5, 5), b.pull_y[k] = draw(-5, 5), b.pull_z[k] = draw(-3, 0);
  b.friction[k] = draw(0, 1), b.cohesion[k] = number % 3 ? 0 : draw(0, 1000);
  b.drag[k] = number % 2 ? 0 : draw(0, 0.05);
}

MixtureSettings settings() {
  MixtureSettings wet;
  wet.law = test::flume_mixture();
  wet.law.permeability = 1e-9;
  return wet;
}

std::vector<double> outcome(const WetBlock& b, std::size_t k) {
  return {b.vx[k], b.vy[k], b.vz[k], b.fraction[k], b.excess[k], b.pressure[k], b.clipped_work[k]};
}

TEST(WetBlock, ColumnsDoNotFeelWhoIsBesideThem) {
  constexpr int n = 125;
  const MixtureSettings wet = settings();
  WetBlock together;
  together.n = n, together.time = 0.05;
  for (int k = 0; k < n; ++k) put(together, k, k);
  together.slide(wet);
  int moved_in_parts = 0;
  for (int k = 0; k < n; ++k) {
    WetBlock alone;
    alone.n = 1, alone.time = 0.05;
    put(alone, 0, k);
    const double before = alone.excess[0];
    alone.slide(wet);
    moved_in_parts += std::abs(alone.excess[0] - before) > 0.05 * 1e4 * alone.thickness[0];
    EXPECT_EQ(outcome(together, k), outcome(alone, 0)) << k;
  }
  EXPECT_GT(moved_in_parts, 5) << "the case is about them too";
}

TEST(WetBlock, IsTheSheetByItself) {
  // One metre on 31 degrees that nothing strains; small steps, as the box does them.
  for (double m : {0.55, 0.62, 0.66}) {
    MixtureSettings wet{test::flume_mixture(), m, -1};
    test::WetBox box(wet.law, m, 31);
    WetBlock b;
    b.n = 3, b.time = 1e-3;
    for (std::size_t k = 0; k < b.n; ++k) {
      b.thickness[k] = 1, b.solids[k] = m, b.water[k] = 1 - m, b.mass[k] = wet.law.density(m);
      b.normal_gravity[k] = b.gravity_seen[k] = box.gravity, b.strain_rate[k] = 0;
      b.fraction[k] = m, b.excess[k] = 0, b.friction[k] = box.tan_phi, b.cohesion[k] = 0;
      b.drag[k] = 0, b.vx[k] = b.vy[k] = b.vz[k] = 0;
      b.pull_x[k] = box.slope_gravity, b.pull_y[k] = b.pull_z[k] = 0;
    }
    for (int step = 0; step < 2000; ++step) {
      b.slide(wet);
      box.slide(1e-3);
    }
    EXPECT_NEAR(b.vx[2], box.speed, 0.005 * std::max(0.5, box.speed)) << m;
    EXPECT_NEAR(b.fraction[2], box.m, 1e-4) << m;
    EXPECT_EQ(b.vy[2], 0);
  }
}

TEST(WetBlock, TurbulentDragIsExactWhereItIsAlone) {
  // On smooth ground and without viscosity the bed takes nothing but g v^2/(xi h).
  MixtureSettings wet{test::flume_mixture(), 0.6, 1};
  wet.law.critical_fraction = 0.6, wet.law.fluid_viscosity = 1e-12, wet.law.permeability = 1e-30;
  WetBlock b;
  b.n = 1, b.time = 0.02;
  b.thickness[0] = 2, b.solids[0] = 1.2, b.water[0] = 0.8, b.mass[0] = 2 * wet.law.density(0.6);
  b.normal_gravity[0] = standard_gravity, b.gravity_seen[0] = -1, b.strain_rate[0] = 0;
  b.fraction[0] = 0.6, b.excess[0] = 0, b.friction[0] = 0, b.cohesion[0] = 0;
  b.drag[0] = standard_gravity / 500;
  b.vx[0] = 12, b.vy[0] = b.vz[0] = b.pull_x[0] = b.pull_y[0] = b.pull_z[0] = 0;
  for (int step = 0; step < 500; ++step) {
    b.slide(wet);
    b.gravity_seen[0] = standard_gravity;
  }
  const double rate = standard_gravity / 500 / 2;
  EXPECT_NEAR(b.vx[0], 12 / (1 + 12 * rate * 10), 1e-4);
}

}  // namespace
}  // namespace sturz
