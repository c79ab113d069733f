// SPDX-License-Identifier: Apache-2.0
/// Rasters and grounds that are written as a formula of the map point.
#pragma once

#include "engine/terrain/terrain.hpp"

#include <functional>
#include <memory>
#include <utility>

namespace sturz::test {

using Height = std::function<double(double x, double y)>;

/// The formula at the cell centres of a grid.
inline Raster<double> raster_of(const Height& f, Grid g) {
  Raster<double> r(std::move(g));
  for (int i = 0; i < r.grid.n_rows; ++i)
    for (int j = 0; j < r.grid.n_cols; ++j) r.at(i, j) = f(r.grid.x_center(j), r.grid.y_center(i));
  return r;
}

inline Terrain ground_of(Raster<double> elevation, NodataRule rule = NodataRule::outflow) {
  return {std::make_shared<const Raster<double>>(std::move(elevation)), rule};
}

inline Terrain ground_of(const Height& f, Grid g, NodataRule rule = NodataRule::outflow) {
  return ground_of(raster_of(f, std::move(g)), rule);
}

}  // namespace sturz::test
