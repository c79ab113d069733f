// SPDX-License-Identifier: Apache-2.0
// A ridge leaves a 35 degree slope and stops on level ground: columns and full stress against
// Savage and Hutter's elements, which this test integrates itself.
#include "scenarios/catalogue.hpp"
#include "tests/physics/descent.hpp"
#include "tests/physics/ridge.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace sturz::test {
namespace {

constexpr double centre = -70, half_length = 16, height = 6;  // in the map, height vertical [m]
const double tan25 = std::tan(25 * degree);
const Ramp ground{std::tan(35 * degree), 20};

/// Savage & Hutter 1989: a plane slide as elements of constant volume between nodes that move along
/// the bed. Momentum of a node: weight along the bed, Coulomb friction of the load g cos + kappa
/// u^2, and the thrust h^2/2 of that load (K = 1) of the elements beside it. Shocks, where the tail
/// runs into what has stopped, are held by a viscous thrust in elements that shorten.
class Elements {
 public:
  explicit Elements(int n) : x_(n + 1), u_(n + 1, 0.0), volume_(n) {
    for (int j = 0; j <= n; ++j) x_[j] = centre + half_length * (2.0 * j / n - 1);
    for (int e = 0; e < n; ++e) volume_[e] = under(x_[e + 1]) - under(x_[e]);
  }
  void run_to_rest(double longest_s) {
    double fastest = 1;
    for (double t = 0; t < longest_s && fastest > 1e-4; t += dt) {
      advance();
      fastest = 0;
      for (const double u : u_) fastest = std::max(fastest, std::abs(u));
    }
    EXPECT_LE(fastest, 1e-4) << "has not stopped";
  }
  double mean_x() const {
    double sum = 0, volume = 0;
    for (std::size_t e = 0; e < volume_.size(); ++e)
      sum += volume_[e] * 0.5 * (x_[e] + x_[e + 1]), volume += volume_[e];
    return sum / volume;
  }
  /// Linear within the element.
  double x99() const {
    double left = 0.99 * (under(centre + half_length) - under(centre - half_length));
    std::size_t e = 0;
    for (; e + 1 < volume_.size() && left > volume_[e]; ++e) left -= volume_[e];
    return x_[e] + (x_[e + 1] - x_[e]) * left / volume_[e];
  }

 private:
  static constexpr double dt = 2e-4;

  /// Volume behind x, per width.
  static double under(double x) {
    const double s = (x - centre) / half_length;
    return height * half_length * (s - s * s * s / 3);
  }
  /// Length of the bed over one metre of the map.
  static double stretch(double x) { return std::hypot(1, ground.slope(x)); }
  static double load(double x, double u) {
    const double q = stretch(x);
    return std::max(0.0, gravity_m_s2 / q + ground.curvature(x) / (q * q * q) * u * u);
  }
  double thrust(std::size_t e) const {
    const double x = 0.5 * (x_[e] + x_[e + 1]), length = (x_[e + 1] - x_[e]) * stretch(x);
    const double h = volume_[e] / length, g = load(x, 0.5 * (u_[e] + u_[e + 1]));
    const double closing = std::max(0.0, u_[e] - u_[e + 1]);
    return 0.5 * g * h * h + h * (closing * closing + 0.5 * closing * std::sqrt(g * h));
  }
  void advance() {
    std::vector<double> pushed(volume_.size());
    for (std::size_t e = 0; e < volume_.size(); ++e) pushed[e] = thrust(e);
    for (std::size_t j = 0; j < x_.size(); ++j) {
      const bool first = j == 0, last = j == volume_.size();
      const double mass = 0.5 * ((first ? 0 : volume_[j - 1]) + (last ? 0 : volume_[j]));
      const double push = (first ? 0 : pushed[j - 1]) - (last ? 0 : pushed[j]);
      const double weight = -gravity_m_s2 * ground.slope(x_[j]) / stretch(x_[j]);
      const double u = u_[j] + dt * (weight + push / mass);
      const double braked = dt * tan25 * load(x_[j], u_[j]);
      u_[j] = std::copysign(std::max(0.0, std::abs(u) - braked), u);
    }
    for (std::size_t j = 0; j < x_.size(); ++j) x_[j] += dt * u_[j] / stretch(x_[j]);
  }

  std::vector<double> x_, u_, volume_;
};

Scenario ramp(Formulation formulation, double spacing, int wide) {
  Scenario s = ramp_slide(90, spacing);
  s.formulation = formulation;
  s.terrain.synthetic = SyntheticTerrain{"ramp",
                                         std::min(2.0, spacing),
                                         {{"slope_deg", 35},
                                          {"slope_length_m", 120},
                                          {"transition_m", 40},
                                          {"level_length_m", 160},
                                          {"width_m", wide * spacing}}};
  s.basal.friction_coefficient = tan25;
  s.grains->friction.reset();
  s.grains->friction_angle_deg = Uncertain(30);
  return s;
}

const Elements& solution() {
  static const Elements at_rest = [] {
    Elements e(200);
    e.run_to_rest(40);
    return e;
  }();
  return at_rest;
}

void compare(const std::string& name, Formulation formulation, double spacing, int wide) {
  const Finished f = run(parabolic_ridge(ramp(formulation, spacing, wide), wide * spacing, centre,
                                         half_length, height));
  const ParticleSet& p = f.simulation.parts().state.grains();
  std::vector<std::pair<double, double>> along;
  for (std::size_t i = 0; i < p.size(); ++i) along.emplace_back(p.x[i], p.mass[i]);
  const double path = solution().mean_x() - centre;
  expect_within(
      relative(name + ", front", "m", front_99(along) - centre, solution().x99() - centre, 0.03),
      f);
  expect_within(relative(name + ", centre of mass", "m", mean_motion(p).x - centre, path, 0.03), f);
  expect_conserved(name, f);
}

TEST(RampStop, ElementsConverge) {
  Elements coarse(50);
  coarse.run_to_rest(40);
  EXPECT_NEAR(coarse.x99() - centre, solution().x99() - centre,
              0.005 * (solution().x99() - centre));
  EXPECT_NEAR(coarse.mean_x(), solution().mean_x(), 0.002 * (solution().mean_x() - centre));
}

TEST(RampStop, ColumnsStopWhereElementsStop) {
  for (const double spacing : {4.0, 2.0, 1.0})
    compare(fmt::format("ramp stop, columns of {:.0f} m", spacing), Formulation::depth_averaged,
            spacing, 12);
}

/// Six layers of grains that are rougher inside than their bed.
TEST(RampStop, FullStressStopsWhereElementsStop) {
  compare("ramp stop, six layers", Formulation::full_stress, 1, 6);
}

}  // namespace
}  // namespace sturz::test
