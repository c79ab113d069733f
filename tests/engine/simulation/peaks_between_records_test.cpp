// SPDX-License-Identifier: Apache-2.0
/// What a peak loses where it passes between two records.
#include "engine/simulation/peak_maps.hpp"
#include "tests/support/peak_map_reading.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace sturz {
namespace {

using test::at;

constexpr double density = 1500, width = 20;
const Grid grid{200, 40, 0, 200, 5, ""};

/// A lone particle that crosses the map, looked at whenever it moved by `share` of its width.
MemberResult crossing(double share, double first) {
  ParticleSet p;
  p.grow(1);
  p.y[0] = 102.5, p.mass[0] = density * 400, p.vx[0] = 10;
  test::OneSetMaps maps({grid, width, density, 1e-4});
  for (p.x[0] = 100 + first; p.x[0] < 900; p.x[0] += share * width)
    maps.record(p, 0.1 * (p.x[0] - 100));
  MemberResult r;
  maps.finish(p, r);
  return r;
}

TEST(PeaksBetweenRecords, OfALoneParticleAreWithinOneInAHundred) {
  const MemberResult exact = crossing(0.01, 0);
  for (const double first : {0.0, 0.9, 2.3, 4.1, 6.6}) {
    const MemberResult r = crossing(PeakMaps::record_share, first);
    const int row = grid.row_of(102.5);
    for (int col = grid.col_of(200); col < grid.col_of(800); ++col) {
      const double h = at(exact, PeakLayer::thickness, row, col);
      const double e = at(exact, PeakLayer::energy, row, col);
      EXPECT_NEAR(at(r, PeakLayer::thickness, row, col), h, 0.01 * h) << col << " " << first;
      EXPECT_NEAR(at(r, PeakLayer::energy, row, col), e, 0.01 * e) << col << " " << first;
      EXPECT_NEAR(at(r, PeakLayer::speed, row, col), 10, 1e-4);
    }
  }
}

TEST(PeaksBetweenRecords, MissNoCellThatThePathCrosses) {
  for (const double first : {0.0, 1.7, 5.2}) {
    const MemberResult r = crossing(PeakMaps::record_share, first);
    for (int col = grid.col_of(200); col < grid.col_of(800); ++col)
      EXPECT_FALSE(std::isnan(at(r, PeakLayer::arrival, grid.row_of(102.5), col))) << col;
  }
}

TEST(PeaksBetweenRecords, AReleaseIsNoTopOfAParabola) {
  // Before the first look there was nothing: that is not a value to draw a parabola through.
  ParticleSet p;
  p.grow(1);
  p.x[0] = 500, p.y[0] = 102.5, p.mass[0] = density * 400;
  const MemberResult still = test::maps_of({grid, width, density, 1e-4}, p);
  test::OneSetMaps maps({grid, width, density, 1e-4});
  maps.record(p, 0);
  p.x[0] = 505;
  maps.record(p, 0.5);
  MemberResult r;
  maps.finish(p, r);
  EXPECT_FLOAT_EQ(static_cast<float>(r.scalars.max_thickness_m),
                  static_cast<float>(still.scalars.max_thickness_m));
}

}  // namespace
}  // namespace sturz
