// SPDX-License-Identifier: Apache-2.0
/// The ground that members share: averaged for columns, prepared once, laid over by excavations.
#include "scenarios/assembly/ground.hpp"

#include "engine/core/error.hpp"
#include "scenarios/assembly/scene_plan.hpp"
#include "tests/support/formula_ground.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace sturz {
namespace {

using test::raster_of;

double hills(double x, double y) { return 200 + 8 * std::sin(x / 5) - 0.3 * y; }

/// Inputs on n_cols x n_rows cells of `cell`.
SceneInputs inputs(int n_cols, int n_rows, double cell) {
  SceneInputs in;
  in.elevation = std::make_shared<const Raster<double>>(
      raster_of(hills, Grid{n_cols, n_rows, 1000, 500, cell, ""}));
  return in;
}

Scenario scene(double spacing) {
  Scenario s;
  s.grains.emplace();
  s.numerics.spacing_m = spacing;
  return s;
}

void expect_same_ground(const Terrain& a, const Terrain& b) {
  ASSERT_TRUE(a.grid().same_place(b.grid()));
  EXPECT_EQ(a.nodata_rule(), b.nodata_rule());
  for (int r = 0; r < a.grid().n_rows; ++r)
    for (int c = 0; c < a.grid().n_cols; ++c) ASSERT_EQ(a.node(r, c), b.node(r, c));
}

TEST(Coarsened, HoldsMeansOfWholeBlocks) {
  const Raster<double> fine =
      raster_of([](double x, double y) { return x + 1000 * y; }, Grid{11, 8, 100, 50, 2, "here"});
  const Raster<double> coarse = coarsened(fine, 3);
  EXPECT_EQ(coarse.grid.n_cols, 3);  // two columns in the east, two rows in the south are left out
  EXPECT_EQ(coarse.grid.n_rows, 2);
  EXPECT_EQ(coarse.grid.cell_m, 6);
  EXPECT_EQ(coarse.grid.west_m, 100);
  EXPECT_EQ(coarse.grid.north_m, 50);
  EXPECT_EQ(coarse.grid.crs_wkt, "here");
  for (int r = 0; r < 2; ++r)
    for (int c = 0; c < 3; ++c)  // the mean of a plane is its value at the centre
      EXPECT_NEAR(coarse.at(r, c), coarse.grid.x_center(c) + 1000 * coarse.grid.y_center(r), 1e-9);
}

TEST(Coarsened, AMeanIsNotThatOfThePoints) {
  Raster<double> fine(Grid{4, 2, 0, 4, 2, ""}, 1.0);
  fine.at(0, 0) = 9;
  EXPECT_EQ(coarsened(fine, 2).at(0, 0), 3);
  EXPECT_EQ(coarsened(fine, 2).at(0, 1), 1);
  EXPECT_EQ(coarsened(fine, 1).values, fine.values);
}

TEST(Coarsened, IsUnknownWhereOneCellIs) {
  Raster<double> fine(Grid{6, 4, 0, 4, 1, ""}, 7.0);
  fine.at(3, 5) = nan_d;
  const Raster<double> coarse = coarsened(fine, 2);
  EXPECT_TRUE(std::isnan(coarse.at(1, 2)));
  EXPECT_EQ(coarse.at(1, 1), 7);
  EXPECT_EQ(coarse.at(0, 2), 7);
}

TEST(ColumnGround, AveragesAsManyCellsAsASpacingHolds) {
  const SceneInputs in = inputs(40, 32, 1);
  for (const auto& [spacing, factor] :
       {std::pair(0.3, 1), {1.0, 1}, {1.99, 1}, {2.0, 2}, {2.9, 2}, {3.0, 3}})
    EXPECT_EQ(column_ground_factor(scene(spacing), in), factor) << spacing;
}

TEST(ColumnGround, CountsCellsWhoseSizesAreNoBinaryFractions) {
  // 0.6/0.2 and 0.3/0.1 are a hair under three in binary.
  EXPECT_EQ(column_ground_factor(scene(0.6), inputs(40, 32, 0.2)), 3);
  EXPECT_EQ(column_ground_factor(scene(0.3), inputs(40, 32, 0.1)), 3);
  EXPECT_EQ(column_ground_factor(scene(0.59), inputs(40, 32, 0.2)), 2);
}

TEST(ColumnGround, LeavesEightCellsOfASmallGround) {
  EXPECT_EQ(column_ground_factor(scene(100), inputs(40, 32, 1)), 4);
  EXPECT_EQ(column_ground_factor(scene(100), inputs(40, 15, 1)), 1);
  EXPECT_EQ(column_ground_factor(scene(100), inputs(5, 5, 1)), 1);
}

TEST(ColumnGround, IsNotAveragedWherePeriodic) {
  Scenario s = scene(4);
  s.domain.periodic = {"x"};
  EXPECT_EQ(column_ground_factor(s, inputs(40, 32, 1)), 1);
}

TEST(SceneGround, IsTheRasterForParticlesAndItsMeansForColumns) {
  const SceneInputs in = inputs(40, 32, 1);
  const Scenario s = scene(3);
  const Terrain fine = scene_ground(s, in, {}, false), coarse = scene_ground(s, in, {}, true);
  expect_same_ground(fine, Terrain(in.elevation, NodataRule::outflow));
  expect_same_ground(coarse, test::ground_of(coarsened(*in.elevation, 3)));
}

TEST(SceneGround, PreparedGroundEqualsTheBuiltOne) {
  for (const TerrainEdge edge : {TerrainEdge::outflow, TerrainEdge::wall})
    for (const double spacing : {1.0, 3.0}) {
      Scenario s = scene(spacing);
      s.terrain.nodata = edge;
      const SceneInputs bare = inputs(40, 32, 1);
      SceneInputs prepared = bare;
      prepare_grounds(s, prepared);
      EXPECT_NE(prepared.ground, nullptr);
      EXPECT_EQ(prepared.column_ground != nullptr, spacing > 1);
      for (const bool for_columns : {false, true})
        expect_same_ground(scene_ground(s, prepared, {}, for_columns),
                           scene_ground(s, bare, {}, for_columns));
    }
}

TEST(SceneGround, TakesWhatIsPreparedUnlessItIsOfAnotherSize) {
  SceneInputs in = inputs(40, 32, 1);
  auto marked = [](double cell) {
    return std::make_shared<const Terrain>(
        test::ground_of([](double, double) { return -77; }, Grid{13, 10, 1000, 500, cell, ""}));
  };
  in.column_ground = marked(3);
  EXPECT_EQ(scene_ground(scene(3), in, {}, true).node(0, 0), -77);
  EXPECT_NE(scene_ground(scene(2), in, {}, true).node(0, 0), -77) << "of another spacing";
  EXPECT_NE(scene_ground(scene(3), in, {}, false).node(0, 0), -77);
  in.ground = marked(1);
  EXPECT_EQ(scene_ground(scene(3), in, {}, false).node(0, 0), -77);
}

TEST(SceneGround, RepeatsBeyondAPeriodWithItsRise) {
  Scenario s = scene(3);
  s.domain.periodic = {"x", "y"};
  const SceneInputs in = inputs(40, 32, 1);
  Domain d;
  d.x = {true, 1000, 1040, -5}, d.y = {true, 468, 500, 2};
  const Terrain t = scene_ground(s, in, d, true);
  ASSERT_EQ(t.grid().n_cols, 44);
  ASSERT_EQ(t.grid().n_rows, 36);
  EXPECT_EQ(t.node(2, 2), in.elevation->at(0, 0));
  EXPECT_EQ(t.node(2, 42), in.elevation->at(0, 0) - 5);
  EXPECT_EQ(t.node(2, 1), in.elevation->at(0, 39) + 5);
  EXPECT_EQ(t.node(1, 2), in.elevation->at(31, 0) + 2) << "rows run southward";
  EXPECT_EQ(t.node(35, 43), in.elevation->at(1, 1) - 2 - 5);
  SceneInputs prepared = in;
  prepare_grounds(s, prepared);
  EXPECT_EQ(prepared.ground, nullptr) << "each member lays its own margin";
  EXPECT_EQ(prepared.column_ground, nullptr);
}

/// A lumpy release of some 20 x 14 m on the given ground, cut out of it.
struct Excavation {
  Scenario s;
  SceneInputs in = inputs(41, 34, 1);
  double volume = 0;

