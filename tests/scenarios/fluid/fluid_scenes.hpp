// SPDX-License-Identifier: Apache-2.0
/// Small scenes with a liquid in three dimensions, without files.
#pragma once

#include "scenarios/scenario.hpp"
#include "scenarios/scene_inputs.hpp"
#include "tests/support/formula_ground.hpp"

#include <memory>

namespace sturz::test {

/// 40 m x 40 m x 10 m of mud on a slope, five layers.
inline Scenario mud() {
  Scenario s;
  s.terrain.synthetic = SyntheticTerrain{"plane", 2, {}};
  s.release.box = ReleaseBox{{30, 70}, {30, 70}};
  s.release.thickness_m = Uncertain(10);
  s.fluid.emplace();
  s.fluid->density_kg_m3 = Uncertain(1600);
  s.fluid->viscosity_pa_s = Uncertain(50);
  s.fluid->yield_stress_pa = Uncertain(500);
  s.numerics.spacing_m = 2;
  return s;
}

/// The same place full of grains in water.
inline Scenario wet_slide() {
  Scenario s = mud();
  s.fluid = FluidSpec{};
  s.fluid->viscosity_pa_s = Uncertain(0.01);
  s.grains.emplace();
  s.grains->density_kg_m3 = Uncertain(2500);
  s.grains->diameter_m = Uncertain(0.5);
  s.grains->solid_fraction = Uncertain(0.55);
  s.grains->friction_angle_deg = Uncertain(30);
  return s;
}

inline SceneInputs slope_inputs() {
  SceneInputs in;
  const Grid grid{100, 50, 0, 100, 2, ""};
  in.elevation = std::make_shared<const Raster<double>>(
      test::raster_of([](double x, double y) { return 300 - 0.6 * x + 0.1 * y; }, grid));
  Raster<double> pattern(grid, 0.0);
  for (int r = 0; r < grid.n_rows; ++r)
    for (int c = 0; c < grid.n_cols; ++c) {
      const double x = grid.x_center(c), y = grid.y_center(r);
      if (x > 30 && x < 70 && y > 30 && y < 70) pattern.at(r, c) = 1;
    }
  in.release = std::make_shared<const Raster<double>>(pattern);
  in.hazard_grid = grid;
  return in;
}

/// Bulk volume of either [m3].
inline constexpr double released_m3 = 40 * 40 * 10;

}  // namespace sturz::test
