// SPDX-License-Identifier: Apache-2.0
/// The ground that a mass covers: a mass that never moved covers what its release covered.
#include "engine/simulation/simulation.hpp"
#include "io/site/scene_inputs.hpp"
#include "scenarios/assembly/assemble.hpp"
#include "scenarios/catalogue.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace sturz {
namespace {

/// A box of 35 x 35 m, 3 m thick, that friction holds on a gentle slope.
Scenario held(double spacing_m, double cell_m) {
  Scenario s = block_on_plane(4);
  s.formulation = Formulation::depth_averaged;
  s.terrain.synthetic->cell_size_m = cell_m;
  s.terrain.synthetic->parameters["slope_deg"] = 15;
  s.terrain.synthetic->parameters["width_m"] = 120;
  s.release.box = ReleaseBox{{-20, 15}, {-17, 18}};
  s.release.thickness_m = Uncertain(3);
  s.numerics.spacing_m = spacing_m;
  s.numerics.end_time_s = 0.05;  // its upright sides sink in a second
  return s;
}

MemberResult run(const Scenario& s) { return assemble(s, load_scene_inputs(s), 0, 1).run(); }

/// A side is at most this much longer than it was: half a cell and a quarter of a spacing at each
/// end.
double longer(double spacing_m, double cell_m) { return cell_m + 0.5 * spacing_m; }

TEST(Footprint, OfColumnsThatNeverMovedIsThatOfTheirRelease) {
  for (const double spacing : {4.0, 2.0, 1.0})
    for (const double cell : {1.0, 2.5}) {
      const MemberResult r = run(held(spacing, cell));
      ASSERT_LT(r.scalars.front_travel_m, 0.1 * spacing);
      const double most = 35 + longer(spacing, cell);
      for (const double area : {r.scalars.deposit_area_m2, r.scalars.reached_area_m2}) {
        EXPECT_GE(area, 0.98 * 1225) << spacing << " " << cell;
        EXPECT_LE(area, most * most) << spacing << " " << cell;
      }
    }
}

TEST(Footprint, OfColumnsIsWithinATenthWhereTheyAreManyAndCellsSmall) {
  for (const double spacing : {2.0, 1.0})
    EXPECT_NEAR(run(held(spacing, 1)).scalars.deposit_area_m2, 1225, 0.1 * 1225) << spacing;
}

TEST(Footprint, OfARoundReleaseToo) {
  Scenario s = held(1.25, 2);
  s.release.box.reset();
  s.release.cylinder = ReleaseCylinder{{0, 0}, 25};
  // Cells that the outline cuts are filled over their whole area: a cell more.
  const double radius = 25 + 2 + 0.25 * 1.25, found = run(s).scalars.deposit_area_m2;
  EXPECT_GE(found, 0.98 * std::numbers::pi * 25 * 25);
  EXPECT_LE(found, std::numbers::pi * radius * radius);
}

TEST(Footprint, OfParticlesThatHardlyMovedToo) {
  Scenario s = held(0.75, 1);
  s.formulation = Formulation::full_stress;
  s.numerics.end_time_s = 1;
  const MemberResult r = run(s);
  EXPECT_NEAR(r.scalars.deposit_area_m2, 1225, 0.15 * 1225) << "its edge slumps by a little";
}

TEST(Footprint, KeepsItsVolumeInTheDepositLayer) {
  const MemberResult r = run(held(4, 2.5));
  double volume = 0;
  for (float h : r.layer(PeakLayer::deposit)) volume += h * 2.5 * 2.5;
  EXPECT_NEAR(volume, 3 * 1225, 1e-3 * volume);
}

TEST(Footprint, HasNoHolesInASheetThatSpreads) {
  // A disc that flows down an even slope and out: what it reaches is one piece without holes.
  Scenario s = block_on_plane(0.3);
  s.formulation = Formulation::depth_averaged;
  s.terrain.synthetic->parameters["width_m"] = 200;
  s.terrain.synthetic->parameters["length_m"] = 400;
  s.release.box.reset();
  s.release.cylinder = ReleaseCylinder{{-150, 0}, 20};
  s.numerics.spacing_m = 2;
  s.numerics.end_time_s = 8;
  const MemberResult r = run(s);
  const auto& arrival = r.layer(PeakLayer::arrival);
  std::size_t reached = 0, holes = 0;
  for (int row = 0; row < r.window.n_rows; ++row) {
    int first = -1, last = -1, n = 0;
    for (int col = 0; col < r.window.n_cols; ++col)
      if (!std::isnan(arrival[std::size_t(row) * r.window.n_cols + col])) {
        if (first < 0) first = col;
        last = col, ++n;
      }
    if (first < 0) continue;
    reached += n, holes += last - first + 1 - n;
  }
  ASSERT_GT(reached, 3000u);
  EXPECT_LT(static_cast<double>(holes), 0.01 * static_cast<double>(reached));
}

}  // namespace
}  // namespace sturz
