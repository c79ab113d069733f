// SPDX-License-Identifier: Apache-2.0
// The energy line over the ground: how far it reaches, what of the raster is looked at, where it
// meets the end.
#include "scenarios/assembly/reach.hpp"

#include "scenarios/assembly/time_cap.hpp"
#include "scenarios/scenario.hpp"
#include "scenarios/scene_inputs.hpp"
#include "tests/support/formula_ground.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace sturz {
namespace {

using test::raster_of;

const Grid grid{1000, 800, 2000, 9000, 5, ""};

/// Level ground with a knoll of 100 m that falls off within 200 m of the release.
double knoll(double x, double y) {
  const double d = std::hypot(x - 4502.5, y - 7002.5);
  return d < 200 ? 100 - 0.5 * d : 0;
}

ReadGround reader(const std::function<double(double, double)>& f, double* most = nullptr) {
  return [f, most](const Window& w) {
    if (most) *most = std::max(*most, static_cast<double>(w.n_cells()));
    return raster_of(f, grid_of(w, grid));
  };
}

EnergyLine line_from(double top, double friction) {
  return {{399, 500, 1, 1}, top, friction};  // the cell at 4502.5, 7002.5
}

TEST(Reach, IsTheDropOverTheFriction) {
  const Reach r = followed(line_from(100, 0.2), grid, reader(knoll));
  // Level ground at 0: the line of 0.2 from 100 m meets it after 500 m.
  EXPECT_NEAR(r.length_m, 500, 2 * grid.cell_m);
  EXPECT_EQ(r.lowest_m, 0);
  EXPECT_NEAR(r.window.n_rows * grid.cell_m, 1000, 4 * grid.cell_m);
  EXPECT_NEAR(r.window.n_cols * grid.cell_m, 1000, 4 * grid.cell_m);
  EXPECT_EQ(r.above_end_m, 0);
  EXPECT_FALSE(r.cut);
}

TEST(Reach, LooksAtNoMoreThanItNeeds) {
  double most = 0;
  followed(line_from(100, 0.2), grid, reader(knoll, &most));
  EXPECT_LT(most, 0.5 * static_cast<double>(grid.n_cells()));
}

TEST(Reach, DoesNotCrossARidgeAboveTheLine) {
  // A wall of 300 m, 150 m to the east, with lower ground behind it.
  const auto walled = [](double x, double y) {
    return x > 4650 && x < 4700 ? 300.0 : x >= 4700 ? -500.0 : knoll(x, y);
  };
  const Reach r = followed(line_from(100, 0.2), grid, reader(walled));
  EXPECT_EQ(r.lowest_m, 0);
  EXPECT_LE(grid.west_m + r.window.end_col() * grid.cell_m, 4650 + grid.cell_m);
}

TEST(Reach, MeetsTheEndOfTheRasterAndSaysWhere) {
  const auto slope = [](double x, double) { return -0.4 * (x - 4502.5); };
  const Reach r = followed(line_from(0.1, 0.3), grid, reader(slope));
  EXPECT_EQ(r.end, "east");
  // At the last column's centre the ground has fallen by 0.4, the line by 0.3 per metre.
  const double way = grid.x_center(999) - 4502.5;
  EXPECT_NEAR(r.above_end_m, 0.1 * way + 0.1, 0.5);
  EXPECT_NEAR(r.lowest_m, -0.4 * way, 1e-9);
}

TEST(Reach, TellsUnknownCellsFromTheEnd) {
  const auto holed = [](double x, double y) {
    return std::hypot(x - 4802.5, y - 7002.5) < 30 ? nan_d : knoll(x, y);
  };
  const Reach r = followed(line_from(100, 0.2), grid, reader(holed));
  EXPECT_GT(r.above_unknown_m, 40);  // 100 - 0.2 * 330 = 34 on the far side, 46 on the near one
  EXPECT_LT(r.above_unknown_m, 50);
  EXPECT_EQ(r.above_end_m, 0);
}

TEST(Reach, IsCutWhereItGrowsTooLarge) {
  double most = 0;
  const Reach r = followed(line_from(100, 0), grid, reader(knoll, &most), 200000);
  EXPECT_TRUE(r.cut);
  EXPECT_LE(most, 200000);
  EXPECT_NEAR(r.length_m, std::hypot(5000, 4000), 1) << "the raster's diagonal stands in";
}

TEST(Reach, WindowsOfHigherLevelsAreNestedAndEndWithTheWhole) {
  const Window first{380, 480, 40, 50};
  Window before = first;
  for (int level = 1; level < 8; ++level) {
    const Window w = larger_window(first, level, grid);
    EXPECT_TRUE(w.contains(before));
    EXPECT_TRUE(w == whole_of(grid) || w.n_cells() > 2 * before.n_cells() ||
                w.n_rows == grid.n_rows || w.n_cols == grid.n_cols);
    before = w;
  }
  EXPECT_EQ(before, whole_of(grid));
  EXPECT_EQ(larger_window(first, 0, grid), first);
}

TEST(DrawnRange, IsTheSupportOrFourStandardDeviations) {
  EXPECT_EQ(drawn_range(Uncertain(0.3)), std::pair(0.3, 0.3));
  Uncertain u;
  Distribution d;
  d.kind = Distribution::Kind::uniform;
  d.min = 0.1, d.max = 0.4;
  u.distribution = d;
  EXPECT_EQ(drawn_range(u), std::pair(0.1, 0.4));
  d = {};
  d.kind = Distribution::Kind::normal;
  d.mean = 0.3, d.sd = 0.05;
  u.distribution = d;
  EXPECT_NEAR(drawn_range(u).first, 0.1, 1e-12);
  EXPECT_NEAR(drawn_range(u).second, 0.5, 1e-12);
  u.distribution->min = 0.2;
  EXPECT_EQ(drawn_range(u).first, 0.2);
  d = {};
  d.kind = Distribution::Kind::lognormal;
  d.median = 2, d.sigma_ln = 0.25;
  u.distribution = d;
  EXPECT_NEAR(drawn_range(u).first, 2 / std::exp(1.0), 1e-12);
}

class TimeCapTest : public ::testing::Test {
 protected:
  TimeCapTest() {
    s_.grains.emplace();
    in_.whole = grid;
    in_.reach.emplace().length_m = 1000;
  }
  Scenario s_;
  SceneInputs in_;
};

TEST_F(TimeCapTest, IsFourTimesTheWayAtTheWaveSpeed) {
  // sqrt(9.80665 * 4) = 6.263 m/s; 4 * 1000 / 6.263 = 638.7 s, rounded up to two digits.
  EXPECT_NEAR(time_cap(s_, in_, 4, 1600).end_time_s, 640, 1e-9);
  EXPECT_THAT(time_cap(s_, in_, 4, 1600).reason, ::testing::HasSubstr("1000 m"));
}

TEST_F(TimeCapTest, FollowsSlowFlows) {
  s_.basal.viscosity_pa_s = Uncertain(2000);
  // 1600 * 9.80665 * 0.05 * 1 / (3 * 2000) = 0.13076 m/s
  EXPECT_NEAR(time_cap(s_, in_, 1, 1600).end_time_s, 31000, 1e-6);
  s_.basal.viscosity_pa_s.reset();
  s_.basal.turbulent_coefficient_m_s2 = Uncertain(100);
  // sqrt(100 * 1 * 0.05) = 2.236 m/s
  EXPECT_NEAR(time_cap(s_, in_, 1, 1600).end_time_s, 1800, 1e-9);
}

TEST_F(TimeCapTest, TheScenariosOwnComesFirst) {
  s_.numerics.end_time_s = 77.5;
  EXPECT_EQ(time_cap(s_, in_, 4, 1600).end_time_s, 77.5);
}

TEST_F(TimeCapTest, HasBounds) {
  in_.reach->length_m = 1e9;
  EXPECT_EQ(time_cap(s_, in_, 1, 1600).end_time_s, 1e5);
  in_.reach->length_m = 1e-3;
  EXPECT_EQ(time_cap(s_, in_, 1, 1600).end_time_s, 1);
  s_.domain.periodic = {"x"};
  EXPECT_EQ(time_cap(s_, in_, 1, 1600).end_time_s, 120);
}

}  // namespace
}  // namespace sturz
