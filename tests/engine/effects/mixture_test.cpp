// SPDX-License-Identifier: Apache-2.0
// Columns of a mixture: grains and water are kept, pressures stay within bounds, rest is rest.
#include "engine/effects/columns/mixture.hpp"

#include "engine/effects/arrivals.hpp"
#include "engine/effects/fields.hpp"
#include "engine/laws/consolidation.hpp"
#include "tests/support/hand_made.hpp"
#include "tests/support/wet_box.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

namespace sturz {
namespace {

using test::even_ground;
using test::flume_mixture;
using test::HandMade;
using testing::ContainsRegex;
using testing::HasSubstr;

MixtureSettings settings_of(double solid_fraction) { return {flume_mixture(), solid_fraction, -1}; }

/// Columns of `thickness` on a lattice of 1 m.
HandMade wet_columns(Terrain ground, const std::vector<Vec3>& positions,
                     const std::vector<double>& thickness, const MixtureSettings& wet,
                     const Vec3& velocity = {0, 0, 0}, const Domain& domain = {},
                     double cohesion_pa = 0) {
  HandMade made{State(std::move(ground), domain), {}};
  MovingSet& p = made.state.grains();
  const double density = wet.law.density(wet.solid_fraction);
  p.grow(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    p.x[i] = positions[i].x(), p.y[i] = positions[i].y();
    p.vx[i] = velocity.x(), p.vy[i] = velocity.y(), p.vz[i] = velocity.z();
    p.mass[i] = density * thickness[i];
    p.ledger.released_mass += p.mass[i];
  }
  DepthAveragedSettings columns;
  columns.density = density;
  columns.mixture = wet;
  columns.bed[0].friction_coefficient = std::tan(40 * std::numbers::pi / 180);
  columns.bed[0].cohesion_pa = cohesion_pa;
  columns.instruction_set = best_instruction_set();
  add_mixture(made.state, 0, wet);
  add_depth_averaged(made.step, made.state, 0, columns, thickness);
  return made;
}

/// Volumes of grains and water, from what a column is and from what its solid fraction says.
struct Volumes {
  double solids = 0, water = 0, film = 0;

