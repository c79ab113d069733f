// SPDX-License-Identifier: Apache-2.0
// V18 in three dimensions: a parabolic ridge, one periodic slice of it, spreads down a 35 degree
// slope over a bed of tan 25 degrees. Full stress at four and more layers, columns beside it.
#include "io/site/scene_inputs.hpp"
#include "scenarios/assembly/assemble.hpp"
#include "scenarios/catalogue.hpp"
#include "tests/physics/verification.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

namespace sturz::test {
namespace {

constexpr double half_length = 80, depth = 4, end_time = 10, start = -120;
const double cos35 = std::cos(35 * degree), sin35 = std::sin(35 * degree);

/// Half-length at the end: a'' = 2 K g cos h_c / a with h_c = h_0 a_0 / a (Savage & Hutter 1989),
/// K = 1, by small steps.
double spread() {
  double a = half_length, rate = 0;
  const double dt = 1e-4;
  for (double t = 0; t < end_time; t += dt) {
    rate += dt * 2 * gravity_m_s2 * cos35 * depth * half_length / (a * a);
    a += dt * rate;
  }
  return a;
}

/// Where 99 % of a parabola's area lies behind, in half-lengths.
double front_share() {
  double lo = 0, hi = 1;
  for (int i = 0; i < 60; ++i) {
    const double u = 0.5 * (lo + hi);
    (0.5 + 0.75 * (u - u * u * u / 3) < 0.99 ? lo : hi) = u;
  }
  return lo;
}

Simulation ridge(Formulation formulation, double spacing, int wide,
                 double friction_angle_deg = 20) {
  Scenario s = similarity_slide(spacing);
  const double width = wide * spacing, cell = 0.5 * spacing;
  s.formulation = formulation;
  s.grains->friction.reset();
  s.grains->friction_angle_deg = Uncertain(friction_angle_deg);
  s.terrain.synthetic =
      SyntheticTerrain{"plane", cell, {{"slope_deg", 35}, {"length_m", 560}, {"width_m", width}}};
  s.release.paraboloid.reset();
  s.release.box = ReleaseBox{{start - half_length, start + half_length}, {-width / 2, width / 2}};
  s.domain.periodic = {"y"};
  SceneInputs inputs = load_scene_inputs(s);
  auto thickness = std::make_shared<Raster<double>>(inputs.elevation->grid, 0.0);
  for (int r = 0; r < thickness->grid.n_rows; ++r)
    for (int c = 0; c < thickness->grid.n_cols; ++c) {
      const double u = (thickness->grid.x_center(c) - start) / (half_length * cos35);
      thickness->at(r, c) = std::max(0.0, depth / cos35 * (1 - u * u));
    }
  inputs.release = std::move(thickness);
  inputs.release_cover = nullptr;  // of the box that the parabola takes the place of
  inputs.pattern = ReleasePattern::thickness;
  s.release.box.reset();
  s.release.thickness_m.reset();
  return assemble(s, inputs, 0, 1);
}

struct Ridge {
  double centre = 0, half = 0, x99 = 0;

  explicit Ridge(const ParticleSet& p) {
    std::vector<std::pair<double, double>> along;
    double mass = 0, xx = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
      along.emplace_back((p.x[i] - start) / cos35, p.mass[i]);
      mass += p.mass[i], centre += p.mass[i] * along.back().first;
    }
    centre /= mass;
    for (const auto& [x, m] : along) xx += m * (x - centre) * (x - centre);
    half = std::sqrt(5 * xx / mass);  // a parabola's second moment is a^2/5
    std::sort(along.begin(), along.end());
    double behind = 0;
    for (const auto& [x, m] : along)
      if ((behind += m) >= 0.99 * mass) {
        x99 = x;
        break;
      }
  }
};

Line line(const std::string& name, double metres, double expected, double tolerance) {
  return relative(name, "m", metres, expected, tolerance);
}

/// NaN for a tolerance: reported only.
void compare(const std::string& name, Simulation simulation, double half_tolerance,
             double front_tolerance) {
  const Finished f = run(std::move(simulation));
  const Ridge ridge(f.simulation.parts().state.grains());
  const double travel =
      0.5 * gravity_m_s2 * (sin35 - std::tan(25 * degree) * cos35) * end_time * end_time;
  const double a = spread();
  const Line half = line(name + ", half-length", ridge.half, a, half_tolerance);
  const Line front = line(name + ", x99", ridge.x99, travel + front_share() * a, front_tolerance);
  record(line(name + ", centre", ridge.centre, travel, reported_only), f);
  std::isnan(half_tolerance) ? record(half, f) : expect_within(half, f);
  std::isnan(front_tolerance) ? record(front, f) : expect_within(front, f);
  expect_conserved(f);
}

/// The closed form has K = 1. A mass that is rougher inside than its bed spreads less (active K
/// under one); one that is much smoother shears inside, and its centre outruns the plug's.
TEST(SimilarityStrip, FullStressSpreadsWithinATenthFromFourLayersOn) {
  for (const int layers : {4, 5})
    compare(fmt::format("V18 strip, {} layers", layers),
            ridge(Formulation::full_stress, depth / layers, 6), 0.10, 0.06);
  for (const double angle : {15.0, 25.0, 30.0})
    compare(fmt::format("V18 strip, 4 layers, {} deg inside", angle),
            ridge(Formulation::full_stress, depth / 4, 6, angle), reported_only, reported_only);
}

TEST(SimilarityStrip, ColumnsSpreadWithinAHundredth) {
  for (const double spacing : {4.0, 2.0, 1.0})
    compare(fmt::format("V18 strip, columns of {:.0f} m", spacing),
            ridge(Formulation::depth_averaged, spacing, 12), 0.01, 0.01);
}

}  // namespace
}  // namespace sturz::test
