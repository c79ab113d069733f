// SPDX-License-Identifier: Apache-2.0
/// Walls on the wrong side of a release, and releases that the spacing does not resolve.
#include "scenarios/assembly/start_checks.hpp"

#include "engine/core/error.hpp"
#include "scenarios/assembly/assemble.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace sturz {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::Not;

/// 4 columns at x = 2, 6, 10, 14 of 1 kg each.
Release row_of_columns() {
  Release r;
  for (const double x : {2.0, 6.0, 10.0, 14.0}) {
    r.x.push_back(x);
    r.y.push_back(0);
    r.z.push_back(5);
    r.mass.push_back(1);
  }
  return r;
}

Domain with_wall(const Vec3& point, const Vec3& normal) {
  Domain d;
  d.walls.push_back({point, normal.normalized()});
  return d;
}

std::string refusal(const Domain& domain) {
  try {
    require_before_walls(row_of_columns(), domain, true);
  } catch (const SetupError& e) {
    return e.what();
  }
  return "accepted";
}

TEST(ReleaseAtWalls, InFrontIsAccepted) {
  EXPECT_EQ(refusal(with_wall({16, 0, 0}, {-1, 0, 0})), "accepted");
  EXPECT_EQ(refusal(with_wall({2, 0, 0}, {1, 0, 0})), "accepted");  // at the wall itself
  EXPECT_EQ(refusal({}), "accepted");
}

TEST(ReleaseAtWalls, BehindIsRefusedWithTheTurnedNormal) {
  EXPECT_EQ(refusal(with_wall({16, 0, 0}, {1, 0, 0})),
            "domain.walls[0]: the release lies behind this wall, all 4 columns of it, up to 14 m "
            "(its normal [1, 0, 0] points away from them, and it would throw them to its front). "
            "Turn the normal: [-1, 0, 0].");
}

TEST(ReleaseAtWalls, AcrossIsRefusedWithCountsAndDistance) {
  EXPECT_THAT(refusal(with_wall({7, 0, 0}, {1, 0, 0})),
              AllOf(HasSubstr("lies across this wall: 2 of 4 columns (50 % of the mass) start "
                              "behind it, up to 5 m, the others up to 7 m in front"),
                    HasSubstr("move point_m by 5 m against the normal [1, 0, 0]")));
}

TEST(ReleaseAtWalls, ALidUnderTheMassAndASlantingWallAreWallsToo) {
  EXPECT_THAT(refusal(with_wall({0, 0, 4}, {0, 0, -1})), HasSubstr("Turn the normal: [0, 0, 1]"));
  EXPECT_THAT(refusal(with_wall({0, 0, 0}, {-3, 0, 4})), HasSubstr("2 of 4 columns"));
}

TEST(ReleaseAtWalls, EachWallIsNamed) {
  Domain d = with_wall({16, 0, 0}, {1, 0, 0});
  d.walls.push_back({{0, 0, 0}, {1, 0, 0}});
  d.walls.push_back({{7, 0, 0}, {1, 0, 0}});
  EXPECT_THAT(refusal(d), AllOf(HasSubstr("domain.walls[0]"), Not(HasSubstr("domain.walls[1]")),
                                HasSubstr("\ndomain.walls[2]")));
}

Raster<double> rectangle(int n_cols, int n_rows, double cell = 2) {
  Raster<double> h(Grid{100, 100, 0, 100 * cell, cell, ""}, 0.0);
  for (int r = 10; r < 10 + n_rows; ++r)
    for (int c = 10; c < 10 + n_cols; ++c) h.at(r, c) = 3;
  return h;
}

TEST(NarrowSide, IsThatOfARectangle) {
  EXPECT_NEAR(narrow_side(rectangle(20, 20), 0), 40, 1e-9);
  EXPECT_NEAR(narrow_side(rectangle(60, 10), 0), 20, 1e-9);
  EXPECT_NEAR(narrow_side(rectangle(5, 80), 0), 10, 1e-9);
}

TEST(NarrowSide, OfTwoPartsIsNotTheirDistance) {
  Raster<double> two = rectangle(5, 5);
  for (int r = 70; r < 75; ++r)
    for (int c = 30; c < 35; ++c) two.at(r, c) = 1;
  EXPECT_LT(narrow_side(two, 0), 14);
  EXPECT_GE(narrow_side(two, 0), 10);
}

TEST(NarrowSide, OfLessThanACellIsThatOfItsOutline) {
  EXPECT_NEAR(narrow_side(rectangle(1, 1, 5), 0.125), std::sqrt(0.125), 1e-12);
}

/// A box of w x b metres, 3 m thick, on a plane of 20 degrees.
SceneDescription described(double width, double breadth, double spacing,
                           Formulation formulation = Formulation::depth_averaged) {
  Scenario s;
  s.grains.emplace();
  s.grains->friction.emplace();
  s.formulation = formulation;
  s.release.box = ReleaseBox{{100, 100 + width}, {100, 100 + breadth}};
  s.release.thickness_m = Uncertain(3);
  s.numerics.spacing_m = spacing;
  s.numerics.accept_unresolved = true;
  const Grid grid{150, 150, 0, 300, 2, ""};
  Raster<double> z(grid), h(grid, 0.0);
  for (int r = 0; r < 150; ++r)
    for (int c = 0; c < 150; ++c) {
      const double x = grid.x_center(c), y = grid.y_center(r);
      z.at(r, c) = -0.364 * x;
      if (x > 100 && x < 100 + width && y > 100 && y < 100 + breadth) h.at(r, c) = 1;
    }
  SceneInputs in;
  in.elevation = std::make_shared<const Raster<double>>(std::move(z));
  in.release = std::make_shared<const Raster<double>>(std::move(h));
  in.source_area_m2 = width * breadth;
  in.hazard_grid = grid;
  return describe(s, in);
}

TEST(UnresolvedRelease, IsToldWithColumnsLayersAndWhatWouldBeRight) {
  EXPECT_THAT(described(40, 30, 50).warnings,
              Contains(AllOf(HasSubstr("unresolved release: "),
                             HasSubstr(" columns, 0.6 spacings "
                                       "of 50 m"),
                             HasSubstr("narrow side of 30 m (it is narrower than one)"),
                             HasSubstr("numerics.spacing_m of 3 m or less"))));
  EXPECT_THAT(described(60, 60, 10).warnings,
              Contains(AllOf(HasSubstr("36 columns"), HasSubstr("0.3 spacings thick"),
                             HasSubstr("numerics.spacing_m of 6 m or less"))));
}

TEST(UnresolvedRelease, IsNoneFromTenAcrossOn) {
  EXPECT_THAT(described(100, 60, 6).warnings, Each(Not(HasSubstr("unresolved"))));
  EXPECT_THAT(described(100, 60, 6.2).warnings, Contains(HasSubstr("unresolved")));
}

TEST(UnresolvedRelease, HoldsForParticlesToo) {
  EXPECT_THAT(described(8, 8, 1.5, Formulation::full_stress).warnings,
              Contains(AllOf(HasSubstr("unresolved release"), HasSubstr(" particles, "))));
}

TEST(Description, GivesTheAreaOfTheOutlineAndTheBulkDensity) {
  const SceneDescription d = described(41, 31, 2);
  EXPECT_EQ(d.release_area_m2, 41 * 31);
  EXPECT_NEAR(d.bulk_density_kg_m3, 2600 * 0.6, 1e-9);
}

}  // namespace
}  // namespace sturz
