// SPDX-License-Identifier: Apache-2.0
// Paraboloid of revolution, lowest at the map's origin.
#include "scenarios/shapes/frame.hpp"
#include "scenarios/shapes/shape.hpp"

namespace sturz::shapes {
namespace {

SyntheticScene build(const Numbers& p, double cell_m) {
  const double size = p.at("size_m"), radius = p.at("curvature_radius_m");
  return {fill(grid_from_corner(-size / 2, -size / 2, size, size, cell_m),
               [&](double x, double y) { return (x * x + y * y) / (2 * radius); }),
          std::nullopt};
}

}  // namespace

Shape bowl() {
  return {"bowl",
          false,
          {{"curvature_radius_m", 100, 0.01, 1e6, "radius of curvature at the lowest point"},
           {"size_m", 200, 0.01, 1e5, "edge of the square map"}},
          build};
}

}  // namespace sturz::shapes