  Excavation(double spacing, Formulation formulation) : s(scene(spacing)) {
    s.formulation = formulation;
    s.numerics.accept_unresolved = true;
    s.release.surface = ReleaseSurface::pre_failure;
    std::mt19937 random(4);
    std::uniform_real_distribution<double> lump(0, 6);
    Raster<double> thickness(in.elevation->grid);
    for (int r = 9; r < 23; ++r)
      for (int c = 8; c < 28; ++c) volume += thickness.at(r, c) = lump(random);
    thickness.at(0, 0) = nan_d;
    in.release = std::make_shared<const Raster<double>>(std::move(thickness));
    in.pattern = ReleasePattern::thickness;
  }
};

/// What lies between a ground and the bed below it [m^3].
double volume_between(const Terrain& ground, const Terrain& bed) {
  double sum = 0;
  for (int r = 0; r < bed.grid().n_rows; ++r)
    for (int c = 0; c < bed.grid().n_cols; ++c) sum += ground.node(r, c) - bed.node(r, c);
  return sum * bed.grid().cell_m * bed.grid().cell_m;
}

TEST(SceneGround, AnExcavationKeepsTheVolumeOnTheAveragedGround) {
  for (const double spacing : {1.0, 2.0, 3.0, 4.0}) {
    const Excavation e(spacing, Formulation::depth_averaged);
    const ScenePlan plan = plan_scene(e.s, e.in, 0);
    const Terrain ground = scene_ground(e.s, e.in, {}, true);
    ASSERT_EQ(plan.bed.grid().cell_m, spacing);
    EXPECT_NEAR(volume_between(ground, plan.bed), e.volume, 1e-9 * e.volume) << spacing;
    EXPECT_NEAR(plan.release.volume_m3, e.volume, 1e-9 * e.volume);
  }
}

TEST(SceneGround, AnExcavationForParticlesIsCutOutOfTheRaster) {
  const Excavation e(3, Formulation::full_stress);
  const ScenePlan plan = plan_scene(e.s, e.in, 0);
  EXPECT_EQ(plan.bed.grid().cell_m, 1);
  EXPECT_NEAR(volume_between(scene_ground(e.s, e.in, {}, false), plan.bed), e.volume,
              1e-9 * e.volume);
}

TEST(SceneGround, AReleaseWithoutMassIsNamedAsSuch) {
  Excavation e(3, Formulation::full_stress);
  e.in.release = std::make_shared<const Raster<double>>(e.in.elevation->grid, 0.0);
  e.s.numerics.accept_unresolved = false;
  try {
    plan_scene(e.s, e.in, 0);
    ADD_FAILURE() << "accepted";
  } catch (const SetupError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("there is no mass"));
  }
}

}  // namespace
}  // namespace sturz
