// SPDX-License-Identifier: Apache-2.0
/// A parabolic ridge, one periodic slice of it, and where its mass is.
#pragma once

#include "io/site/scene_inputs.hpp"
#include "scenarios/assembly/assemble.hpp"
#include "tests/physics/verification.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

namespace sturz::test {

/// Puts a ridge on the scene's ground, which falls along x, and assembles it.
/// \param width   across, periodic [m]
/// \param centre, half_length  in the map [m]
/// \param height  greatest vertical thickness [m]
inline Simulation parabolic_ridge(Scenario s, double width, double centre, double half_length,
                                  double height) {
  s.release.paraboloid.reset();
  s.release.cylinder.reset();
  s.release.box = ReleaseBox{{centre - half_length, centre + half_length}, {-width / 2, width / 2}};
  s.release.thickness_m = Uncertain(height);
  s.domain.periodic = {"y"};
  SceneInputs inputs = load_scene_inputs(s);
  auto thickness = std::make_shared<Raster<double>>(inputs.elevation->grid, 0.0);
  for (int r = 0; r < thickness->grid.n_rows; ++r)
    for (int c = 0; c < thickness->grid.n_cols; ++c) {
      const double u = (thickness->grid.x_center(c) - centre) / half_length;
      thickness->at(r, c) = std::max(0.0, height * (1 - u * u));
    }
  inputs.release = std::move(thickness);
  inputs.release_cover = nullptr;  // of the box that the parabola takes the place of
  inputs.pattern = ReleasePattern::thickness;
  s.release.box.reset();
  s.release.thickness_m.reset();
  return assemble(s, inputs, 0, 1);
}

/// Where 99 % of the mass lies behind. \param along  coordinate and mass of every part
inline double front_99(std::vector<std::pair<double, double>> along) {
  double mass = 0, behind = 0;
  for (const auto& [x, m] : along) mass += m;
  std::sort(along.begin(), along.end());
  for (const auto& [x, m] : along)
    if ((behind += m) >= 0.99 * mass) return x;
  return along.back().first;
}

}  // namespace sturz::test
