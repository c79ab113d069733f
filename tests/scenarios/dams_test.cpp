// SPDX-License-Identifier: Apache-2.0
// Dams on a raster: the shape by hand values, no gap whatever the direction, the same on any part.
#include "scenarios/assembly/structures/dams.hpp"

#include "engine/terrain/terrain.hpp"
#include "scenarios/assembly/structures/column_ground.hpp"
#include "scenarios/assembly/structures/structure_warnings.hpp"
#include "scenarios/scene_inputs.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <queue>

namespace sturz {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

Raster<double> ground_of(int n, double cell, const std::function<double(double, double)>& z) {
  Raster<double> out(Grid{n, n, 0, n * cell, cell, ""});
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) out.at(r, c) = z(out.grid.x_center(c), out.grid.y_center(r));
  return out;
}

/// Points a metre apart, with the ground of the same formula.
DamLine line_of(const std::vector<Vec2>& corners, const std::function<double(double, double)>& z) {
  DamLine line;
  line.name = "terrain.dams[0]";
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    const Vec2 along = corners[i + 1] - corners[i];
    const int n = static_cast<int>(std::ceil(along.norm()));
    for (int k = 0; k < n; ++k) line.points.emplace_back(corners[i] + k * along / n);
    line.length_m += along.norm();
  }
  line.points.push_back(corners.back());
  for (const Vec2& p : line.points) line.ground_m.push_back(z(p.x(), p.y()));
  return line;
}

DamSpec dam(double height, double width, double side) {
  DamSpec spec;
  spec.height_m = Uncertain(height);
  spec.crest_width_m = width, spec.side_slope = side;
  return spec;
}

double level(double, double) { return 100; }

TEST(Dams, AreATrapezeOnLevelGround) {
  Raster<double> z = ground_of(80, 1, level);
  // Along a row of centres; crest 4 m, sides 1 in 2: the foot 2 + 2*6 = 14 m away.
  const DamLine line = line_of({{20.5, 40.5}, {60.5, 40.5}}, level);
  const DamFacts facts = raise_dam(line, dam(6, 4, 2), 4, z);
  const int row = z.grid.row_of(40.5);
  for (const auto& [off, height] :
       {std::pair(0, 6.0), {2, 6.0}, {3, 5.5}, {8, 3.0}, {13, 0.5}, {14, 0.0}}) {
    EXPECT_DOUBLE_EQ(z.at(row + off, 40), 100 + height) << off;
    EXPECT_DOUBLE_EQ(z.at(row - off, 40), 100 + height) << off;
    EXPECT_DOUBLE_EQ(z.at(row, 20 - off), 100 + height) << "beyond its end " << off;
  }
  // Cross section 4*6 + 6*12 = 96 m2; each end a half cone: 2 x (pi/2 of 2, 14 m frustum).
  const double ends = std::numbers::pi * 6 / 3 * (14 * 14 + 14 * 2 + 2 * 2);
  EXPECT_NEAR(facts.fill_m3, 96 * 40 + ends, 0.01 * (96 * 40 + ends));
  EXPECT_DOUBLE_EQ(facts.highest_m, 6);
  EXPECT_EQ(facts.lowest_crest_m, 106);
  EXPECT_FALSE(facts.cut);
}

TEST(Dams, FollowTheGroundOrStandLevel) {
  const auto slope = [](double x, double) { return 0.1 * x; };
  const DamLine line = line_of({{10.5, 40.5}, {70.5, 40.5}}, slope);
  Raster<double> z = ground_of(80, 1, slope);
  raise_dam(line, dam(5, 4, 1), 4, z);
  const int row = z.grid.row_of(40.5);
  EXPECT_NEAR(z.at(row, 20), 2.05 + 5, 1e-9);
  EXPECT_NEAR(z.at(row, 60), 6.05 + 5, 1e-9);
  DamSpec flat = dam(1, 4, 1);
  flat.height_m.reset(), flat.crest_elevation_m = Uncertain(4);
  z = ground_of(80, 1, slope);
  raise_dam(line, flat, 4, z);
  EXPECT_NEAR(z.at(row, 20), 4, 1e-12);
  EXPECT_NEAR(z.at(row, 60), 6.05, 1e-12) << "the ground is higher there";
}

TEST(Dams, HaveUprightSidesWhereTheSlopeIsNone) {
  Raster<double> z = ground_of(60, 1, level);
  const DamFacts facts =
      raise_dam(line_of({{10.5, 30.5}, {50.5, 30.5}}, level), dam(5, 3, 0), 3, z);
  const int row = z.grid.row_of(30.5);
  EXPECT_EQ(z.at(row + 1, 30), 105);
  EXPECT_EQ(z.at(row + 2, 30), 100);
  EXPECT_FALSE(facts.cut);
}

