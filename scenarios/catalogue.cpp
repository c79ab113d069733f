// SPDX-License-Identifier: Apache-2.0
#include "scenarios/catalogue.hpp"

#include "engine/core/constants.hpp"
#include "engine/core/error.hpp"
#include "scenarios/schema/suggest.hpp"

#include <cmath>
#include <numbers>
#include <utility>

namespace sturz {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// A scene on synthetic ground with mu(I) grains; only the release is left to say.
Scenario on_ground(std::string title, std::string shape, double cell_m,
                   std::map<std::string, double> parameters) {
  Scenario s;
  s.title = std::move(title);
  s.terrain.synthetic = SyntheticTerrain{std::move(shape), cell_m, std::move(parameters)};
  s.grains.emplace().friction.emplace();
  s.formulation = Formulation::full_stress;
  s.numerics.accept_unresolved = true;  // single particles and sheets among them are on purpose
  return s;
}

using Maker = Scenario (*)();
const std::vector<std::pair<std::string, Maker>>& makers() {
  static const std::vector<std::pair<std::string, Maker>> all = {
      {"block_on_plane", [] { return block_on_plane(); }},
      {"column_collapse", [] { return column_collapse(); }},
      {"cylinder_collapse", [] { return cylinder_collapse(); }},
      {"pile", [] { return pile(); }},
      {"cliff", [] { return cliff(); }},
      {"thin_sheet", [] { return thin_sheet(); }},
      {"ramp_slide", [] { return ramp_slide(); }},
      {"wet_ramp", [] { return wet_ramp(); }},
      {"bagnold_slab", [] { return bagnold_slab(); }},
      {"zhangjiawan_small", [] { return zhangjiawan_small(); }},
  };
  return all;
}

}  // namespace

Scenario block_on_plane(double friction_coefficient, double pore_pressure_ratio) {
  Scenario s = on_ground("Block on an even slope", "plane", 1,
                         {{"slope_deg", 30}, {"length_m", 160}, {"width_m", 40}});
  s.release.box = ReleaseBox{{-70, -60}, {-5, 5}};
  s.release.thickness_m = Uncertain(4);
  s.basal.friction_coefficient = friction_coefficient;
  s.basal.pore_pressure_ratio = pore_pressure_ratio;
  s.numerics.spacing_m = 1;
  s.numerics.end_time_s = 5;
  return s;
}

Scenario column_collapse(double aspect, int particles_along) {
  const double length = 1, spacing = length / particles_along;
  // In whole cells, so that the column's edges lie between cells: behind none of it is the wall.
  const double runout = 2 * spacing * std::ceil(length * (1.5 + 3 * aspect) / (2 * spacing));
  Scenario s = on_ground("Collapse of a granular column", "plane", 2 * spacing,
                         {{"slope_deg", 0}, {"length_m", 2 * runout}, {"width_m", 4 * spacing}});
  s.release.box = ReleaseBox{{0, length}, {-2 * spacing, 2 * spacing}};
  s.release.thickness_m = Uncertain(aspect * length);
  s.grains->diameter_m = 0.002;
  s.basal.friction_coefficient = 0.5;
  s.domain.periodic = {"y"};
  s.domain.walls = {WallSpec{{0, 0, 0}, {1, 0, 0}, 0, std::nullopt}};
  s.numerics.spacing_m = spacing;
  s.numerics.end_time_s = 8 * std::sqrt(aspect * length / standard_gravity);
  return s;
}

Scenario cylinder_collapse(double aspect, int particles_along) {
  const double radius = 1, spacing = radius / particles_along;
  // Twice the run-out that experiments show, in whole cells so that the axis is a node.
  const double run_out = radius * std::min(1.24 * aspect, 2 * std::sqrt(aspect));
  const double runout = 2 * spacing * std::ceil((1.5 * radius + 2 * run_out) / (2 * spacing));
  Scenario s = on_ground("Collapse of a round column of glass beads", "plane", 2 * spacing,
                         {{"slope_deg", 0}, {"length_m", 2 * runout}, {"width_m", 2 * runout}});
  s.release.cylinder = ReleaseCylinder{{0, 0}, radius};
  s.release.thickness_m = Uncertain(aspect * radius);
  s.grains->diameter_m = 0.002;
  s.basal.friction_coefficient = std::tan(27.4 * degree);
  s.numerics.spacing_m = spacing;
  s.numerics.end_time_s = 8 * std::sqrt(aspect * radius / standard_gravity);
  return s;
}

Scenario pile(double spacing_m) {
  Scenario s =
      on_ground("Pile at rest", "plane", 1, {{"slope_deg", 0}, {"length_m", 60}, {"width_m", 60}});
  s.release.paraboloid = ReleaseParaboloid{{0, 0}, {16, 16}};
  s.release.thickness_m = Uncertain(4);
  s.grains->friction.reset();
  s.grains->friction_angle_deg = Uncertain(40);
  s.basal.friction_coefficient = 0.8;
  s.numerics.spacing_m = spacing_m;
  s.numerics.end_time_s = 10;
  s.numerics.stop_at_rest = false;
  return s;
}

Scenario cliff(double spacing_m) {
  Scenario s = on_ground(
      "Over the edge of a cliff", "step", 1,
      {{"drop_m", 20}, {"face_deg", 60}, {"slope_deg", 20}, {"length_m", 200}, {"width_m", 60}});
  s.release.box = ReleaseBox{{-20, -5}, {-8, 8}};
  s.release.thickness_m = Uncertain(5);
  s.basal.friction_coefficient = 0.3;
  s.numerics.spacing_m = spacing_m;
  s.numerics.end_time_s = 15;
  return s;
}

