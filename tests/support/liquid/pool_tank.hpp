// SPDX-License-Identifier: Apache-2.0
/// Grains on the floor of a tank of standing water, and the ground under it.
#pragma once

#include "scenarios/scenario.hpp"
#include "scenarios/scene_inputs.hpp"
#include "tests/support/formula_ground.hpp"

#include <functional>
#include <memory>
#include <optional>

namespace sturz::test {

inline constexpr double deep = 1.0;  // of the water in the tank [m]

/// 2 m x 0.4 m of water between walls at x = 0 and 2, periodic in y; on its floor 0.6 m of grains
/// that are 0.5 m high. All edges lie on the lattice of 0.1 m.
inline Scenario tank(double grains_high = 0.5) {
  Scenario s;
  s.terrain.synthetic = SyntheticTerrain{"plane", 0.1, {}};
  s.release.box = ReleaseBox{{0.7, 1.3}, {-0.2, 0.2}};
  s.release.thickness_m = Uncertain(grains_high);
  GrainsSpec& g = s.grains.emplace();
  g.density_kg_m3 = Uncertain(2500);
  g.diameter_m = Uncertain(0.002);
  g.solid_fraction = Uncertain(0.6);
  g.friction_angle_deg = Uncertain(30);
  FluidSpec& f = s.fluid.emplace();
  f.viscosity_pa_s = Uncertain(0.01);
  f.pool.emplace().surface_m = Uncertain(deep);
  s.formulation = Formulation::full_stress;
  s.domain.periodic = {"y"};
  s.domain.walls = {WallSpec{{0, 0, 0}, {1, 0, 0}, 0, std::nullopt},
                    WallSpec{{2, 0, 0}, {-1, 0, 0}, 0, std::nullopt}};
  s.numerics.spacing_m = 0.1;
  s.numerics.jitter = 0;
  s.numerics.end_time_s = 10;
  return s;
}

inline SceneInputs inputs_of(const Scenario& s,
                             const std::function<double(double, double)>& ground) {
  SceneInputs in;
  const Grid grid{32, 4, -0.6, 0.2, 0.1, ""};
  in.elevation = std::make_shared<const Raster<double>>(raster_of(ground, grid));
  Raster<double> pattern(grid, 0.0);
  const auto &x = s.release.box->x_m, &y = s.release.box->y_m;
  for (int r = 0; r < grid.n_rows; ++r)
    for (int c = 0; c < grid.n_cols; ++c)
      if (grid.x_center(c) > x[0] && grid.x_center(c) < x[1] && grid.y_center(r) > y[0] &&
          grid.y_center(r) < y[1])
        pattern.at(r, c) = 1;
  in.release = std::make_shared<const Raster<double>>(pattern);
  in.hazard_grid = grid;
  return in;
}
inline SceneInputs level(const Scenario& s) {
  return inputs_of(s, [](double, double) { return 0.0; });
}

}  // namespace sturz::test
