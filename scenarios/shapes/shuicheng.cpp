// SPDX-License-Identifier: Apache-2.0
// Ground like that of the Shuicheng (Jichang) landslide of 23 July 2019: one trunk, split by a
// convex block into two gullies. Drawn from published heights, lengths and angles, not surveyed.
// t = map x - 500000 runs down the trunk from the crown, n = map y - 2900000 across, + to the left.
#include "scenarios/shapes/profile.hpp"
#include "scenarios/shapes/shape.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sturz::shapes {
namespace {

constexpr double split_at_m = 480;  ///< where the gullies part
constexpr double half_angle = 14.5 * std::numbers::pi / 180;

/// Elevation of the floor over the path distance p from the crown.
const Profile& floor_profile() {
  static const Profile p = {{-300, 1790}, {-120, 1752}, {-30, 1717},  {0, 1700},    {60, 1655},
                            {230, 1553},  {330, 1500},  {400, 1470},  {480, 1447},  {600, 1397},
                            {750, 1348},  {900, 1309},  {1050, 1279}, {1200, 1256}, {1340, 1240},
                            {1450, 1228}, {1700, 1205}};
  return p;
}
const Profile& floor_half_width() {
  static const Profile p = {{-300, 120}, {0, 95},    {230, 85}, {400, 75},
                            {520, 34},   {1340, 30}, {1700, 40}};
  return p;
}
const Profile& floor_radius() {
  static const Profile p = {{-300, 900}, {0, 600}, {230, 500}, {480, 300}, {700, 140}, {1700, 120}};
  return p;
}

double square(double v) { return v * v; }

/// Surface of the valley that follows trunk and one gully: side +1 left, -1 right.
double valley(double t, double n, int side) {
  const double beyond = std::max(t - split_at_m, 0.0);
  const double p = std::min(t, split_at_m) + beyond / std::cos(half_angle);
  const double off_axis = std::abs(n - side * beyond * std::tan(half_angle)) *
                          (t > split_at_m ? std::cos(half_angle) : 1);
  const double half_width = at(floor_half_width(), p);
  const double up_side = std::max(off_axis - half_width, 0.0);
  const double dip = square(std::min(off_axis, half_width)) / (4 * at(floor_radius(), p));
  const double sides = std::tan(24 * std::numbers::pi / 180) * 110 * (1 - std::exp(-up_side / 110));
  return rounded(floor_profile(), p, 18) + dip + sides;
}

/// The convex block at the head of the ridge between the gullies.
double nose(double t, double n) { return 14 * std::exp(-square((t - 575) / 55) - square(n / 32)); }

/// Thickness along the trunk, 0..1: smooth at the crown and at the toe.
double longitudinal_share(double t, double length) {
  if (t <= 0 || t >= length) return 0;
  const double f = t / length;
  const double share = std::clamp(std::min(f / 0.25, (1 - f) / 0.30), 0.0, 1.0);
  return share * share * (3 - 2 * share);
}

SyntheticScene build(const Numbers& p, double cell_m) {
  const double length = p.at("source_length_m"), half_width = p.at("source_width_m") / 2;
  const double volume = p.at("volume_m3");
  const Grid grid = landslide_grid(-250, 1650, 600, cell_m);
  SyntheticScene scene{Raster<double>(grid), Raster<double>(grid)};
  auto& thickness = *scene.thickness;
  for (int row = 0; row < grid.n_rows; ++row)
    for (int col = 0; col < grid.n_cols; ++col) {
      const double t = grid.x_center(col) - origin_east_m, n = grid.y_center(row) - origin_north_m;
      scene.bed.at(row, col) = smooth_min(valley(t, n, +1), valley(t, n, -1), 14) + nose(t, n);
      thickness.at(row, col) = longitudinal_share(t, length) * lateral_share(n, half_width);
    }
  scale_to_volume(thickness, volume, "shuicheng");
  for (double& h : thickness.values)
    if (h < 0.05) h = 0;
  scale_to_volume(thickness, volume, "shuicheng");
  return scene;
}

}  // namespace

Shape shuicheng() {
  return {"shuicheng",
          true,
          {{"volume_m3", 700000, 1000, 1e7, "bulk volume of the source"},
           {"source_width_m", 170, 20, 600, "extent of the source across"},
           {"source_length_m", 230, 20, 480, "extent of the source along the trunk"}},
          build};
}

}  // namespace sturz::shapes