  explicit Volumes(const MovingSet& p) {
    for (std::size_t i = 0; i < p.size(); ++i) {
      const double s = p.scalar(fields::solids_volume)[i], w = p.scalar(fields::water_volume)[i];
      const double h = p.scalar(fields::thickness)[i], area = (s + w) / h;
      const ColumnWater at(s / (s + w), p.scalar(fields::solid_fraction)[i], h);
      solids += at.thickness * p.scalar(fields::solid_fraction)[i] * area;
      film += at.film * area;
      water +=
          (at.film + at.saturation * (1 - p.scalar(fields::solid_fraction)[i]) * at.thickness) *
          area;
    }
  }
};

void expect_within_bounds(const MovingSet& p, const MixtureLaw& law) {
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double s = p.scalar(fields::solids_volume)[i], w = p.scalar(fields::water_volume)[i];
    const double h = p.scalar(fields::thickness)[i], g_n = p.scalar(fields::normal_gravity)[i];
    const double stress = p.mass[i] / (s + w) * g_n * h,
                 pressure = p.scalar(fields::pore_pressure)[i];
    const ColumnWater water(s / (s + w), p.scalar(fields::solid_fraction)[i], h);
    ASSERT_GE(pressure, 0);
    ASSERT_LE(pressure, stress * (1 + 1e-12));
    if (water.saturation < 1) {
      ASSERT_LE(pressure, law.fluid_density * g_n * water.level * (1 + 1e-12));
    }
    ASSERT_GT(p.scalar(fields::solid_fraction)[i], 0.1);
    ASSERT_LT(p.scalar(fields::solid_fraction)[i], 0.9);
  }
}

TEST(ColumnWater, KnowsFilmAndAir) {
  const ColumnWater even(0.6, 0.6, 2);
  EXPECT_NEAR(even.thickness, 2, 1e-15);
  EXPECT_NEAR(even.film, 0, 1e-15);
  const ColumnWater contracted(0.6, 0.64, 2);
  EXPECT_NEAR(contracted.thickness, 2 * 0.6 / 0.64, 1e-15);
  EXPECT_NEAR(contracted.film + contracted.thickness, 2, 1e-15);
  EXPECT_EQ(contracted.level, 2) << "the film presses too";
  const ColumnWater dilated(0.6, 0.55, 2);
  EXPECT_EQ(dilated.film, 0);
  EXPECT_NEAR(dilated.saturation * (1 - 0.55) * dilated.thickness, 0.4 * 2, 1e-15);
  EXPECT_LT(dilated.level, 2);
  // No jump where the film is used up.
  EXPECT_NEAR(ColumnWater(0.6, 0.6 - 1e-9, 2).level, 2, 1e-7);
}

class MassThatLeaves : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(SolidFractions, MassThatLeaves, testing::Values(0.5, 0.6, 0.68),
                         [](const auto& i) {
                           return "Percent" + std::to_string(int(100 * i.param));
                         });

TEST_P(MassThatLeaves, TakesItsGrainsAndItsWaterAlong) {  // T10
  const MixtureSettings wet = settings_of(GetParam());
  HandMade made = wet_columns(even_ground(24, 0.6), test::block({8, 6, 1}, {-4, -3, 0}),
                              std::vector<double>(48, 0.8), wet, {6, 0.5, -3.6});
  const MovingSet& p = made.state.grains();
  const Ledger& ledger = p.ledger;
  ASSERT_NEAR(ledger.released_solids / (48 * 0.8 * GetParam()), 1, 1e-14);
  for (int n = 0; n < 400 && p.size() > 0; ++n) {
    made.advance();
    const Volumes now(p);
    ASSERT_NEAR((now.solids + ledger.lost_solids) / ledger.released_solids, 1, 1e-13);
    ASSERT_NEAR((now.water + ledger.lost_water) / ledger.released_water, 1, 1e-13);
    expect_within_bounds(p, wet.law);
  }
  EXPECT_GT(ledger.lost_solids, 0);
  EXPECT_NEAR(
      wet.law.solid_density * ledger.lost_solids + wet.law.fluid_density * ledger.lost_water,
      ledger.lost_mass, 1e-9 * ledger.lost_mass);
}

TEST(Mixture, ALakeOfUnequalFractionsStaysAtRest) {  // T9
  constexpr int n = 24;
  Raster<double> z(Grid{n, n, -0.5 * n, 0.5 * n, 1, ""});
  const auto bed = [](double x, double y) {
    return 0.3 * std::sin(2 * std::numbers::pi * x / n) * std::cos(4 * std::numbers::pi * y / n);
  };
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) z.at(r, c) = bed(z.grid.x_center(c), z.grid.y_center(r));
  Domain domain;
  domain.x = {true, -0.5 * n, 0.5 * n, 0};
  domain.y = domain.x;
  const auto positions = test::block({n, n, 1}, {-0.5 * n, -0.5 * n, 0});
  std::vector<double> thickness;
  for (const Vec3& at : positions) thickness.push_back(2 - bed(at.x(), at.y()));
  const MixtureSettings wet = settings_of(0.6);
  HandMade made =
      wet_columns(Terrain(std::make_shared<Raster<double>>(std::move(z)), NodataRule::outflow),
                  positions, thickness, wet, {0, 0, 0}, domain);
  MovingSet& p = made.state.grains();
  auto &solids = p.scalar(fields::solids_volume), &water = p.scalar(fields::water_volume);
  for (std::size_t i = 0; i < p.size(); ++i) {  // the same volume, denser or looser
    const double m = p.x[i] < 0 ? 0.55 : 0.66, volume = solids[i] + water[i];
    solids[i] = m * volume, water[i] = (1 - m) * volume;
    p.mass[i] = wet.law.density(m) * volume;
    p.scalar(fields::solid_fraction)[i] = m;
  }
  for (int k = 0; k < 100; ++k) made.advance();
  double fastest = 0;
  for (std::size_t i = 0; i < p.size(); ++i)
    fastest = std::max({fastest, std::abs(p.vx[i]), std::abs(p.vy[i]), std::abs(p.vz[i])});
  EXPECT_LT(fastest, 1e-12);
  for (std::size_t i = 0; i < p.size(); ++i)
    EXPECT_NEAR(p.scalar(fields::solid_fraction)[i], p.x[i] < 0 ? 0.55 : 0.66, 1e-12)
        << "nothing dilates at rest";
}

TEST(Mixture, AThinFastFilmComesToItsSteadyFractionAndStaysThere) {
  MixtureSettings wet = settings_of(0.7);
  wet.law.permeability = 1e-8;
  HandMade made = wet_columns(even_ground(400, 0.3), test::block({3, 3, 1}, {-190, 0, 0}),
                              std::vector<double>(9, 0.02), wet, {15, 0, -4.5});
  const MovingSet& p = made.state.grains();
  for (int n = 0; n < 60; ++n) made.advance();
  const std::vector<double> before = p.scalar(fields::solid_fraction);
  made.advance();
  for (std::size_t i = 0; i < p.size(); ++i) {
    EXPECT_LT(p.scalar(fields::solid_fraction)[i], 0.64);
    EXPECT_NEAR(p.scalar(fields::solid_fraction)[i], before[i], 0.004) << "it does not swing";
  }
  expect_within_bounds(p, wet.law);
}

