// SPDX-License-Identifier: Apache-2.0
// Laboratory flume as a raster: an even floor that ends on a level plate at elevation 0. The floor
// starts at x = 0 behind a gate, with the hopper uphill of it. Side walls and gate are no terrain:
// they are domain.walls.
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
  return {fill(grid, [&](double x, double) { return std::max(0.0, (foot - x) * std::tan(slope)); }),
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
           {"plate_width_m", 2.4, 0.01, 1e4, "extent across"}},
          build};
}

}  // namespace sturz::shapes