Scenario thin_sheet(int layers) {
  const double spacing = 1, length = 12, width = 8;
  Scenario s = on_ground("Thin sheet on an even slope", "plane", 2 * spacing,
                         {{"slope_deg", 30}, {"length_m", length}, {"width_m", width}});
  s.release.box = ReleaseBox{{-length / 2, length / 2}, {-width / 2, width / 2}};
  s.release.thickness_m = Uncertain(layers * spacing);
  s.basal.friction_coefficient = std::tan(25 * degree);
  s.domain.periodic = {"x", "y"};
  s.numerics.spacing_m = spacing;
  s.numerics.end_time_s = 5;
  s.numerics.stop_at_rest = false;
  return s;
}

Scenario ramp_slide(double azimuth_deg, double spacing_m) {
  const double drop = 100, from = -drop / std::tan(30 * degree);
  Scenario s = on_ground("Run-out from a slope onto level ground", "ramp", 2.5,
                         {{"slope_deg", 30},
                          {"slope_length_m", 240},
                          {"level_length_m", 260},
                          {"width_m", 160},
                          {"azimuth_deg", azimuth_deg}});
  s.release.cylinder = ReleaseCylinder{
      {from * std::sin(azimuth_deg * degree), from * std::cos(azimuth_deg * degree)}, 15};
  s.release.thickness_m = Uncertain(10);
  s.basal.friction_coefficient = std::tan(20 * degree);
  s.numerics.spacing_m = spacing_m;
  s.numerics.end_time_s = 60;
  return s;
}

Scenario wet_ramp(double solid_fraction, double spacing_m) {
  Scenario s = ramp_slide(90, spacing_m);
  s.title = "A mixture of grains and water on a slope that runs out on level ground";
  s.formulation = Formulation::depth_averaged;
  s.grains->density_kg_m3 = 2700;
  s.grains->solid_fraction = solid_fraction;
  s.mixture.emplace().fluid_density_kg_m3 = 1100;
  s.basal.friction_coefficient = std::tan(36 * degree);
  return s;
}

Scenario channel(double spacing_m) {
  Scenario s = on_ground("Channel on an even slope", "plane", 2,
                         {{"slope_deg", 20}, {"length_m", 200}, {"width_m", 40}});
  s.formulation = Formulation::depth_averaged;
  s.basal.friction_coefficient = 0.1;
  s.basal.turbulent_coefficient_m_s2 = Uncertain(80);
  s.domain.walls = {WallSpec{{0, -10, 0}, {0, 1, 0}, 0, std::nullopt},
                    WallSpec{{0, 10, 0}, {0, -1, 0}, 0, std::nullopt}};
  s.numerics.spacing_m = spacing_m;
  return s;
}

Scenario bagnold_slab(double slope_deg, int layers) {
  const double height = 0.1, spacing = height / layers, side = 6 * spacing;
  Scenario s = on_ground("Glass beads flow down an even slope", "plane", spacing,
                         {{"slope_deg", slope_deg}, {"length_m", side}, {"width_m", side}});
  s.release.box = ReleaseBox{{-side / 2, side / 2}, {-side / 2, side / 2}};
  s.release.thickness_m = Uncertain(height / std::cos(slope_deg * degree));
  s.grains->diameter_m = 0.005;
  s.grains->friction = FrictionLaw{0.38186, 0.64347, 0.279};
  s.basal.friction_coefficient = 1.1 * std::tan(slope_deg * degree);
  s.domain.periodic = {"x", "y"};
  s.numerics.spacing_m = spacing;
  s.numerics.end_time_s = 3;
  s.numerics.stop_at_rest = false;
  return s;
}

Scenario similarity_slide(double spacing_m) {
  const double cos35 = std::cos(35 * degree);
  Scenario s = on_ground("Savage and Hutter's parabolic cap on an even slope", "plane", 4,
                         {{"slope_deg", 35}, {"length_m", 560}, {"width_m", 320}});
  s.formulation = Formulation::depth_averaged;
  s.release.paraboloid = ReleaseParaboloid{{-120, 0}, {80 * cos35, 80}};
  s.release.thickness_m = Uncertain(4 / cos35);
  s.basal.friction_coefficient = std::tan(25 * degree);
  s.numerics.spacing_m = spacing_m;
  s.numerics.end_time_s = 10;
  s.numerics.stop_at_rest = false;
  return s;
}

Scenario zhangjiawan_small(double spacing_m) {
  Scenario s = on_ground("Zhangjiawan-like rock avalanche, small", "zhangjiawan", 10, {});
  auto& g = *s.grains;
  g.friction.reset();
  g.density_kg_m3 = 2400;
  g.diameter_m = 3;
  g.solid_fraction = 0.7;
  g.friction_angle_deg = Uncertain(24);
  g.cohesion_pa = 5000;
  s.basal.friction_coefficient = 0.24;
  s.numerics.spacing_m = spacing_m;
  s.numerics.end_time_s = 80;
  s.hazard.cell_size_m = 10;
  return s;
}

std::vector<std::string> catalogue_names() {
  std::vector<std::string> names;
  for (const auto& [name, make] : makers()) names.push_back(name);
  return names;
}

Scenario catalogue_scene(const std::string& name) {
  for (const auto& [known, make] : makers())
    if (known == name) return make();
  const std::string near = nearest_name(name, catalogue_names());
  throw SetupError("catalogue scene " + name + " (unknown)." +
                   (near.empty() ? "" : " Did you mean " + near + "?"));
}

}  // namespace sturz