TEST(Mixture, PressureBeyondTheWeightIsClippedAndBooked) {
  MixtureSettings wet = settings_of(0.55);
  wet.pressure_ratio = 1;  // liquefied, and pulled apart
  HandMade made = wet_columns(even_ground(60), test::block({6, 6, 1}, {-3, -3, 0}),
                              std::vector<double>(36, 1), wet);
  MovingSet& p = made.state.grains();
  for (std::size_t i = 0; i < p.size(); ++i) p.vx[i] = 3 * p.x[i];
  for (int n = 0; n < 20; ++n) made.advance();
  EXPECT_GT(p.ledger.clipped_work, 0);
  EXPECT_TRUE(std::isfinite(p.ledger.clipped_work));
  expect_within_bounds(p, wet.law);
}

TEST(Mixture, WhatArrivesIsAsWetAsTheRest) {
  const MixtureSettings wet = settings_of(0.62);
  HandMade made = wet_columns(even_ground(40), test::block({4, 4, 1}, {-2, -2, 0}),
                              std::vector<double>(16, 1), wet);
  made.advance();
  MovingSet& p = made.state.grains();
  p.arrivals.push_back({{5, 5, 0}, {0, 0, 0}, 1000});
  made.advance();
  made.advance();
  ASSERT_EQ(p.size(), 17u);
  EXPECT_NEAR(p.scalar(fields::solids_volume)[16], 0.62 * 1000 / wet.law.density(0.62), 1e-12);
  const Volumes now(p);
  EXPECT_NEAR(now.solids / p.ledger.released_solids, 1, 1e-13) << "the ledger knows of it";
  EXPECT_NEAR(now.water / p.ledger.released_water, 1, 1e-13);
}

TEST(Mixture, BedThatJoinsAColumnBringsItsGrainsItsWaterAndItsPressure) {
  const MixtureSettings wet = settings_of(0.62);
  HandMade made = wet_columns(even_ground(40), test::block({4, 4, 1}, {-2, -2, 0}),
                              std::vector<double>(16, 1), wet);
  made.advance();
  MovingSet& p = made.state.grains();
  const double excess = p.scalar(fields::excess_pressure)[5];
  // A third of a cubic metre of loose bed, its pores nine tenths full and liquefied.
  const AddedMixture bed{0.15, 0.9 * (0.3 - 0.15), 0.5, 1200};
  add_to_mixture(p, 5, bed);
  p.mass[5] += wet.law.solid_density * bed.solids_m3 + wet.law.fluid_density * bed.water_m3;
  EXPECT_NEAR(p.scalar(fields::solids_volume)[5], 0.62 + 0.15, 1e-12);
  EXPECT_NEAR(p.scalar(fields::solid_fraction)[5], (0.62 + 0.15) / (1 + 0.3), 1e-12);
  EXPECT_NEAR(p.scalar(fields::excess_pressure)[5] - excess, 1200, 1e-9);
  for (int n = 0; n < 5; ++n) made.advance();
  const Volumes now(p);
  EXPECT_NEAR(now.solids / p.ledger.released_solids, 1, 1e-13);
  EXPECT_NEAR(now.water / p.ledger.released_water, 1, 1e-13);
  expect_within_bounds(p, wet.law);
}

/// What is said of columns 1 m thick that start at rest on such a slope, after 4 s.
std::string said_of(double slope_deg, double solid_fraction, double cohesion_pa = 0) {
  const MixtureSettings wet = settings_of(solid_fraction);
  HandMade made = wet_columns(even_ground(60, std::tan(slope_deg * std::numbers::pi / 180)),
                              test::block({8, 8, 1}, {-20, -4, 0}), std::vector<double>(64, 1), wet,
                              {0, 0, 0}, {}, cohesion_pa);
  while (made.state.time < 4) made.advance();
  std::vector<std::string> said;
  made.step.warnings(made.state, said);
  std::string text;
  for (const std::string& sentence : said) text += sentence + "\n";
  return text;
}

TEST(Mixture, ThatOnlySuctionHoldsIsNotAtRestForGood) {
  // Denser than critical it sticks at once, and half its weight is still water's: tan 40 degrees
  // times that half holds 22 degrees.
  for (const double slope_deg : {26.0, 31.0}) {
    const std::string dense = said_of(slope_deg, 0.66);
    EXPECT_THAT(dense, HasSubstr("only suction holds it")) << slope_deg;
    // k = 2.2e-11 m2 and 1/alpha = 2e5 Pa: 1/kappa is 4.5 min where the patch is 0.86 m thick, and
    // 2 at its edges, which are half as thick.
    EXPECT_THAT(dense, ContainsRegex("away in about [2-5] min")) << slope_deg;
  }
  EXPECT_EQ(said_of(15, 0.66), "") << "friction holds it";
  EXPECT_EQ(said_of(31, 0.66, 4000), "") << "cohesion does";
  EXPECT_EQ(said_of(31, 0.60), "") << "it runs";
}

