// SPDX-License-Identifier: Apache-2.0
/// Thickness normal to the slope, and floors that come out.
#include "scenarios/assembly/release_pattern.hpp"

#include "engine/core/error.hpp"
#include "scenarios/assembly/release_lip.hpp"
#include "scenarios/assembly/slope.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

namespace sturz {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double degree = std::numbers::pi / 180;

/// A plane of 60 x 60 cells of 5 m that falls by `slope_deg` towards the azimuth (from north).
Raster<double> plane(double slope_deg, double azimuth_deg = 90) {
  Raster<double> z(Grid{60, 60, 0, 300, 5, ""});
  const double fall = std::tan(slope_deg * degree);
  for (int r = 0; r < 60; ++r)
    for (int c = 0; c < 60; ++c)
      z.at(r, c) = 1000 - fall * (z.grid.x_center(c) * std::sin(azimuth_deg * degree) +
                                  z.grid.y_center(r) * std::cos(azimuth_deg * degree));
  return z;
}

/// 100 m x 100 m in the middle.
Raster<double> square(double value = 1) {
  Raster<double> pattern(Grid{60, 60, 0, 300, 5, ""}, 0.0);
  for (int r = 20; r < 40; ++r)
    for (int c = 20; c < 40; ++c) pattern.at(r, c) = value;
  return pattern;
}

double volume(const Raster<double>& h) {
  return std::accumulate(h.values.begin(), h.values.end(), 0.0) * h.grid.cell_m * h.grid.cell_m;
}

SceneInputs inputs(Raster<double> ground, Raster<double> pattern, ReleasePattern kind) {
  SceneInputs in;
  in.elevation = std::make_shared<const Raster<double>>(std::move(ground));
  in.release = std::make_shared<const Raster<double>>(std::move(pattern));
  in.pattern = kind;
  return in;
}

Scenario outlined(ThicknessDirection direction, double thickness_m) {
  Scenario s;
  s.release.box = ReleaseBox{{100, 200}, {100, 200}};
  s.release.thickness = direction;
  s.release.thickness_m = Uncertain(thickness_m);
  return s;
}

TEST(Gradient, IsThatOfThePlaneWhateverCellsAreKnown) {
  Raster<double> z = plane(30, 120);
  const Vec2 expected =
      -std::tan(30 * degree) * Vec2(std::sin(120 * degree), std::cos(120 * degree));
  EXPECT_LT((gradient_at(z, 30, 30) - expected).norm(), 1e-12);
  EXPECT_LT((gradient_at(z, 0, 59) - expected).norm(), 1e-12);  // a corner
  z.at(29, 30) = z.at(31, 31) = z.at(30, 29) = nan_d;
  EXPECT_LT((gradient_at(z, 30, 30) - expected).norm(), 1e-12);
}

TEST(NormalThickness, TenThousandSquareMetresOf45DegreesHoldTheRootOfTwoAsMuch) {
  const Scenario s = outlined(ThicknessDirection::normal, 1);
  SceneInputs in = inputs(plane(45), square(), ReleasePattern::cover);
  shape_release(s, in);
  EXPECT_NEAR(volume(release_thickness(s.release, in)), 14142.1356, 1e-3);
  EXPECT_NEAR(in.normal_over_vertical, std::numbers::sqrt2, 1e-12);
  EXPECT_THAT(in.notes,
              ElementsAre("release.thickness: normal; 10000 m3 with vertical thicknesses, "
                          "14142 m3 with thicknesses normal to the slope"));
}

TEST(NormalThickness, VerticalThicknessStaysAndTellsTheOtherVolume) {
  const Scenario s = outlined(ThicknessDirection::vertical, 2.5);
  SceneInputs in = inputs(plane(30, 200), square(), ReleasePattern::cover);
  shape_release(s, in);
  EXPECT_NEAR(volume(release_thickness(s.release, in)), 25000, 1e-6);
  EXPECT_THAT(
      in.notes,
      ElementsAre("release.thickness: vertical; 25000 m3 with vertical thicknesses, 28868 m3 "
                  "with thicknesses normal to the slope"));
}

TEST(NormalThickness, LevelGroundMakesNoDifferenceAndNoWords) {
  const Scenario s = outlined(ThicknessDirection::vertical, 2);
  SceneInputs in = inputs(plane(0), square(), ReleasePattern::cover);
  shape_release(s, in);
  EXPECT_EQ(in.normal_over_vertical, 1);
  EXPECT_THAT(in.notes, IsEmpty());
}

TEST(NormalThickness, OfARasterStretchesEachCellByItsOwnSlope) {
  // The western half of the ground is level, the eastern half falls by 60 degrees.
  Raster<double> ground(Grid{60, 60, 0, 300, 5, ""});
  for (int r = 0; r < 60; ++r)
    for (int c = 0; c < 60; ++c)
      ground.at(r, c) = c < 30 ? 0 : -(c - 29.5) * 5 * std::tan(60 * degree);
  Scenario s;
  s.release.thickness_raster = "h.tif";
  s.release.thickness = ThicknessDirection::normal;
  SceneInputs in = inputs(ground, square(3), ReleasePattern::thickness);
  in.source_volume_m3 = 30000;
  shape_release(s, in);
  const Raster<double> h = release_thickness(s.release, in);
  EXPECT_NEAR(h.at(25, 22), 3, 1e-12);
  EXPECT_NEAR(h.at(25, 36), 6, 1e-9);
  EXPECT_NEAR(in.source_volume_m3, volume(h), 1e-6);
}

/// The part of a raster from row and column 10 to 50.
Raster<double> cut_out(const Raster<double>& all) {
  Raster<double> part(
      Grid{40, 40, all.grid.x_center(10) - 2.5, all.grid.y_center(10) + 2.5, 5, ""});
  for (int r = 0; r < 40; ++r)
    for (int c = 0; c < 40; ++c) part.at(r, c) = all.at(r + 10, c + 10);
  return part;
}

TEST(NormalThickness, APatternOnAPartOfTheGroundIsTheSame) {
  Raster<double> ground = plane(35, 70);
  for (int r = 0; r < 60; ++r)
    for (int c = 0; c < 60; ++c) ground.at(r, c) += 3 * std::sin(0.3 * r + 0.11 * c * c);
  Scenario s = outlined(ThicknessDirection::normal, 2);
  s.release.floor = ReleaseFloor::tapered;
  SceneInputs all = inputs(ground, square(), ReleasePattern::cover);
  SceneInputs part = inputs(ground, cut_out(square()), ReleasePattern::cover);
  shape_release(s, all);
  shape_release(s, part);
  EXPECT_EQ(cut_out(*all.release).values, part.release->values);
  EXPECT_EQ(all.notes, part.notes);
  EXPECT_EQ(release_lip(ground, *all.release, true, 0.2).share_of_drive,
            release_lip(ground, *part.release, true, 0.2).share_of_drive);
}

TEST(NormalThickness, AGivenVolumeIsExact) {
  Scenario s = outlined(ThicknessDirection::normal, 1);
  s.release.thickness_m.reset();
  s.release.volume_m3 = Uncertain(12345);
  SceneInputs in = inputs(plane(45, 33), square(), ReleasePattern::cover);
  shape_release(s, in);
  EXPECT_NEAR(volume(release_thickness(s.release, in)), 12345, 1e-6);
  EXPECT_THAT(in.notes, ElementsAre(HasSubstr("release.volume_m3 sets the volume")));
}

TEST(NormalThickness, SaysWhereTheSlopeIsTooSteepForIt) {
  const Scenario s = outlined(ThicknessDirection::normal, 1);
  SceneInputs in = inputs(plane(70), square(), ReleasePattern::cover);
  shape_release(s, in);
  EXPECT_THAT(in.notes, ElementsAre(HasSubstr("100 % of it lies on cells steeper than 60 degrees "
                                              "(up to 70)")));
}

TEST(TaperedFloor, KeepsTheVolumeAndComesOutAtTheLowerEdge) {
  const Raster<double> ground = plane(27), box = square(10);
  const Raster<double> floor = tapered(box, ground);
  EXPECT_NEAR(volume(floor), volume(box), 1e-6);
  // Nothing at the toe and the flanks, most at the head, which is free.
  EXPECT_LT(floor.at(30, 39), 2);
  EXPECT_LT(floor.at(20, 30), 3.5);
  EXPECT_GT(floor.at(30, 20), 12);
  EXPECT_EQ(floor.at(30, 41), 0);
  EXPECT_GT(release_lip(ground, box, true, 0.3).share_of_drive, 0.1);
  EXPECT_LT(release_lip(ground, floor, true, 0.3).share_of_drive, 0.005);
}

TEST(TaperedFloor, IsTheParabolaOfConstantCurvatureOnAStrip) {
  // A strip across the whole ground that falls east: no flux at the head, nothing at the toe,
  // h = 1.5 mean (1 - (s/L)^2) with s from the head. The flanks are the ground's own edge.
  Raster<double> strip(Grid{60, 60, 0, 300, 5, ""}, 0.0);
  for (int r = 0; r < 60; ++r)
    for (int c = 20; c < 40; ++c) strip.at(r, c) = 4;
  const Raster<double> floor = tapered(strip, plane(30));
  const double middle = floor.at(30, 20);
  for (int c = 20; c < 40; ++c) {
    const double s = (c - 19.5) / 20;
    EXPECT_NEAR(floor.at(30, c) / middle, 1 - s * s, 0.03) << c;
  }
  EXPECT_NEAR(volume(floor), volume(strip), 1e-6);
}

TEST(TaperedFloor, KeepsTheVolumeOfEachPart) {
  Raster<double> two(Grid{60, 60, 0, 300, 5, ""}, 0.0);
  for (int r = 5; r < 15; ++r)
    for (int c = 5; c < 15; ++c) two.at(r, c) = 2, two.at(r + 30, c + 30) = 7;
  const Raster<double> floor = tapered(two, plane(35, 45));
  double first = 0, second = 0;
  for (int r = 0; r < 60; ++r)
    for (int c = 0; c < 60; ++c) (r < 30 ? first : second) += floor.at(r, c);
  EXPECT_NEAR(first, 200, 1e-9);
  EXPECT_NEAR(second, 700, 1e-9);
}

TEST(TaperedFloor, IsToldWithItsVolume) {
  Scenario s = outlined(ThicknessDirection::normal, 5);
  s.release.surface = ReleaseSurface::pre_failure;
  s.release.floor = ReleaseFloor::tapered;
  SceneInputs in = inputs(plane(45), square(), ReleasePattern::cover);
  shape_release(s, in);
  EXPECT_NEAR(volume(release_thickness(s.release, in)), 5 * 14142.1356, 1e-2);
  ASSERT_EQ(in.notes.size(), 2u);
  EXPECT_THAT(in.notes[1], HasSubstr("release.floor: tapered; greatest thickness "));
  EXPECT_THAT(in.notes[1], HasSubstr("volume 100 % of it"));
}

TEST(ReleaseLip, IsTheDepthOfTheBoxLessTheFallToItsNeighbour) {
  const ReleaseLip lip = release_lip(plane(27), square(18.5), true, 0.3);
  const double fall = std::tan(27 * degree);
  EXPECT_NEAR(lip.slope, fall, 1e-9);
  EXPECT_NEAR(lip.length_m, 100, 1e-9);
  EXPECT_NEAR(lip.height_m, 18.5 - 5 * fall, 1e-9);
  EXPECT_NEAR(lip.share_of_drive, 0.5 * 100 * lip.height_m * lip.height_m / (185000 * (fall - 0.3)),
              1e-9);
}

TEST(ReleaseLip, HasTheLengthOfTheRimOnASlopeThatFallsAslant) {
  // A square seen along its diagonal shows both lower edges: 100 m sqrt 2 across the fall line.
  const ReleaseLip lip = release_lip(plane(30, 45), square(10), true, 0);
  EXPECT_NEAR(lip.length_m, 100 * std::numbers::sqrt2, 8);
  EXPECT_NEAR(lip.height_m, 10 - 5 * std::numbers::sqrt2 * std::tan(30 * degree), 1e-9);
}

TEST(ReleaseLip, IsNoneWhereTheMassLiesOnTheGround) {
  EXPECT_EQ(release_lip(plane(27), square(18.5), false, 0.3).share_of_drive, 0);
  EXPECT_EQ(release_lip(plane(0), square(18.5), true, 0.3).share_of_drive, 0);
}

}  // namespace
}  // namespace sturz
