// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/scenes.hpp"

#include "engine/core/random.hpp"
#include "io/site/scene_inputs.hpp"
#include "scenarios/assembly/ground.hpp"
#include "scenarios/catalogue.hpp"

#include <fmt/core.h>

#include <cmath>
#include <memory>
#include <numbers>

namespace sturz::bench {
namespace {

Scenario box_on_slope(double slope_deg, double length_m, double width_m, ReleaseBox box,
                      double thickness_m) {
  Scenario s;
  s.terrain.synthetic = SyntheticTerrain{
      "plane", 5, {{"slope_deg", slope_deg}, {"length_m", length_m}, {"width_m", width_m}}};
  s.release.box = box;
  s.release.thickness_m = Uncertain(thickness_m);
  s.grains.emplace().friction.emplace();
  s.basal.friction_coefficient = 0.3;
  s.numerics.end_time_s = 60;
  s.numerics.stop_at_rest = false;
  return s;
}

Scene loaded(std::string name, Scenario s) {
  s.title = name;
  SceneInputs inputs = load_scene_inputs(s);
  return {std::move(name), std::move(s), std::move(inputs)};
}

/// Waves of 2 m height and 40 to 90 m length, in no common period.
double bump(double x, double y) {
  const double turn = 2 * std::numbers::pi;
  return 1.0 * std::sin(turn * (x / 67 + y / 91)) + 0.6 * std::sin(turn * (y / 43 - x / 83)) +
         0.4 * std::cos(turn * x / 41);
}

}  // namespace

Scene dense_slide(double n_particles) {
  Scenario s = box_on_slope(26, 400, 200, ReleaseBox{{-150, -50}, {-40, 40}}, 27);
  s.formulation = Formulation::full_stress;
  s.numerics.spacing_m = std::cbrt(100 * 80 * 27 / n_particles);
  return loaded(fmt::format("dense slide {:.0f}k", n_particles / 1000), std::move(s));
}

Scene thin_slide() {
  Scenario s = box_on_slope(30, 300, 100, ReleaseBox{{-120, -80}, {-10, 10}}, 4);
  s.formulation = Formulation::full_stress;
  s.numerics.spacing_m = 1;
  return loaded("thin slide", std::move(s));
}

Scene column_slide(double n_columns, double end_time_s) {
  Scenario s = box_on_slope(26, 2000, 400, ReleaseBox{{-950, -850}, {-50, 50}}, 5);
  s.formulation = Formulation::depth_averaged;
  s.numerics.spacing_m = std::sqrt(100 * 100 / n_columns);
  s.numerics.end_time_s = end_time_s;
  Scene scene = loaded(fmt::format("columns {:.1f}k", n_columns / 1000), std::move(s));
  Raster<double> ground = *scene.inputs.elevation;
  const Grid& g = ground.grid;
  for (int r = 0; r < g.n_rows; ++r)
    for (int c = 0; c < g.n_cols; ++c) ground.at(r, c) += bump(g.x_center(c), g.y_center(r));
  scene.inputs.elevation = std::make_shared<const Raster<double>>(std::move(ground));
  scene.inputs.ground = scene.inputs.column_ground = nullptr;
  prepare_grounds(scene.scenario, scene.inputs);
  return scene;
}

Scene small_member(double end_time_s) {
  Scenario s = ramp_slide(90, 1.5);
  s.numerics.end_time_s = end_time_s;
  return loaded("small full-stress member", std::move(s));
}

Scenario varied(const Scenario& scenario, std::int64_t member) {
  Scenario s = scenario;
  const double u = unit_random(1, static_cast<std::uint64_t>(member));
  s.basal.friction_coefficient.value *= 0.9 + 0.2 * u;
  return s;
}

}  // namespace sturz::bench
