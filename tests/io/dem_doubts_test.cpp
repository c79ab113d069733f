// SPDX-License-Identifier: Apache-2.0
// Heights that no ground has are named by cell and size; ground that may be is left in peace.
#include "io/doubts/contour_spots.hpp"
#include "io/doubts/release_doubts.hpp"
#include "io/gdal/gdal_raster.hpp"
#include "tests/io/typed_raster.hpp"

#include <cmath>

namespace sturz::test {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class DemDoubts : public IoTest {
 protected:
  std::vector<std::string> doubts(const TypedRaster& r) const {
    write_typed(path("bed.tif"), r);
    RasterRequest request;
    request.path = "bed.tif";
    request.directory = folder().string();
    return read_elevation(request).warnings;
  }
};

TEST_F(DemDoubts, SmoothAndSteepGroundIsLeftInPeace) {
  EXPECT_THAT(doubts(slope(120)), IsEmpty());
  TypedRaster wall = slope(120);  // 80 degrees over 200 m, and a lake at its foot
  for (int row = 0; row < 120; ++row)
    for (int col = 0; col < 120; ++col) {
      double& z = wall.values[row * 120 + col];
      z += col > 60 ? 56.7 * std::min(col - 60, 20) : 0;
      if (col > 30 && col < 50 && row > 40 && row < 60) z = 700;
    }
  EXPECT_THAT(doubts(wall), IsEmpty());
  TypedRaster sea = slope(120);  // a coast with cliffs of 30 m
  for (double& z : sea.values) z = z < 700 ? 0 : z - 670;
  EXPECT_THAT(doubts(sea), IsEmpty());
  TypedRaster metres = slope(120, 30);  // whole metres on steep ground
  for (double& z : metres.values) z = std::round(z);
  EXPECT_THAT(doubts(metres), IsEmpty());
}

TEST_F(DemDoubts, ZerosInMountainsAreNamed) {
  TypedRaster r = slope(60);
  for (int row = 10; row < 14; ++row)
    for (int col = 20; col < 25; ++col) r.values[row * 60 + col] = 0;
  EXPECT_THAT(doubts(r), ElementsAre(AllOf(
                             HasSubstr("20 cells hold 0 m right beside high ground, in 1 block "),
                             HasSubstr("m at row 1"), HasSubstr("gdal_edit.py -a_nodata 0"))));
  r = slope(60);  // a collar
  for (int i = 0; i < 60; ++i)
    for (const int k : {i, 60 * i, 59 * 60 + i, 60 * i + 59}) r.values[k] = 0;
  EXPECT_THAT(doubts(r), ElementsAre(HasSubstr("236 cells hold 0 m right beside high ground")));
  r = slope(60);
  r.values[30 * 60 + 30] = 0;  // one hole
  EXPECT_THAT(doubts(r), Contains(AllOf(HasSubstr("1 cells hold 0 m"),
                                        HasSubstr("at row 30, column 30 (x 500305, y 4599695"))));
}

TEST_F(DemDoubts, JumpsBetweenTilesAreNamedWithTheirSize) {
  TypedRaster r = slope(60);
  for (int row = 0; row < 60; ++row)
    for (int col = 40; col < 60; ++col) r.values[row * 60 + col] += 328;  // feet beside metres
  EXPECT_THAT(doubts(r), ElementsAre(AllOf(HasSubstr("60 pairs of neighbouring cells"),
                                           HasSubstr("more than 200 m apart"),
                                           HasSubstr("column 39 (x 500395"))));
  TypedRaster coarse = slope(60, 90);  // 500 m from one cell of 90 m to the next can be ground
  for (int k = 30 * 60; k < 60 * 60; ++k) coarse.values[k] += 470;
  EXPECT_THAT(doubts(coarse), IsEmpty());
}

TEST_F(DemDoubts, SpikesAndPitsAreNamedButNoPeaks) {
  TypedRaster r = slope(60);
  r.values[20 * 60 + 33] += 45;
  r.values[40 * 60 + 12] -= 30;
  EXPECT_THAT(doubts(r),
              ElementsAre(AllOf(HasSubstr("2 single cells stand out of all eight"),
                                HasSubstr("at row 20, column 33 (x 500335, y 4599795"))));
  TypedRaster cone = slope(61);  // a peak of 45 degrees
  for (int row = 0; row < 61; ++row)
    for (int col = 0; col < 61; ++col)
      cone.values[row * 61 + col] = 1500 - 10 * std::hypot(row - 30, col - 30);
  EXPECT_THAT(doubts(cone), IsEmpty());
}

TEST_F(DemDoubts, TerracesOfWholeMetresOnGentleGround) {
  TypedRaster r = slope(100, 5);
  for (int row = 0; row < 100; ++row)
    for (int col = 0; col < 100; ++col)
      r.values[row * 100 + col] = std::round(100 + 0.4 * row + 0.3 * col);  // 5.7 degrees
  EXPECT_THAT(doubts(r), ElementsAre(AllOf(HasSubstr("whole multiples of 1 m"),
                                           HasSubstr("one step of 11.3 degrees apart"))));
  r.type = GDT_Int16;  // decimetres stored as whole numbers: no step to speak of
  for (double& z : r.values) z = std::round(z * 10);
  r.scale = 0.1;
  for (int row = 0; row < 100; ++row)
    for (int col = 0; col < 100; ++col)
      r.values[row * 100 + col] = std::round(1000 + 4 * row + 3 * col);
  EXPECT_THAT(doubts(r), IsEmpty());
}

TEST_F(DemDoubts, FlatSpotsAtContourLevels) {
  TypedRaster r = slope(200, 10);
  const auto ground = [](int row, int col) {
    return 400 + 1.7 * row + 0.9 * col + 20 * std::sin(0.05 * col) * std::cos(0.04 * row);
  };
  for (int row = 0; row < 200; ++row)
    for (int col = 0; col < 200; ++col) {
      // As a triangulation leaves it: near a line the ground is the line's level.
      const double z = ground(row, col), level = 20 * std::nearbyint(z / 20);
      r.values[row * 200 + col] = std::abs(z - level) < 3 ? level : z;
    }
  EXPECT_THAT(doubts(r), ElementsAre(AllOf(HasSubstr("flat at levels of contour lines every 20 m"),
                                           HasSubstr("at row "))));
  // Lakes are flat at levels of their own.
  for (int row = 0; row < 200; ++row)
    for (int col = 0; col < 200; ++col) {
      const int lake = row / 40;
      r.values[row * 200 + col] = row % 40 < 8 ? 407.3 + 71.7 * lake : ground(row, col);
    }
  EXPECT_FALSE(contour_spots(r.values, 200, 200).has_value());
}

TEST_F(DemDoubts, AReleaseNearTheEdgeIsTold) {
  const Grid g{100, 80, 500000, 4600000, 10, ""};
  Raster<double> pattern(g, 0.0);
  pattern.at(40, 50) = 1;
  EXPECT_EQ(edge_doubt(pattern, g, "release.box"), "");
  pattern.at(77, 50) = 1;
  EXPECT_THAT(edge_doubt(pattern, g, "release.box"),
              HasSubstr("release.box: lies 20 m (2 cells) from the southern edge of the terrain"));
  // The same on a part of the ground: the edge is that of the whole.
  const Grid part{20, 20, 500400, 4599700, 10, ""};
  Raster<double> inside(part, 0.0);
  inside.at(0, 10) = 1;
  EXPECT_EQ(edge_doubt(inside, g, "release.box"), "");
  const Grid rim{20, 20, 500800, 4599700, 10, ""};
  Raster<double> at_rim(rim, 0.0);
  at_rim.at(3, 19) = 1;
  EXPECT_THAT(edge_doubt(at_rim, g, "x"), HasSubstr("lies 0 m (0 cells) from the eastern edge"));
}

}  // namespace
}  // namespace sturz::test
