// SPDX-License-Identifier: Apache-2.0
/// A slide on a laboratory's table reaches places as one on a mountain does.
#include "engine/simulation/simulation.hpp"
#include "scenarios/assembly/assemble.hpp"
#include "tests/support/formula_ground.hpp"

#include <gtest/gtest.h>

#include <memory>

namespace sturz {
namespace {

/// 10 x 10 of a slope of 45 degrees, 4 spacings thick, 100 x 50 cells; all lengths times `scale`.
MemberResult slide(double scale) {
  Scenario s;
  s.terrain.synthetic = SyntheticTerrain{"plane", scale, {}};
  s.release.box = ReleaseBox{{30 * scale, 40 * scale}, {30 * scale, 40 * scale}};
  s.release.thickness_m = Uncertain(8 * scale);
  s.grains.emplace();
  s.formulation = Formulation::full_stress;
  s.numerics.spacing_m = 2 * scale;
  s.numerics.end_time_s = 1;
  SceneInputs in;
  const Grid grid{100, 50, 0, 50 * scale, scale, ""};
  in.elevation = std::make_shared<const Raster<double>>(
      test::raster_of([scale](double x, double) { return 100 * scale - x; }, grid));
  Raster<double> pattern(grid, 0.0);
  for (int r = 10; r < 20; ++r)
    for (int c = 30; c < 40; ++c) pattern.at(r, c) = 1;
  in.release = std::make_shared<const Raster<double>>(pattern);
  in.hazard_grid = grid;
  return assemble(s, in, 0, 1).run();
}

TEST(SmallScene, ReachesAsLargeOnesDo) {
  EXPECT_GT(slide(1).scalars.reached_area_m2, 100);
  const MemberResult small = slide(0.003);  // 24 mm thick
  EXPECT_GT(small.scalars.reached_area_m2, 100 * 0.003 * 0.003) << "5 cm would say: nowhere";
  EXPECT_GT(small.scalars.runout_m, 0);
}

}  // namespace
}  // namespace sturz
