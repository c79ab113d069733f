// SPDX-License-Identifier: Apache-2.0
// V3: dense grains at rest carry their own weight, between periodic images and between walls.
#include "engine/effects/fields.hpp"
#include "tests/physics/verification.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace sturz::test {
namespace {

constexpr double height_m = 1;
constexpr double friction_angle_deg = 30;
constexpr int columns = 10;

/// 1 m high, 10 x 10 particles wide, for five times the fall time.
Scenario column(int layers) {
  Scenario s;
  s.formulation = Formulation::full_stress;
  const double dx = height_m / layers, half = 0.5 * columns * dx;
  s.terrain.synthetic = SyntheticTerrain{
      "plane", dx, {{"slope_deg", 0}, {"length_m", 2 * half}, {"width_m", 2 * half}}};
  s.release.box = ReleaseBox{{-half, half}, {-half, half}};
  s.release.thickness_m = Uncertain(height_m);
  s.grains.emplace().friction_angle_deg = Uncertain(friction_angle_deg);
  s.grains->diameter_m = 0.002;
  s.domain.periodic = {"x", "y"};
  s.numerics.spacing_m = dx;
  s.numerics.end_time_s = 5 * std::sqrt(height_m / gravity_m_s2);
  s.numerics.stop_at_rest = false;
  return s;
}

/// The same between four smooth walls.
Scenario box(int layers) {
  Scenario s = column(layers);
  const double half = 0.5 * columns * s.numerics.spacing_m;
  s.domain.periodic.clear();
  s.terrain.synthetic->parameters["length_m"] = 4 * half;
  s.terrain.synthetic->parameters["width_m"] = 4 * half;
  for (const double side : {-1.0, 1.0}) {
    s.domain.walls.push_back({{side * half, 0, 0}, {-side, 0, 0}, 0, std::nullopt});
    s.domain.walls.push_back({{0, side * half, 0}, {0, -side, 0}, 0, std::nullopt});
  }
  return s;
}

/// All stresses are compressive; errors are relative to rho g depth.
struct Rest {
  double profile = 0;                          ///< L2 over the layers' mean vertical stress
  double particle = 0;                         ///< L2 over all particles
  double noise = 0;                            ///< scatter within the layers / (rho g H)
  double lateral_low = 1e9, lateral_high = 0;  ///< layers' mean lateral / vertical stress
  double lateral = 0;                          ///< the same of the whole column
  double kinetic = 0;                          ///< kinetic energy / (m g H)
  double shift = 0;                            ///< mean vertical displacement / H
};

struct LayerSums {
  double n = 0, vertical = 0, squared = 0, lateral = 0, depth = 0;
};

Rest examine(const SimulationParts& parts, const std::vector<double>& start_z) {
  const ParticleSet& p = parts.state.grains();
  const auto& stress = p.components(fields::stress);
  const double weight = parts.state.grains().bulk_density * gravity_m_s2;
  std::vector<LayerSums> layers(
      static_cast<std::size_t>(std::lround(height_m / parts.facts.spacing_m)));
  Rest r;
  double off = 0, all = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double z0 = start_z[p.id[i]], vertical = -stress[2][i] / weight,
                 depth = height_m - p.z[i];
    LayerSums& l =
        layers[std::min(layers.size() - 1, static_cast<std::size_t>(z0 / parts.facts.spacing_m))];
    l.n += 1;
    l.vertical += vertical;
    l.squared += vertical * vertical;
    l.lateral -= 0.5 * (stress[0][i] + stress[1][i]) / weight;
    l.depth += depth;
    off += (vertical - depth) * (vertical - depth);
    all += depth * depth;
    r.shift += (p.z[i] - z0) / height_m / p.size();
  }
  r.particle = std::sqrt(off / all);
  double mean_off = 0, mean_all = 0, scatter = 0, lateral = 0, vertical = 0;
  for (const LayerSums& l : layers) {
    const double mean = l.vertical / l.n, depth = l.depth / l.n;
    mean_off += (mean - depth) * (mean - depth);
    mean_all += depth * depth;
    scatter += (l.squared / l.n - mean * mean) / layers.size();
    lateral += l.lateral, vertical += l.vertical;
    r.lateral_low = std::min(r.lateral_low, l.lateral / l.vertical);
    r.lateral_high = std::max(r.lateral_high, l.lateral / l.vertical);
  }
  r.profile = std::sqrt(mean_off / mean_all);
  r.lateral = lateral / vertical;
  r.noise = std::sqrt(std::max(0.0, scatter)) / height_m;
  r.kinetic = mean_motion(p).energy_height / height_m;
  return r;
}

std::pair<Finished, Rest> settle(Simulation simulation) {
  const ParticleSet& p = simulation.parts().state.grains();
  std::vector<double> z(p.size());
  for (std::size_t i = 0; i < p.size(); ++i) z[p.id[i]] = p.z[i];
  Finished f = run(std::move(simulation));
  const Rest r = examine(f.simulation.parts(), z);
  return {std::move(f), r};
}