TEST(Dams, OnGroundAsSteepAsTheirSidesEndInAStepAndSaySo) {
  const auto steep = [](double, double y) { return y; };  // 45 degrees
  Raster<double> z = ground_of(200, 1, steep);
  DamLine line = line_of({{50.5, 150.5}, {150.5, 150.5}}, steep);
  EXPECT_TRUE(raise_dam(line, dam(4, 4, 1.5), 4, z).cut);
  z = ground_of(200, 1, [](double, double y) { return 0.5 * y; });
  line = line_of({{50.5, 150.5}, {150.5, 150.5}}, [](double, double y) { return 0.5 * y; });
  EXPECT_FALSE(raise_dam(line, dam(4, 4, 1.5), 4, z).cut) << "27 degrees under 34";
  line.foot_heights = near_foot;
  z = ground_of(200, 1, [](double, double y) { return 0.5 * y; });
  EXPECT_TRUE(raise_dam(line, dam(4, 4, 1.5), 4, z).cut) << "its foot is farther than that";
}

/// Whether a way of neighbouring cells under the crest leads from the western to the eastern edge.
bool leaks(const Raster<double>& z, double crest) {
  const Grid& g = z.grid;
  std::vector<char> seen(g.n_cells(), 0);
  std::queue<std::pair<int, int>> open;
  const auto visit = [&](int r, int c) {
    if (!g.contains(r, c) || seen[g.index(r, c)] || z.at(r, c) >= crest - 1e-9) return;
    seen[g.index(r, c)] = 1;
    open.emplace(r, c);
  };
  for (int r = 0; r < g.n_rows; ++r) visit(r, 0);
  while (!open.empty()) {
    const auto [r, c] = open.front();
    open.pop();
    if (c == g.n_cols - 1) return true;
    for (int dr = -1; dr <= 1; ++dr)
      for (int dc = -1; dc <= 1; ++dc) visit(r + dr, c + dc);
  }
  return false;
}

TEST(Dams, ThinnerThanACellLeaveNoGapInAnyDirection) {
  for (const double tilt : {0.0, 3.0, 11.3, 26.6, 37.0, 45.0}) {
    const double lean = 200 * std::tan(tilt * std::numbers::pi / 180);
    const DamSpec spec = dam(5, 0.5, 0);
    Raster<double> z = ground_of(60, 5, level);
    const DamLine line =
        line_of({{150 - 0.5 * lean, -20}, {150 + 0.5 * lean + 0.2 * lean, 320}}, level);
    raise_dam(line, spec, standing_width(spec, 5), z);
    EXPECT_FALSE(leaks(z, 105)) << tilt;
  }
}

TEST(Dams, AnyPartOfARasterGetsTheSame) {
  const auto rough = [](double x, double y) {
    return 0.2 * x + 3 * std::sin(x / 9) * std::cos(y / 7);
  };
  const Raster<double> bare = ground_of(120, 2, rough);
  const DamLine line = line_of({{60, 60}, {110, 130}, {180, 150}}, rough);
  Raster<double> all = bare;
  raise_dam(line, dam(7, 4, 1.5), 4, all);
  for (const Window& w : {Window{10, 20, 40, 30}, Window{30, 50, 60, 60}, Window{0, 0, 5, 120}}) {
    Raster<double> part(grid_of(w, bare.grid));
    for (int r = 0; r < w.n_rows; ++r)
      for (int c = 0; c < w.n_cols; ++c) part.at(r, c) = bare.at(w.row0 + r, w.col0 + c);
    raise_dam(line, dam(7, 4, 1.5), 4, part);
    for (int r = 0; r < w.n_rows; ++r)
      for (int c = 0; c < w.n_cols; ++c)
        ASSERT_EQ(part.at(r, c), all.at(w.row0 + r, w.col0 + c)) << r << ' ' << c;
  }
}

/// A dam over level ground as a scene has it.
struct Built {
  Scenario s;
  SceneInputs in;
};
Built built(double cell, const DamSpec& spec, const std::vector<Vec2>& corners) {
  Built b;
  b.s.terrain.dams = {spec};
  Raster<double> z = ground_of(static_cast<int>(300 / cell), cell, level);
  b.in.structures.dams = {line_of(corners, level)};
  b.in.structures.by_member = {false};
  b.in.structures.site = z;
  raise_dams(b.in.structures, b.s.terrain.dams, WhichDams::fixed, z);
  b.in.elevation = std::make_shared<const Raster<double>>(std::move(z));
  return b;
}

TEST(DamsUnderColumns, KeepTheirCrestOnRoundedGround) {
  // A wall of 6 m, thinner than a cell, aslant: rounding alone would take a quarter of it.
  for (const int factor : {1, 2, 3}) {
    const Built b = built(5, dam(6, 1, 0), {{90, 60}, {170, 240}});
    Raster<double> averaged = *b.in.elevation;
    if (factor > 1)
      averaged = Raster<double>(Grid{60 / factor, 60 / factor, 0, 300, 5.0 * factor, ""}, 100.0);
    stand_on_columns_ground(b.s, b.in, factor, *b.in.elevation, averaged);
    const Terrain terrain(std::make_shared<const Raster<double>>(averaged), NodataRule::outflow);
    double lowest = INFINITY, highest = -INFINITY;
    for (const Vec2& p : b.in.structures.dams[0].points) {
      const double z = terrain.curved(p.x(), p.y()).z;
      EXPECT_NEAR(z, rounded(averaged, p.x(), p.y()), 1e-9);
      lowest = std::min(lowest, z), highest = std::max(highest, z);
    }
    EXPECT_GT(lowest, 100 + 0.95 * 6) << factor;
    EXPECT_LT(highest, 100 + 1.25 * 6) << factor;
    EXPECT_LT(crest_lack(b.s, b.in, factor).share, 0.05) << factor;
  }
}