TEST(Mixture, WithoutANumberForItsPressureItIsNotAtRest) {
  for (const bool stiff : {true, false}) {
    MixtureSettings wet = settings_of(0.6);
    (stiff ? wet.law.compressibility : wet.law.fluid_viscosity) = 1e-310;
    HandMade made = wet_columns(even_ground(60, 0.5), test::block({4, 4, 1}, {-20, -2, 0}),
                                std::vector<double>(16, 1), wet);
    for (int n = 0; n < 10 && made.state.grains().motion.finite; ++n) made.advance();
    EXPECT_FALSE(made.state.grains().motion.finite) << "the run must end as diverged";
  }
}

class ResolvedMixture : public testing::TestWithParam<ProfileSettings> {};
INSTANTIATE_TEST_SUITE_P(Drains, ResolvedMixture,
                         testing::Values(ProfileSettings{8, false}, ProfileSettings{5, true}),
                         [](const auto& i) { return i.param.drained_bed ? "Both" : "Top"; });

TEST_P(ResolvedMixture, KeepsBothVolumesWhereMassLeaves) {  // T10
  for (const double m : {0.5, 0.6, 0.68}) {
    MixtureSettings wet = settings_of(m);
    wet.profile = GetParam();
    wet.law.permeability = 1e-8;
    HandMade made = wet_columns(even_ground(24, 0.6), test::block({8, 6, 1}, {-4, -3, 0}),
                                std::vector<double>(48, 0.8), wet, {6, 0.5, -3.6});
    const MovingSet& p = made.state.grains();
    for (int n = 0; n < 400 && p.size() > 0; ++n) {
      made.advance();
      const Volumes now(p);
      ASSERT_NEAR((now.solids + p.ledger.lost_solids) / p.ledger.released_solids, 1, 1e-13);
      ASSERT_NEAR((now.water + p.ledger.lost_water) / p.ledger.released_water, 1, 1e-13);
      expect_within_bounds(p, wet.law);
    }
    EXPECT_GT(p.ledger.lost_solids, 0);
  }
}

TEST_P(ResolvedMixture, BedThatJoinsLiftsWhatItStandsUnder) {
  MixtureSettings wet = settings_of(0.62);
  wet.profile = GetParam();
  HandMade made = wet_columns(even_ground(40), test::block({4, 4, 1}, {-2, -2, 0}),
                              std::vector<double>(16, 1), wet);
  made.advance();
  MovingSet& p = made.state.grains();
  auto& nodes = p.components(fields::excess_profile_of(wet.profile.nodes));
  const ProfileMesh mesh{wet.profile.nodes, wet.profile.drained_bed};
  for (int j = 0; j < mesh.nodes; ++j) nodes[j][5] = 1000 * (1 - mesh.height(j));
  p.scalar(fields::excess_pressure)[5] = mesh.drained_bed ? 0 : 1000;
  AddedMixture bed{0.155, 0.095, 0.62, 500};  // a quarter of what is there
  bed.drained_bed = mesh.drained_bed;
  add_to_mixture(p, 5, bed);
  for (int j = 1; j < mesh.nodes - 1; ++j) {
    const double old = (mesh.height(j) - 0.2) / 0.8;
    if (old < 0.5 * mesh.spacing()) continue;
    EXPECT_NEAR(nodes[j][5], 1000 * (1 - old), 1e-9) << j;
  }
  EXPECT_NEAR(p.scalar(fields::excess_pressure)[5], mesh.drained_bed ? 0 : 1500, 1e-9);
  if (!mesh.drained_bed) {
    EXPECT_NEAR(nodes[0][5], 1500, 1e-9);
  }
}

TEST(Mixture, IsNotThereWhereNothingAsksForIt) {
  HandMade made = test::columns_on(even_ground(20), test::block({3, 3, 1}), 1, {0, 0, 0});
  made.advance();
  const MovingSet& p = made.state.grains();
  for (const FieldKey* key :
       {&fields::solid_fraction, &fields::solids_volume, &fields::water_volume,
        &fields::excess_pressure, &fields::pore_pressure, &fields::pore_gravity})
    EXPECT_FALSE(p.has(*key)) << key->name;
  HandMade wet = wet_columns(even_ground(20), test::block({3, 3, 1}), std::vector<double>(9, 1),
                             settings_of(0.6));
  wet.advance();
  for (const FieldKey& key : fields::excess_profile)
    EXPECT_FALSE(wet.state.grains().has(key)) << "a parabola has no nodes";
  EXPECT_EQ(p.ledger.released_solids, 0);
  EXPECT_EQ(p.ledger.clipped_work, 0);
}

}  // namespace
}  // namespace sturz
