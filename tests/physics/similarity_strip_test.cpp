// SPDX-License-Identifier: Apache-2.0
// V18 in three dimensions: a parabolic ridge, one periodic slice of it, spreads down a 35 degree
// slope. Full stress at four and more layers with its own material's thrust, columns beside it.
#include "scenarios/catalogue.hpp"
#include "tests/physics/ridge.hpp"
#include "tests/physics/verification.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace sturz::test {
namespace {

constexpr double half_length = 80, depth = 4, end_time = 10, start = -120;
const double cos35 = std::cos(35 * degree), sin35 = std::sin(35 * degree);

/// A ridge that stretches is everywhere at its active limit. tau <= k p, k = tan(angle), is in
/// plane strain a Mohr circle of radius k p around the mean p of the two stresses in the plane.
/// Shear along the bed is tan(bed) of the normal stress at every depth, because a plug's
/// acceleration is the same at every depth. With normal stress 1 the circle gives K = 2 p - 1 with
/// the smaller p of (1 - p)^2 + tan^2(bed) = k^2 p^2 (Savage & Hutter 1989 with sin(phi) = k):
/// (1-k)/(1+k) over a bed without friction, 1 where the bed is as rough as the grains.
double active_pressure(double angle_deg, double bed_deg) {
  const double k = std::tan(angle_deg * degree), t = std::tan(bed_deg * degree), c = 1 - k * k;
  return 2 * (1 - std::sqrt(std::max(0.0, 1 - c * (1 + t * t)))) / c - 1;
}

/// What drives the ridge apart. The shallow theory leaves out a term as large: the shear tan(bed)
/// times the weight above it changes along the slope with the thickness, and so tilts the load on
/// the bed, N = rho g cos h (1 - tan(bed) dh/dx). Friction by it takes tan^2(bed) off K.
double active_thrust(double angle_deg, double bed_deg) {
  const double t = std::tan(bed_deg * degree);
  return active_pressure(angle_deg, bed_deg) - t * t;
}

/// Half-length at the end: a'' = 2 K g cos h_c / a with h_c = h_0 a_0 / a (Savage & Hutter 1989),
/// by small steps.
double spread(double thrust) {
  double a = half_length, rate = 0;
  const double dt = 1e-4;
  for (double t = 0; t < end_time; t += dt) {
    rate += dt * 2 * thrust * gravity_m_s2 * cos35 * depth * half_length / (a * a);
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

/// Friction angles inside and of the bed.
struct Material {
  double inside_deg = 25, bed_deg = 25;
};

Simulation ridge(Formulation formulation, double spacing, int wide, const Material& m = {}) {
  Scenario s = similarity_slide(spacing);
  const double width = wide * spacing, cell = 0.5 * spacing;
  s.formulation = formulation;
  s.grains->friction.reset();
  s.grains->friction_angle_deg = Uncertain(m.inside_deg);
  s.basal.friction_coefficient = std::tan(m.bed_deg * degree);
  s.terrain.synthetic =
      SyntheticTerrain{"plane", cell, {{"slope_deg", 35}, {"length_m", 560}, {"width_m", width}}};
  return parabolic_ridge(std::move(s), width, start, half_length * cos35, depth / cos35);
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
    x99 = front_99(along);
  }
};

struct Compared {
  Finished finished;
  double error;  ///< of the half-length, relative
};

Compared compare(const std::string& name, Simulation simulation, double bed_deg, double thrust,
                 double half_tolerance, double front_tolerance) {
  Finished f = run(std::move(simulation));
  const Ridge ridge(f.simulation.parts().state.grains());
  const double travel =
      0.5 * gravity_m_s2 * (sin35 - std::tan(bed_deg * degree) * cos35) * end_time * end_time;
  const double a = spread(thrust);
  record(relative(name + ", centre", "m", ridge.centre, travel), f);
  expect_within(relative(name + ", half-length", "m", ridge.half, a, half_tolerance), f);
  expect_within(
      relative(name + ", x99", "m", ridge.x99, travel + front_share() * a, front_tolerance), f);
  expect_conserved(name, f);
  return {std::move(f), ridge.half / a - 1};
}

/// Grains as rough as their bed (K = 1), rougher (0.70 with 30 degrees), and on a bed without
/// friction, where the whole cone is left for the thrust: 0.36 with 25 degrees.
TEST(SimilarityStrip, FullStressSpreadsByItsOwnThrust) {
  const auto error = [](int layers, const Material& m) {
    return compare(fmt::format("V18 strip, {} layers, {:.0f} deg inside, bed {:.0f} deg", layers,
                               m.inside_deg, m.bed_deg),
                   ridge(Formulation::full_stress, depth / layers, 6, m), m.bed_deg,
                   active_thrust(m.inside_deg, m.bed_deg), 0.05, 0.06);
  };
  error(4, {30, 25});
  error(4, {25, 0});
  const Compared coarse = error(3, {25, 25}), fine = error(4, {25, 25});
  const double ratio = std::abs(fine.error / coarse.error);
  expect_within({"V18 strip, 25 deg inside, refinement", "half-length's error, 4 layers / 3", ratio,
                 0.75, ratio, 1},
                fine.finished);
}

TEST(SimilarityStrip, ThrustOfTheClosedForm) {
  const double k = std::tan(30 * degree);
  EXPECT_NEAR(active_thrust(30, 0), (1 - k) / (1 + k), 1e-12);
  EXPECT_NEAR(active_pressure(25, 25), 1, 1e-7);
  EXPECT_NEAR(active_thrust(25, 25), 0.7826, 1e-4);
}

/// Columns have K = 1 whatever their grains.
TEST(SimilarityStrip, ColumnsSpreadWithinAHundredth) {
  for (const double spacing : {4.0, 2.0, 1.0})
    compare(fmt::format("V18 strip, columns of {:.0f} m", spacing),
            ridge(Formulation::depth_averaged, spacing, 12), 25, 1, 0.01, 0.01);
}

}  // namespace
}  // namespace sturz::test