TEST(DamsUnderColumns, SayWhereTheGroundIsTooCoarse) {
  const Built fine = built(1, dam(6, 4, 1.5), {{90, 60}, {170, 240}});
  EXPECT_THAT(structure_warnings(fine.s, fine.in, 1, true), IsEmpty());
  const auto coarse = structure_warnings(fine.s, fine.in, 6, true);
  ASSERT_EQ(coarse.size(), 1U);
  EXPECT_EQ(coarse[0],
            "terrain.dams[0]: its crest is 4 m wide, the cells of the ground 6 m: so that nothing "
            "leaks through it stands 8.49 m wide there, and takes that much more room. Use a finer "
            "numerics.spacing_m and terrain");
}

/// Houses by cells of a raster of 24 x 24 cells of 2 m.
SceneInputs with_houses(const std::vector<std::array<int, 4>>& houses) {
  SceneInputs in;
  Raster<double> z = ground_of(24, 2, level);
  int number = 0;
  for (const auto& [row, col, rows, cols] : houses) {
    for (int r = row; r < row + rows; ++r)
      for (int c = col; c < col + cols; ++c)
        in.structures.buildings.push_back({z.grid.index(r, c), 9, number});
    ++number;
  }
  in.structures.n_buildings = number;
  for (const RaisedCell& cell : in.structures.buildings) z.values[cell.cell] += cell.by_m;
  in.elevation = std::make_shared<const Raster<double>>(std::move(z));
  return in;
}

TEST(BuildingsUnderColumns, StandUprightOnAveragedGround) {
  // Cells of 6 m are 3 x 3 of these. Three quarters of a block, a third of one, and a small house.
  const SceneInputs in = with_houses({{3, 3, 3, 4}, {12, 12, 1, 2}});
  Scenario s;
  Raster<double> averaged(Grid{8, 8, 0, 48, 6, ""});
  for (int r = 0; r < 8; ++r)
    for (int c = 0; c < 8; ++c) {
      double sum = 0;
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i) sum += in.elevation->at(3 * r + j, 3 * c + i);
      averaged.at(r, c) = sum / 9;
    }
  stand_on_columns_ground(s, in, 3, *in.elevation, averaged);
  EXPECT_DOUBLE_EQ(averaged.at(1, 1), 109) << "wholly covered";
  EXPECT_NEAR(averaged.at(1, 2), 100, 1e-9) << "a third of it";
  EXPECT_NEAR(averaged.at(4, 4), 100, 1e-9);
  EXPECT_EQ(lost_buildings(in, 3), 1);
  EXPECT_EQ(lost_buildings(in, 1), 0);
  EXPECT_THAT(
      structure_warnings(s, in, 6, true),
      Contains(StartsWith("terrain.buildings: 1 buildings cover no half of any cell of 6 m")));
}

/// A release of `n` x `n` cells whose north-western one has its corner at (x, y).
std::shared_ptr<const Raster<double>> release_at(double x, double y, double cell, int n) {
  return std::make_shared<const Raster<double>>(Grid{n, n, x, y, cell, ""}, 2.0);
}

TEST(Structures, OnTheReleaseAreSaid) {
  Built b = built(1, dam(6, 4, 1.5), {{90, 60}, {90, 240}});
  b.in.release = release_at(200, 150, 1, 20);
  EXPECT_THAT(structure_warnings(b.s, b.in, 1, true), IsEmpty());
  b.in.release = release_at(80, 150, 1, 20);  // 20 m of the line cross it
  const auto dam_words = structure_warnings(b.s, b.in, 1, false);
  ASSERT_EQ(dam_words.size(), 1U);
  EXPECT_THAT(dam_words[0], StartsWith("terrain.dams[0]: about 20"));
  EXPECT_THAT(dam_words[0], ::testing::HasSubstr("m of it stand on the release"));

  SceneInputs in = with_houses({{3, 3, 3, 4}, {12, 12, 2, 2}, {20, 2, 2, 2}});
  in.release = release_at(0, 48, 2, 4);  // its last cell is the first house's first
  EXPECT_THAT(structure_warnings({}, in, 2, true),
              Contains(StartsWith("terrain.buildings: 1 building stands on the release")));
  in.release = release_at(0, 48, 2, 14);
  EXPECT_THAT(structure_warnings({}, in, 2, true),
              Contains(StartsWith("terrain.buildings: 2 buildings stand on the release")));
  Raster<double> empty(Grid{14, 14, 0, 48, 2, ""}, 0.0);
  in.release = std::make_shared<const Raster<double>>(std::move(empty));
  EXPECT_THAT(structure_warnings({}, in, 2, true), IsEmpty());
}

}  // namespace
}  // namespace sturz
