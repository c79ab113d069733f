// SPDX-License-Identifier: Apache-2.0
// Laboratory flume as a raster: an even floor that ends on a level plate at elevation 0. The floor
// starts at x = 0 behind a gate, with the hopper uphill of it. The gate is no terrain but one of
// domain.walls; side walls that end with the floor are, as steep as one cell.
#include "scenarios/shapes/frame.hpp"
#include "scenarios/shapes/shape.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sturz::shapes {
namespace {

SyntheticScene build(const Numbers& p, double cell_m) {
  const double slope = p.at("slope_deg") * std::numbers::pi / 180;
  const double foot = p.at("floor_length_m") * std::cos(slope);
  const double back = p.at("hopper_length_m") * std::cos(slope);
  const double width = p.at("plate_width_m");
  const Grid grid =
      grid_from_corner(-back, -width / 2, back + foot + p.at("plate_length_m"), width, cell_m);
  const double inside = p.at("channel_width_m") / 2 * (1 + 1e-9), wall = p.at("wall_height_m");
  return {fill(grid,
               [&](double x, double y) {
                 const double floor = std::max(0.0, (foot - x) * std::tan(slope));
                 return inside > 0 && x < foot && std::abs(y) > inside ? floor + wall : floor;
               }),
          std::nullopt};
}

}  // namespace

Shape flume() {
  return {"flume",
          false,
          {{"slope_deg", 20, 0, 60, "inclination of the floor"},
           {"floor_length_m", 3, 0.01, 1e4, "floor below the gate, along the slope"},
           {"hopper_length_m", 0.5, 0.01, 1e3, "floor above the gate, along the slope"},
           {"plate_length_m", 4.8, 0.01, 1e4, "level plate, along the flow"},
           {"plate_width_m", 2.4, 0.01, 1e4, "extent across"},
           {"channel_width_m", 0, 0, 1e4, "between side walls along the floor; 0: there are none"},
           {"wall_height_m", 0.5, 0, 1e3, "of the side walls above the floor"}},
          build};
}

}  // namespace sturz::shapes
