// SPDX-License-Identifier: Apache-2.0
// The debris-flow flume of the U.S. Geological Survey with its source behind the gate (George &
// Iverson 2014, part II). Lengths s run along the bed, from the gate: 31 degrees to s = 78 m, an
// arc of 10 m radius to 2.5 degrees, the pad. The channel is 2 m wide; its side walls (2.5 m beside
// the source, 1.6 m below it) stand to s = 82.5 m. Map: x along the flow from the gate, y across
// it.
#include "scenarios/shapes/frame.hpp"
#include "scenarios/shapes/profile.hpp"
#include "scenarios/shapes/shape.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sturz::shapes {
namespace {

constexpr double degree = std::numbers::pi / 180, chute = 31 * degree, pad = 2.5 * degree;
constexpr double straight_m = 78, arc_radius_m = 10, walls_end_m = 82.5, half_width_m = 1;
constexpr double behind_gate_m = 6;  ///< of bed, along it

/// Where the bed is over map position x.
struct BedPoint {
  double s, z;  ///< along the bed; elevation, 0 at the gate [m]
};

BedPoint bed_at(double x) {
  const double arc_x = straight_m * std::cos(chute), arc_z = -straight_m * std::sin(chute);
  if (x <= arc_x) return {x / std::cos(chute), -x * std::tan(chute)};
  const double centre_x = arc_x + arc_radius_m * std::sin(chute);
  const double centre_z = arc_z + arc_radius_m * std::cos(chute);
  const double pad_x = centre_x - arc_radius_m * std::sin(pad);
  if (x < pad_x) {
    const double angle = std::asin((centre_x - x) / arc_radius_m);
    return {straight_m + arc_radius_m * (chute - angle), centre_z - arc_radius_m * std::cos(angle)};
  }
  return {straight_m + arc_radius_m * (chute - pad) + (x - pad_x) / std::cos(pad),
          centre_z - arc_radius_m * std::cos(pad) - (x - pad_x) * std::tan(pad)};
}

/// Thickness along the bed's normal behind the gate: a top of 3.3 m at 17 degrees, a front of 1.9 m
/// that stands upright, a tail to 4.7 m.
const Profile& source() {
  static const double front_s = -1.9 * std::sin(chute), front_h = 1.9 * std::cos(chute);
  static const double tail_s = front_s - 3.3 * std::cos(14 * degree),
                      tail_h = front_h - 3.3 * std::sin(14 * degree);
  static const Profile p = {{-4.7, 0}, {tail_s, tail_h}, {front_s, front_h}, {0, 0}};
  return p;
}

double wall_at(double s, double y) {
  if (std::abs(y) <= half_width_m || s > walls_end_m) return 0;
  return s < 0 ? 2.5 : 1.6;
}

SyntheticScene build(const Numbers& p, double cell_m) {
  const double back = behind_gate_m * std::cos(chute), width = p.at("pad_width_m");
  const double foot = straight_m * std::cos(chute) + arc_radius_m * std::sin(chute);
  const Grid grid =
      grid_from_corner(-back, -width / 2, back + foot + p.at("pad_length_m"), width, cell_m);
  SyntheticScene scene{Raster<double>(grid), Raster<double>(grid)};
  for (int row = 0; row < grid.n_rows; ++row)
    for (int col = 0; col < grid.n_cols; ++col) {
      const double y = grid.y_center(row);
      const auto [s, z] = bed_at(grid.x_center(col));
      scene.bed.at(row, col) = z + wall_at(s, y);
      if (std::abs(y) <= half_width_m && s < 0)
        scene.thickness->at(row, col) = at(source(), s) / std::cos(chute);
    }
  scale_to_volume(*scene.thickness, p.at("volume_m3"), "debris_flume");
  return scene;
}

}  // namespace

Shape debris_flume() {
  return {"debris_flume",
          true,
          {{"volume_m3", 10, 0.1, 50, "bulk volume of the source"},
           {"pad_length_m", 90, 1, 1e3, "extent of the pad below the arc, on the map"},
           {"pad_width_m", 30, 0.2, 1e3, "extent across; 2 m and less is a slice of the channel"}},
          build};
}

}  // namespace sturz::shapes
