// SPDX-License-Identifier: Apache-2.0
// Ground like that of the Zhangjiawan (Pusa) rock avalanche of 28 August 2017: a cliff, an apron, a
// small hill across the path. Drawn from published heights, lengths and slopes, not surveyed.
// Beyond s = 1300 nothing is published: a valley floor and the foot of an opposite slope, so that
// mass of any friction above 0.14 comes to rest on known ground. s = map x - 500000 runs downhill
// from the crown, n = map y - 2900000 across.
#include "scenarios/shapes/profile.hpp"
#include "scenarios/shapes/shape.hpp"

#include <algorithm>
#include <cmath>

namespace sturz::shapes {
namespace {

const Profile& surface_before_failure() {
  static const Profile p = {{-400, 2040}, {-150, 2092}, {-40, 2115},  {0, 2120},    {30, 2113},
                            {60, 2085},   {100, 2010},  {160, 1950},  {215, 1918},  {280, 1896},
                            {340, 1880},  {400, 1868},  {840, 1815},  {1000, 1799}, {1300, 1772},
                            {1700, 1745}, {2000, 1733}, {2200, 1733}, {2400, 1745}, {3000, 1805}};
  return p;
}
const Profile& failure_surface() {
  static const Profile p = {{-400, 2040}, {-150, 2092}, {-40, 2115},  {0, 2120},    {25, 2060},
                            {60, 2026},   {115, 1983},  {160, 1950},  {215, 1918},  {280, 1896},
                            {340, 1880},  {400, 1868},  {840, 1815},  {1000, 1799}, {1300, 1772},
                            {1700, 1745}, {2000, 1733}, {2200, 1733}, {2400, 1745}, {3000, 1805}};
  return p;
}

double square(double v) { return v * v; }

/// Hollow below the cliff that opens into a fan; straight cliff above [m over the axis].
double cross_shape(double s, double n) {
  static const Profile curvature = {
      {150, 0}, {260, 1 / 1800.0}, {420, 1 / 1800.0}, {700, 1 / 4500.0}, {1300, 1 / 9000.0}};
  return 45 * (1 - std::exp(-at(curvature, s) * n * n / 45));
}

/// The hill whose crest lies at s = 485, and the hollow uphill of it.
double hill(double s, double n) {
  return 16 * std::exp(-square((s - 485) / 34) - square((n + 10) / 75)) -
         4 * std::exp(-square((s - 425) / 35) - square(n / 90));
}

SyntheticScene build(const Numbers& p, double cell_m) {
  const double half_width = p.at("source_width_m") / 2;
  const Grid grid = landslide_grid(-300, 2700, 400, cell_m);
  SyntheticScene scene{Raster<double>(grid), Raster<double>(grid)};
  auto& thickness = *scene.thickness;
  for (int row = 0; row < grid.n_rows; ++row)
    for (int col = 0; col < grid.n_cols; ++col) {
      const double s = grid.x_center(col) - origin_east_m, n = grid.y_center(row) - origin_north_m;
      const double over_axis = cross_shape(s, n) + hill(s, n);
      const double before = rounded(surface_before_failure(), s, 12) + over_axis;
      const double failure = rounded(failure_surface(), s, 6) + over_axis;
      scene.bed.at(row, col) = before;  // the source is dug out below
      const double h = std::max(before - failure, 0.0) * lateral_share(n, half_width);
      thickness.at(row, col) = s > 0 && s < 125 && h >= 0.2 ? h : 0;
    }
  scale_to_volume(thickness, p.at("volume_m3"), "zhangjiawan");
  for (std::size_t i = 0; i < thickness.values.size(); ++i)
    scene.bed.values[i] -= thickness.values[i];
  return scene;
}

}  // namespace

Shape zhangjiawan() {
  return {"zhangjiawan",
          true,
          {{"volume_m3", 491000, 1000, 1e7, "bulk volume of the source"},
           {"source_width_m", 145, 20, 600, "extent of the source across"}},
          build};
}

}  // namespace sturz::shapes