/// The cone tau <= k p of the stress law, k = tan(phi), says how far the lateral stress may be from
/// the vertical one. With the same in both directions, p = (1 + 2 K)/3 and tau = |1 - K|/sqrt(3) of
/// the vertical stress, so K lies between the two below: 0.4 and 4 for 30 degrees. (In plane
/// strain, where the other horizontal stress is the mean, (1-k)/(1+k) and its inverse: 0.27
/// and 3.73; by the angle 0.33 and 3.)
const double cone = std::sqrt(3) * std::tan(friction_angle_deg * degree);
const double least_ratio = (3 - cone) / (3 + 2 * cone);
const double largest_ratio = (3 + cone) / (3 - 2 * cone);
/// Rounding of records in single precision.
constexpr double rounding = 1e-3;

class ColumnAtRest : public testing::TestWithParam<int> {};

INSTANTIATE_TEST_SUITE_P(Layers, ColumnAtRest, testing::Values(10, 14, 20),
                         [](const auto& i) { return fmt::format("Layers{}", i.param); });

TEST_P(ColumnAtRest, CarriesItsWeightBetweenPeriodicImages) {
  const auto [f, r] = settle(build(column(GetParam())));
  const std::string name = fmt::format("V3 column, layers {}", GetParam());
  expect_within({name + ", vertical stress", "L2 of the profile", r.profile, 0, r.profile, 0.02},
                f);
  expect_within({name + ", noise", "sd / rho g H", r.noise, 0, r.noise, 0.03}, f);
  expect_within({name + ", kinetic energy", "/ m g H", r.kinetic, 0, r.kinetic, 1e-5}, f);
  expect_within({name + ", displacement", "mean / H", r.shift, 0, r.shift, 0.005}, f);
  expect_within({name + ", stress particle by particle", "L2", r.particle, 0, r.particle, 0.02}, f);
  EXPECT_GE(r.lateral_low, least_ratio - rounding);
  EXPECT_LE(r.lateral_high, largest_ratio + rounding);
  expect_conserved(name, f);
}

/// From a lateral stress that the cone does not allow, at the pressure that belongs to its border
/// under the column's weight: one step brings it to the border (the strain of a step is nothing),
/// and wherever waves take it from there, it comes to rest inside.
void expect_border(const std::string& name, double border, double start) {
  Simulation simulation = build(column(10));
  ParticleSet& p = simulation.parts().state.grains();
  auto& stress = p.components(fields::stress);
  std::vector<double> z(p.size());
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double weight = -stress[2][i];
    const double before = -(stress[0][i] + stress[1][i] + stress[2][i]) / 3;
    const double pressure = weight * (1 + 2 * border) / 3;
    const double vertical = 3 * pressure / (1 + 2 * start);
    p.scalar(fields::density_change)[i] *= pressure / before;  // the elastic law is linear
    stress[0][i] = stress[1][i] = -start * vertical;
    stress[2][i] = -vertical;
    z[p.id[i]] = p.z[i];
  }
  simulation.step();
  const double yielded = examine(simulation.parts(), z).lateral;
  const auto [f, r] = settle(std::move(simulation));
  expect_within(
      relative(name + ", lateral / vertical stress after a step", "-", yielded, border, 0.02), f);
  record(relative(name + ", lateral / vertical stress at rest", "-", r.lateral, border), f);
  expect_within({name + ", vertical stress", "L2 of the profile", r.profile, 0, r.profile, 0.02},
                f);
  expect_within({name + ", kinetic energy", "/ m g H", r.kinetic, 0, r.kinetic, 1e-5}, f);
  EXPECT_GE(r.lateral_low, least_ratio - rounding);
  EXPECT_LE(r.lateral_high, largest_ratio + rounding);
  expect_mass_and_momentum(f);
}

TEST(ColumnFromOutsideTheCone, YieldsToItsActiveBorder) {
  expect_border("V3 column from K = 0.1", least_ratio, 0.1);
}

TEST(ColumnFromOutsideTheCone, YieldsToItsPassiveBorder) {
  expect_border("V3 column from K = 12", largest_ratio, 12);
}

/// Beside smooth walls the stress misses its tolerance (docs/studies/verification.md): the mirrored
/// half of a wall carries no share of the weight along it.
TEST_P(ColumnAtRest, ComesToRestBetweenWalls) {
  const auto [f, r] = settle(build(box(GetParam())));
  const std::string name = fmt::format("V3 box, layers {}", GetParam());
  expect_within({name + ", vertical stress", "L2 of the profile", r.profile, 0, r.profile, 0.02},
                f);
  expect_within({name + ", noise", "sd / rho g H", r.noise, 0, r.noise, 0.03}, f);
  expect_within({name + ", displacement", "mean / H", r.shift, 0, r.shift, 0.005}, f);
  expect_within({name + ", kinetic energy", "/ m g H", r.kinetic, 0, r.kinetic, 1e-5}, f);
  EXPECT_GE(r.lateral_low, least_ratio - rounding);
  EXPECT_LE(r.lateral_high, largest_ratio + rounding);
  expect_mass_and_momentum(f);
  const double residual = f.result.scalars.energy_residual;
  expect_within({name + ", energy residual", "/ released", residual, 0, residual, 0.01}, f);
  expect_numerical_bounded(name, f);
}

}  // namespace
}  // namespace sturz::test
