// SPDX-License-Identifier: Apache-2.0
// Pressure inside a wet column: Terzaghi's consolidation with one and two drains, shear, sheets
// that run or stick, both volumes, and corners that want to break it.
#include "engine/effects/columns/wet_profile.hpp"

#include "engine/core/random.hpp"
#include "engine/effects/columns/mixture.hpp"
#include "tests/support/wet_box.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace sturz {
namespace {

using std::numbers::pi;

/// One column and its profile.
struct Column {
  MixtureSettings wet;
  WetBlock b;
  WetProfile profile;

  Column(const MixtureSettings& settings, double thickness, double gravity)
      : wet(settings), profile(settings.profile) {
    const double m = wet.solid_fraction;
    b.n = 1;
    b.thickness[0] = thickness, b.solids[0] = m * thickness, b.water[0] = (1 - m) * thickness;
    b.mass[0] = wet.law.density(m) * thickness;
    b.normal_gravity[0] = b.gravity_seen[0] = gravity;
    b.strain_rate[0] = 0, b.fraction[0] = m, b.excess[0] = 0;
    b.friction[0] = std::tan(40 * pi / 180), b.cohesion[0] = b.drag[0] = 0;
    b.vx[0] = b.vy[0] = b.vz[0] = b.pull_x[0] = b.pull_y[0] = b.pull_z[0] = 0;
    for (int j = 0; j < profile.mesh.nodes; ++j) profile.excess[j][0] = 0;
  }
  void slide(double dt) {
    b.time = dt, b.profile = &profile;
    b.slide(wet);
  }
  double volume_inside() const {  // of p over the thickness
    double sum = 0;
    for (int j = 0; j < profile.mesh.nodes; ++j)
      sum += profile.mesh.weight(j) * profile.excess[j][0];
    return sum;
  }
};

/// Grains so stiff that c_v stays what it is.
MixtureSettings stiff(int nodes, bool drained_bed) {
  MixtureSettings wet{test::flume_mixture(), 0.6, -1, {nodes, drained_bed}};
  wet.law.stress_offset = 1e9;
  wet.law.permeability = 1e-13;
  return wet;
}
double diffusivity(const MixtureSettings& wet) {
  return wet.law.permeability / wet.law.fluid_viscosity * wet.law.stiffness(0.6, 0);
}

/// Single drainage of one metre from a start of 1 Pa at the base; p_e/p_0 there.
using Table = std::array<double, 5>;
constexpr Table times{0.05, 0.1, 0.2, 0.5, 1.0};
constexpr Table triangle{0.74769, 0.64318, 0.49591, 0.23605, 0.06874},
    uniform{0.99687, 0.94931, 0.77231, 0.37078, 0.10798};

Table drained(int nodes, bool from_triangle) {
  Column c(stiff(nodes, false), 1, standard_gravity);
  for (int j = 0; j < nodes; ++j)
    c.profile.excess[j][0] = from_triangle ? 1 - c.profile.mesh.height(j) : 1;
  c.b.excess[0] = 1;
  Table out;
  const double dt = 0.005 / diffusivity(c.wet);
  int step = 0;
  for (std::size_t k = 0; k < times.size(); ++k) {
    for (; step < std::lround(times[k] / 0.005); ++step) c.slide(dt);
    out[k] = c.b.excess[0];
  }
  return out;
}
double worst_error(const Table& found, const Table& exact) {
  double worst = 0;
  for (std::size_t k = 0; k < exact.size(); ++k)
    worst = std::max(worst, std::abs(found[k] / exact[k] - 1));
  return worst;
}

TEST(WetProfile, ConsolidatesAsTerzaghiHasIt) {
  for (const bool from_triangle : {true, false}) {
    const Table& exact = from_triangle ? triangle : uniform;
    const double coarse = worst_error(drained(5, from_triangle), exact),
                 usual = worst_error(drained(8, from_triangle), exact),
                 fine = worst_error(drained(10, from_triangle), exact);
    const double order = std::log(coarse / fine) / std::log(9.5 / 4.5);
    std::printf("Terzaghi from a %s: 5, 8, 10 nodes %.2f, %.2f, %.2f %% off; order %.2f\n",
                from_triangle ? "triangle" : "uniform start", 100 * coarse, 100 * usual, 100 * fine,
                order);
    EXPECT_LT(usual, 0.05);
    EXPECT_LT(coarse, 0.05);
    EXPECT_GT(order, 1.7);
    EXPECT_LT(order, 2.5);
  }
}

/// Times are those of the table with half of the thickness as the way out.
TEST(WetProfile, DrainsAtBothSidesAsTheSeriesHasIt) {
  double errors[2] = {};
  for (const int nodes : {5, 8, 10}) {
    Column c(stiff(nodes, true), 1, standard_gravity);
    for (int j = 0; j < nodes; ++j) c.profile.excess[j][0] = 1;
    const double dt = 0.001 / diffusivity(c.wet);
    int step = 0;
    double worst = 0;
    for (const double of_half : times) {
      const double time = of_half / 4;
      for (; step < std::lround(time / 0.001); ++step) c.slide(dt);
      const int j = nodes / 2;
      double exact = 0;
      for (int k = 1; k < 60; k += 2)
        exact += 4 / (k * pi) * std::sin(k * pi * c.profile.mesh.height(j)) *
                 std::exp(-k * k * pi * pi * step * 0.001);
      worst = std::max(worst, std::abs(c.profile.excess[j][0] / exact - 1));
      EXPECT_EQ(c.b.excess[0], 0) << "the bed lets go of it";
    }
    std::printf("drained at both sides, %d nodes: %.2f %% off\n", nodes, 100 * worst);
    if (nodes >= 8) {
      EXPECT_LT(worst, 0.05);
    }
    if (nodes != 8) errors[nodes / 10] = worst;
  }
  EXPECT_NEAR(std::log(errors[0] / errors[1]) / std::log(2), 2, 0.4) << "order";
}

/// At rest, from half of what the grains carry, in the shape that steady shear leaves (T1). The
/// parabola has 0.897951, 0.551537, 0.273617, 0.058413 after 0.1, 0.5, 1, 2 s.
TEST(WetProfile, RelaxesMoreSlowlyThanTheParabola) {
  MixtureSettings wet{test::flume_mixture(), 0.61, -1, {8, false}};
  wet.law.permeability = 1e-8, wet.law.reference_fraction = 0.61, wet.law.compressibility = 0.02;
  Column c(wet, 1, standard_gravity);
  const double start = 0.5 * (wet.law.density(0.61) - 1100) * standard_gravity;
  for (int j = 0; j < 8; ++j)
    c.profile.excess[j][0] = start * (1 - std::pow(c.profile.mesh.height(j), 2));
  c.b.excess[0] = start;
  int step = 0;
  for (const auto& [time, parabola] : {std::pair{0.1, 0.897951}, std::pair{0.5, 0.551537},
                                       std::pair{1.0, 0.273617}, std::pair{2.0, 0.058413}}) {
    for (; step < std::lround(time / 0.01); ++step) c.slide(0.01);
    std::printf("T1 resolved, %g s: %.4f (parabola %.4f), m %.6f\n", time, c.b.excess[0] / start,
                parabola, c.b.fraction[0]);
    EXPECT_GT(c.b.excess[0] / start, parabola);
    EXPECT_LT(c.b.excess[0] / start, 1.6 * parabola + 0.1);
  }
  EXPECT_GT(c.b.fraction[0], 0.612) << "and gives off water";
}

TEST(WetProfile, WhatIsSqueezedOutIsWhatThePressureLost) {
  for (const bool drained_bed : {false, true}) {
    Column c(stiff(8, drained_bed), 1, standard_gravity);
    for (int j = 0; j < 8; ++j) c.profile.excess[j][0] = 100 * (1 - c.profile.mesh.height(j));
    c.b.excess[0] = drained_bed ? 0 : 100;
    const double before = c.volume_inside(), stiffness = c.wet.law.stiffness(0.6, 0);
    for (int step = 0; step < 50; ++step) c.slide(0.004 / diffusivity(c.wet));
    const double film = ColumnWater(0.6, c.b.fraction[0], 1).film;
    EXPECT_NEAR(film * stiffness, before - c.volume_inside(), 1e-3 * before) << drained_bed;
    EXPECT_GT(film * stiffness, 0.1 * before);
  }
}

TEST(WetProfile, SteadyShearKeepsThePressureThatSuctionAndFlowShare) {  // T2
  MixtureSettings wet{test::flume_mixture(), 0.62, -1, {8, false}};
  wet.law.permeability = 1e-8, wet.law.reference_fraction = 0.61, wet.law.compressibility = 0.02;
  wet.law.critical_fraction = 0.64, wet.law.grain_diameter = 1e-3;
  Column c(wet, 1, standard_gravity);
  c.b.friction[0] = 0;
  for (int step = 0; step < 400; ++step) {
    c.b.vx[0] = 0.1;
    c.slide(0.05);
    c.b.fraction[0] = 0.62;
  }
  const double k = wet.law.permeability_at(0.62);
  const double borne = c.b.mass[0] * standard_gravity - c.b.pressure[0];
  const double tangent = dilatancy(wet.law, 0.62, 0.2, borne).tangent;
  const double steady = -wet.law.fluid_viscosity * 0.1 * tangent / k;
  std::printf("T2 resolved: %.2f Pa, -mu u h tan psi/k = %.2f Pa\n", c.b.excess[0], steady);
  EXPECT_NEAR(c.b.excess[0] / steady, 1, 0.01);
}

TEST(WetProfile, UndrainedLoadIsTakenWhole) {  // T5 where nothing is averaged over the depth
  MixtureSettings wet{test::flume_mixture(), 0.6, -1, {8, false}};
  wet.law.permeability = 1e-30;
  Column c(wet, 1, standard_gravity);
  c.b.gravity_seen[0] = 0.5 * standard_gravity;  // a bend doubles its weight in an instant
  c.slide(1e-9);
  EXPECT_NEAR(c.b.excess[0], (wet.law.density(0.6) - 1100) * 0.5 * standard_gravity, 1e-6);
  for (int j = 1; j < 8; ++j)
    EXPECT_NEAR(c.profile.excess[j][0], c.b.excess[0] * (1 - c.profile.mesh.height(j)), 1e-6);
}

TEST(WetProfile, ALiquefiedStartIsATriangleAndADrainedBedDoesNotSeeIt) {
  MixtureSettings wet{test::flume_mixture(), 0.6, 1, {6, false}};
  wet.law.permeability = 1e-30;
  Column tight(wet, 2, standard_gravity);
  tight.b.gravity_seen[0] = -1;
  tight.slide(1e-9);
  const double buoyant = (wet.law.density(0.6) - 1100) * 2 * standard_gravity;
  for (int j = 0; j < 6; ++j)
    EXPECT_NEAR(tight.profile.excess[j][0], buoyant * (1 - tight.profile.mesh.height(j)), 1e-6);
  wet.profile.drained_bed = true;
  Column drained(wet, 2, standard_gravity);
  drained.b.gravity_seen[0] = -1;
  drained.slide(1e-9);
  EXPECT_NEAR(drained.b.pressure[0], 1100 * 2 * standard_gravity, 1e-6) << "that of still water";
  EXPECT_GT(drained.profile.excess[2][0], 0.4 * buoyant);
}

/// One metre on 31 degrees from rest, as in T4: speed and path after 10 s by an independent program
/// with 48 nodes and steps of 0.02 s.
struct Sheet {
  double m, path, speed;
};
class ResolvedSheets : public testing::TestWithParam<Sheet> {};
INSTANTIATE_TEST_SUITE_P(SolidFractions, ResolvedSheets,
                         testing::Values(Sheet{.55, 240.6637, 49.283}, Sheet{.60, 230.59, 48.089},
                                         Sheet{.62, 217.2834, 46.177}, Sheet{.64, 25.7804, 0},
                                         Sheet{.66, 1.0887, 0}),
                         [](const auto& i) {
                           return "Percent" + std::to_string(std::lround(100 * i.param.m));
                         });

double path_of_sheet(double m, int nodes, double dt) {
  Column c({test::flume_mixture(), m, -1, {nodes, false}}, 1,
           standard_gravity * std::cos(31 * pi / 180));
  c.b.pull_x[0] = standard_gravity * std::sin(31 * pi / 180);
  double path = 0;
  for (int step = 0; step < std::lround(10 / dt); ++step) {
    const double before = c.b.vx[0];
    c.slide(dt);
    path += 0.5 * dt * (before + c.b.vx[0]);
  }
  return path;
}

TEST_P(ResolvedSheets, RunOrStick) {
  const Sheet s = GetParam();
  const double coarse = path_of_sheet(s.m, 5, 0.02), usual = path_of_sheet(s.m, 8, 0.02),
               fine = path_of_sheet(s.m, 10, 0.02), long_step = path_of_sheet(s.m, 8, 0.1);
  std::printf("m0 = %g: path %.3f %.3f %.3f m with 5, 8, 10 nodes, %.3f m in steps of 0.1 s\n", s.m,
              coarse, usual, fine, long_step);
  EXPECT_NEAR(usual / s.path, 1, s.m == .64 ? 0.03 : 0.005) << "critical: it hangs by a hair";
  EXPECT_LE(std::abs(fine / s.path - 1), std::abs(coarse / s.path - 1) + 1e-3);
  EXPECT_NEAR(long_step / usual, 1, 0.01);
}

double between(double low, double high, int number, int which) {
  return low + (high - low) * unit_random(23, static_cast<std::uint64_t>(number), which);
}

/// Corners: films and thick masses, tight and gravelly, at rest and fast.
Column corner(int number) {
  auto draw = [number, which = 0](double low, double high) mutable {
    return between(low, high, number, which++);
  };
  MixtureSettings wet{test::flume_mixture(),
                      draw(0.3, 0.75),
                      number % 3 ? -1.0 : draw(0, 1),
                      {5 + number % 6, number % 4 == 1}};
  wet.law.permeability = std::pow(10, draw(-15, -5));
  wet.law.fluid_viscosity = std::pow(10, draw(-3, 1));
  wet.law.compressibility = std::pow(10, draw(-2.5, -0.5));
  wet.law.stress_offset = std::pow(10, draw(1, 4));
  wet.law.grain_diameter = std::pow(10, draw(-4, -0.5));
  Column c(wet, std::pow(10, draw(-6, 1.5)), draw(0.5, 12));
  c.b.gravity_seen[0] = number % 7 ? draw(0.5, 12) : -1;
  c.b.strain_rate[0] = draw(-5, 5);
  c.b.vx[0] = number % 5 ? draw(0, 60) : 0;
  c.b.pull_x[0] = draw(0, 8);
  return c;
}

TEST(WetProfile, NoCornerBreaksIt) {
  double largest_cut = 0;
  for (int number = 0; number < 600; ++number) {
    Column c = corner(number);
    const double h = c.b.thickness[0], share = c.wet.solid_fraction;
    for (int step = 0; step < 40; ++step) {
      c.slide(number % 2 ? 0.02 : 0.5);
      c.b.gravity_seen[0] = c.b.normal_gravity[0];
      const double stress = c.b.mass[0] * c.b.normal_gravity[0], m = c.b.fraction[0];
      ASSERT_TRUE(std::isfinite(c.b.vx[0] + m + c.b.excess[0] + c.b.clipped_work[0])) << number;
      ASSERT_GE(c.b.clipped_work[0], 0) << number;
      ASSERT_GE(c.b.pressure[0], 0) << number;
      ASSERT_LE(c.b.pressure[0], stress * (1 + 1e-12)) << number;
      ASSERT_GT(m, 0.15) << number;
      ASSERT_LT(m, 0.95) << number;
      const ColumnWater water(share, m, h);
      // Grains and water where the solid fraction says they are.
      ASSERT_NEAR(water.thickness * m, share * h, 1e-13 * h);
      ASSERT_NEAR(water.film + water.saturation * (1 - m) * water.thickness, (1 - share) * h,
                  1e-13 * h);
      const double still = c.wet.law.fluid_density * c.b.normal_gravity[0] * water.level;
      for (int j = 0; j < c.profile.mesh.nodes; ++j) {
        const double above = 1 - c.profile.mesh.height(j), p = c.profile.excess[j][0];
        ASSERT_LE(p, (stress - still) * above + 1e-9 * stress) << number;
        ASSERT_GE(p, -still - 1e-9 * stress) << number;
      }
      largest_cut = std::max(largest_cut, c.b.clipped_work[0]);
    }
  }
  EXPECT_GT(largest_cut, 0) << "the corners reach the bounds";
}

TEST(WetProfile, ColumnsDoNotFeelWhoIsBesideThem) {
  constexpr int n = 61;
  auto together = std::make_unique<WetBlock>();
  const MixtureSettings wet = corner(0).wet;
  WetProfile profile(wet.profile);
  together->n = n, together->profile = &profile, together->time = 0.05;
  std::vector<Column> alone;
  for (int k = 0; k < n; ++k) {
    Column c = corner(6 * k);  // as many nodes, and all of one settings
    c.wet = wet, c.profile.mesh = profile.mesh;
    for (int j = 0; j < wet.profile.nodes; ++j)
      c.profile.excess[j][0] = between(-1, 1, k, j) * 2000 * c.b.thickness[0];
    c.b.excess[0] = wet.profile.drained_bed ? 0 : c.profile.excess[0][0];
    for (auto row : {&WetBlock::mass, &WetBlock::solids, &WetBlock::water, &WetBlock::thickness,
                     &WetBlock::normal_gravity, &WetBlock::strain_rate, &WetBlock::gravity_seen,
                     &WetBlock::pull_x, &WetBlock::pull_y, &WetBlock::pull_z, &WetBlock::friction,
                     &WetBlock::cohesion, &WetBlock::drag, &WetBlock::vx, &WetBlock::vy,
                     &WetBlock::vz, &WetBlock::fraction, &WetBlock::excess})
      ((*together).*row)[k] = (c.b.*row)[0];
    profile.copy(k, c.profile, 0);
    alone.push_back(c);
  }
  together->slide(wet);
  for (int k = 0; k < n; ++k) {
    Column& c = alone[k];
    c.slide(0.05);
    EXPECT_EQ(together->vx[k], c.b.vx[0]) << k;
    EXPECT_EQ(together->fraction[k], c.b.fraction[0]) << k;
    EXPECT_EQ(together->clipped_work[k], c.b.clipped_work[0]) << k;
    for (int j = 0; j < wet.profile.nodes; ++j)
      EXPECT_EQ(profile.excess[j][k], c.profile.excess[j][0]) << k;
  }
}

}  // namespace
}  // namespace sturz
