// SPDX-License-Identifier: Apache-2.0
#include "scenarios/shapes/synthetic_terrain.hpp"

#include "engine/core/error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace sturz {
namespace {

double volume(const Raster<double>& h) {
  return std::accumulate(h.values.begin(), h.values.end(), 0.0) * h.grid.cell_m * h.grid.cell_m;
}
double area(const Raster<double>& h) {
  return std::count_if(h.values.begin(), h.values.end(), [](double v) { return v > 0; }) *
         h.grid.cell_m * h.grid.cell_m;
}
double largest(const Raster<double>& h) {
  return *std::max_element(h.values.begin(), h.values.end());
}
/// Value of the cell that holds the point (s, n) of a landslide ground.
double on_axes(const Raster<double>& r, double s, double n) {
  return r.at(r.grid.row_of(2900000 + n), r.grid.col_of(500000 + s));
}

struct Station {
  double s, n, bed, thickness;
};

// Stations and totals: an independent implementation of the same description, 5 m cells.
TEST(SyntheticTerrain, ZhangjiawanHasThePublishedProfile) {
  const auto scene = make_synthetic({"zhangjiawan", 5, {}});
  const std::vector<Station> stations = {
      {-202.5, -2.5, 2081.080000, 0},       {22.5, -2.5, 2068.956000, 45.761325},
      {57.5, -2.5, 2031.776186, 54.817977}, {112.5, -2.5, 1985.677486, 11.822514},
      {187.5, -2.5, 1934.001184, 0},        {187.5, 97.5, 1935.764885, 0},
      {277.5, -347.5, 1931.769032, 0},      {427.5, -2.5, 1861.621454, 0},
      {482.5, -2.5, 1873.552002, 0},        {517.5, -2.5, 1860.198322, 0},
      {682.5, -2.5, 1833.973110, 0},        {837.5, -2.5, 1815.318422, 0},
      {997.5, 97.5, 1800.818906, 0},        {1197.5, -347.5, 1794.485479, 0}};
  for (const auto& [s, n, bed, thickness] : stations) {
    EXPECT_NEAR(on_axes(scene.bed, s, n), bed, 1e-5) << s << ", " << n;
    EXPECT_NEAR(on_axes(*scene.thickness, s, n), thickness, 1e-5) << s << ", " << n;
  }
  // The other implementation ends at s = 1200.
  double sum = 0;
  for (int row = 0; row < scene.bed.grid.n_rows; ++row)
    for (int col = 0; col < 300; ++col) sum += scene.bed.at(row, col);
  EXPECT_NEAR(sum, 92145134.91318616, 1e-3);
}

TEST(SyntheticTerrain, ZhangjiawanFalls305MetresAndClimbsAHill) {
  const auto scene = make_synthetic({"zhangjiawan", 5, {}});
  const double crown = 2120, front = on_axes(scene.bed, 837.5, 0);
  EXPECT_NEAR(crown - front, 305, 1);
  EXPECT_NEAR(on_axes(scene.bed, 482.5, 0) - on_axes(scene.bed, 427.5, 0), 12, 0.5);
}

TEST(SyntheticTerrain, ZhangjiawanGoesOnUntilTheLeastFrictionOfTheShippedCaseEnds) {
  const auto scene = make_synthetic({"zhangjiawan", 5, {}});
  const Grid& g = scene.bed.grid;
  const double least = 0.20 * (1 - 0.3);  // basal friction and pore-pressure ratio
  bool met = false;
  for (double s = 2.5; s < 2600 && !met; s += 5)  // 100 m before the end
    met = on_axes(scene.bed, s, 2.5) > 2120 - least * s;
  EXPECT_TRUE(met);
  EXPECT_EQ(g.east_m(), 502700);
}

TEST(SyntheticTerrain, ZhangjiawanSourceHasItsVolumeAtAnyCellSize) {
  for (const double cell : {2.5, 5.0, 10.0}) {
    const auto scene = make_synthetic({"zhangjiawan", cell, {}});
    EXPECT_NEAR(volume(*scene.thickness), 491000, 1e-6);
    EXPECT_NEAR(area(*scene.thickness), 17500, 800) << cell;
    EXPECT_NEAR(largest(*scene.thickness), 55, 1) << cell;
  }
}

TEST(SyntheticTerrain, ShuichengHasThePublishedProfile) {
  const auto scene = make_synthetic({"shuicheng", 5, {}});
  const std::vector<Station> stations = {
      {-202.5, -2.5, 1765.918614, 0},        {22.5, -2.5, 1679.627647, 10.472511},
      {57.5, -2.5, 1653.618382, 30.844601},  {112.5, -2.5, 1620.002835, 30.844601},
      {187.5, -2.5, 1575.003014, 20.690433}, {212.5, -2.5, 1560.003078, 4.945799},
      {337.5, 97.5, 1504.765219, 0},         {482.5, -2.5, 1443.048183, 0},
      {517.5, 97.5, 1448.507999, 0},         {682.5, -2.5, 1373.682437, 0},
      {837.5, 97.5, 1322.235431, 0},         {1192.5, -547.5, 1299.969683, 0},
      {1597.5, -2.5, 1254.078282, 0}};
  for (const auto& [s, n, bed, thickness] : stations) {
    EXPECT_NEAR(on_axes(scene.bed, s, n), bed, 1e-5) << s << ", " << n;
    EXPECT_NEAR(on_axes(*scene.thickness, s, n), thickness, 1e-5) << s << ", " << n;
  }
  EXPECT_NEAR(std::accumulate(scene.bed.values.begin(), scene.bed.values.end(), 0.0),
              132181781.38344425, 1e-3);
}

TEST(SyntheticTerrain, ShuichengSourceAndGulliesAreAsDescribed) {
  const auto scene = make_synthetic({"shuicheng", 5, {}});
  EXPECT_NEAR(volume(*scene.thickness), 700000, 1e-6);
  EXPECT_NEAR(area(*scene.thickness), 39000, 500);
  EXPECT_NEAR(largest(*scene.thickness), 31, 0.5);
  // Gully floor at path distance 900 and the ridge between the gullies: 21 m higher.
  const double a = 14.5 * std::numbers::pi / 180;
  const double t = 480 + 420 * std::cos(a), n = 420 * std::sin(a);
  EXPECT_NEAR(on_axes(scene.bed, t, n), 1309, 2);
  EXPECT_NEAR(on_axes(scene.bed, t, -n), 1309, 2);
  EXPECT_NEAR(on_axes(scene.bed, t, 0) - on_axes(scene.bed, t, n), 21, 2);
  const double p1340 = 480 + 860 * std::cos(a);
  EXPECT_NEAR(1700 - on_axes(scene.bed, p1340, 860 * std::sin(a)), 458, 4);
}

TEST(SyntheticTerrain, SourceVolumeIsAParameter) {
  const auto scene = make_synthetic({"shuicheng", 10, {{"volume_m3", 1.16e6}}});
  EXPECT_NEAR(volume(*scene.thickness), 1.16e6, 1e-5);
}

TEST(SyntheticTerrain, LandslideGroundsCarryAMapLabelAndLieNorthUp) {
  const auto scene = make_synthetic({"zhangjiawan", 10, {}});
  const Grid& g = scene.bed.grid;
  EXPECT_EQ(g.n_cols, 300);
  EXPECT_EQ(g.n_rows, 80);
  EXPECT_EQ(g.west_m, 499700);
  EXPECT_EQ(g.north_m, 2900400);
  EXPECT_THAT(g.crs_wkt, ::testing::StartsWith("PROJCRS[\"WGS 84 / UTM zone 48N\""));
  EXPECT_THAT(g.crs_wkt, ::testing::EndsWith("ID[\"EPSG\",32648]]"));
  EXPECT_TRUE(scene.thickness->grid.same_place(g));
  EXPECT_TRUE(make_synthetic({"plane", 10, {}}).bed.grid.crs_wkt.empty());
}

TEST(SyntheticTerrain, PlaneFallsTowardsItsAzimuth) {
  for (const double azimuth : {0.0, 30.0, 45.0, 90.0, 210.0}) {
    const auto bed =
        make_synthetic({"plane", 5, {{"slope_deg", 25}, {"azimuth_deg", azimuth}}}).bed;
    const double fall = std::tan(25 * std::numbers::pi / 180), a = azimuth * std::numbers::pi / 180;
    const double dx = bed.at(3, 4) - bed.at(3, 3), dy = bed.at(2, 3) - bed.at(3, 3);
    EXPECT_NEAR(dx / 5, -fall * std::sin(a), 1e-12) << azimuth;
    EXPECT_NEAR(dy / 5, -fall * std::cos(a), 1e-12) << azimuth;
  }
}

TEST(SyntheticTerrain, ARightAngleMakesAGridWithoutAnExtraColumn) {
  const Grid g = make_synthetic({"plane", 2, {{"length_m", 200}, {"width_m", 100}}}).bed.grid;
  EXPECT_EQ(g.n_cols, 100);
  EXPECT_EQ(g.n_rows, 50);
  EXPECT_EQ(g.west_m, -100);
  EXPECT_EQ(g.south_m(), -50);
}

TEST(SyntheticTerrain, RampHasNoKinkAndTheRightHeights) {
  const auto bed = make_synthetic({"ramp", 1, {}}).bed;
  const double fall = std::tan(30 * std::numbers::pi / 180);
  double before = 0;
  for (int col = 1; col < bed.grid.n_cols; ++col) {
    const double slope = bed.at(0, col) - bed.at(0, col - 1);
    EXPECT_LE(slope, 1e-12);
    const double curvature = col > 1 ? std::abs(slope - before) : 0;
    EXPECT_LT(curvature, fall / 40 + 1e-9) << col;
    before = slope;
  }
  EXPECT_NEAR(bed.at(0, bed.grid.col_of(-100.5)), 100.5 * fall, 1e-12);
  EXPECT_EQ(bed.at(0, bed.grid.col_of(100)), 0);
}

TEST(SyntheticTerrain, RampTurnedByItsAzimuthIsTheSameRamp) {
  const auto east = make_synthetic({"ramp", 1, {}}).bed;
  const auto north = make_synthetic({"ramp", 1, {{"azimuth_deg", 0}}}).bed;
  ASSERT_EQ(east.grid.n_cols, north.grid.n_rows);
  for (int k = 0; k < east.grid.n_cols; k += 7)
    EXPECT_NEAR(east.at(10, k), north.at(north.grid.n_rows - 1 - k, 10), 1e-9);
}

TEST(SyntheticTerrain, StepDropsByItsFace) {
  const auto bed = make_synthetic({"step", 1, {{"drop_m", 20}, {"face_deg", 60}}}).bed;
  EXPECT_EQ(bed.at(0, bed.grid.col_of(-5)), 0);
  EXPECT_NEAR(bed.at(0, bed.grid.col_of(40)), -20, 1e-12);
  EXPECT_NEAR(bed.at(0, bed.grid.col_of(5.5)), -5.5 * std::tan(std::numbers::pi / 3), 1e-9);
}

TEST(SyntheticTerrain, FlumeEndsOnALevelPlate) {
  const auto bed = make_synthetic({"flume", 0.05, {}}).bed;
  const double a = 20 * std::numbers::pi / 180;
  EXPECT_NEAR(bed.grid.west_m, -0.5 * std::cos(a), 1e-12);
  EXPECT_NEAR(bed.grid.east_m(), 3 * std::cos(a) + 4.8, 0.05);
  EXPECT_EQ(bed.at(5, bed.grid.col_of(3)), 0);
  const int top = bed.grid.col_of(0);
  EXPECT_NEAR(bed.at(5, top), (3 * std::cos(a) - bed.grid.x_center(top)) * std::tan(a), 1e-12);
}

TEST(SyntheticTerrain, AFlumesSideWallsEndWithItsFloor) {
  const Raster<double> open = make_synthetic({"flume", 0.02, {}}).bed;
  const Raster<double> bed =
      make_synthetic({"flume", 0.02, {{"channel_width_m", 0.5}, {"wall_height_m", 0.4}}}).bed;
  const auto rise = [&](double x, double y) {
    const int r = bed.grid.row_of(y), c = bed.grid.col_of(x);
    return bed.at(r, c) - open.at(r, c);
  };
  for (const double side : {-1.0, 1.0}) {
    EXPECT_EQ(rise(1, side * 0.24), 0);
    EXPECT_NEAR(rise(1, side * 0.28), 0.4, 1e-12);
    EXPECT_EQ(rise(3, side * 0.28), 0) << "the plate is open";
  }
}

TEST(SyntheticTerrain, DebrisFlumeIsAChuteAnArcAndAPad) {
  const auto scene = make_synthetic({"debris_flume", 0.1, {}});
  const Raster<double>& bed = scene.bed;
  const double chute = 31 * std::numbers::pi / 180, pad = 2.5 * std::numbers::pi / 180;
  const int middle = bed.grid.n_rows / 2;
  const auto slope = [&](double x) {
    const int c = bed.grid.col_of(x);
    return (bed.at(middle, c - 1) - bed.at(middle, c + 1)) / 0.2;
  };
  EXPECT_NEAR(slope(-2), std::tan(chute), 1e-9);
  EXPECT_NEAR(slope(60), std::tan(chute), 1e-9);
  EXPECT_NEAR(slope(90), std::tan(pad), 1e-9);
  // The arc: where the bed has 20 degrees, 11 degrees times 10 m below its start.
  const double x20 =
      78 * std::cos(chute) + 10 * (std::sin(chute) - std::sin(20 * std::numbers::pi / 180));
  EXPECT_NEAR(slope(x20), std::tan(20 * std::numbers::pi / 180), 0.01);
  // Walls to s = 82.5 m; the pad is open.
  const auto across = [&](double x) {
    const int c = bed.grid.col_of(x);
    return bed.at(bed.grid.row_of(1.5), c) - bed.at(middle, c);
  };
  EXPECT_NEAR(across(-2), 2.5, 1e-9);
  EXPECT_NEAR(across(50), 1.6, 1e-9);
  EXPECT_NEAR(across(75), 0, 1e-9);
  double volume = 0, thickest = 0;
  for (const double h : scene.thickness->values)
    volume += 0.01 * h, thickest = std::max(thickest, h);
  EXPECT_NEAR(volume, 10, 1e-9);
  EXPECT_NEAR(thickest * std::cos(chute), 1.9 * std::cos(chute), 0.06);
  EXPECT_EQ(scene.thickness->at(middle, bed.grid.col_of(0.1)), 0) << "behind the gate";
}

TEST(SyntheticTerrain, BowlIsLowestInItsMiddle) {
  const auto bed = make_synthetic({"bowl", 1, {{"size_m", 21}}}).bed;
  EXPECT_NEAR(bed.at(10, 10), 0, 1e-12);
  EXPECT_NEAR(bed.at(10, 20), 100.0 / 200, 1e-12);
}

TEST(SyntheticTerrain, EveryShapeBuildsWithItsDefaults) {
  for (const auto& shape : synthetic_shapes()) {
    const auto scene = make_synthetic({shape, shape.ends_with("flume") ? 0.1 : 10, {}});
    EXPECT_EQ(scene.bed.values.size(), scene.bed.grid.n_cells()) << shape;
    EXPECT_TRUE(std::all_of(scene.bed.values.begin(), scene.bed.values.end(), [](double z) {
      return std::isfinite(z);
    })) << shape;
    EXPECT_EQ(scene.thickness.has_value(), brings_source(shape)) << shape;
    for (const auto& p : shape_parameters(shape)) {
      EXPECT_LE(p.min, p.default_value) << shape << "." << p.name;
      EXPECT_GE(p.max, p.default_value) << shape << "." << p.name;
    }
  }
}

TEST(SyntheticTerrain, RefusesUnknownNamesAndHugeGrids) {
  EXPECT_THROW(make_synthetic({"cone", 1, {}}), SetupError);
  EXPECT_THROW(make_synthetic({"plane", 1, {{"slope", 3}}}), SetupError);
  EXPECT_THROW(make_synthetic({"plane", 0.001, {{"length_m", 1e5}}}), SetupError);
  EXPECT_THROW(make_synthetic({"zhangjiawan", 400, {}}), SetupError) << "no cell in the source";
  EXPECT_THROW(shape_parameters("cone"), SetupError);
}

}  // namespace
}  // namespace sturz
