// SPDX-License-Identifier: Apache-2.0
/// One shape of synthetic ground: its parameters and the function that builds it.
#pragma once

#include "scenarios/shapes/synthetic_terrain.hpp"

#include <map>
#include <string>
#include <vector>

namespace sturz::shapes {

/// Values of all parameters of a shape, defaults filled in.
using Numbers = std::map<std::string, double>;

struct Shape {
  const char* name;
  bool brings_source;
  std::vector<ShapeParameter> parameters;
  SyntheticScene (*build)(const Numbers&, double cell_m);
};

Shape plane();         ///< even slope
Shape bowl();          ///< paraboloid
Shape step();          ///< two levels and the face between them
Shape flume();         ///< inclined floor, then a level plate
Shape debris_flume();  ///< large chute, arc and pad, with its source behind a gate
Shape ramp();          ///< even slope, smooth transition, level ground
Shape zhangjiawan();   ///< rock avalanche over a small hill, with its source
Shape shuicheng();     ///< slide that splits into two gullies, with its source

/// Builds a raster from z(x, y) at the cell centres.
template <class Height>
Raster<double> fill(const Grid& grid, const Height& height) {
  Raster<double> raster(grid);
  for (int row = 0; row < grid.n_rows; ++row)
    for (int col = 0; col < grid.n_cols; ++col)
      raster.at(row, col) = height(grid.x_center(col), grid.y_center(row));
  return raster;
}

}  // namespace sturz::shapes
