// SPDX-License-Identifier: Apache-2.0
#include "tests/hard/priors.hpp"

#include "engine/core/error.hpp"
#include "ensemble/sampling/marginal.hpp"

#include <cmath>
#include <numbers>
#include <string>
#include <utility>

namespace sturz::test {
namespace {

using Kind = Distribution::Kind;

Distribution between(Kind kind, double min, double max) {
  Distribution d;
  d.kind = kind, d.min = min, d.max = max;
  return d;
}

Distribution lognormal(double median, double sigma_ln, double min, double max) {
  Distribution d = between(Kind::lognormal, min, max);
  d.median = median, d.sigma_ln = sigma_ln;
  return d;
}

Distribution normal(double mean, double sd, double min, double max) {
  Distribution d = between(Kind::normal, min, max);
  d.mean = mean, d.sd = sd;
  return d;
}

/// Nothing in seven of ten cases, else Beta(2, 8); as a table of quantiles.
Distribution dry_or_damp() {
  Distribution beta = between(Kind::beta, 0, 1);
  beta.alpha = 2, beta.beta = 8;
  const Marginal damp(beta);
  Distribution d;
  d.kind = Kind::table;
  constexpr int n = 1000;
  for (int i = 0; i < n; ++i) {
    const double u = (static_cast<double>(i) / n - 0.7) / 0.3;
    d.values.push_back(u > 0 ? damp.quantile(u) : 0);
  }
  return d;
}

/// sd of .14 decades about the regression on the volume, 1.0081 V^-.0847 with V in m^3.
Distribution bed_friction() {
  return lognormal(1.0081 * std::pow(1.2e6, -0.0847), 0.14 * std::numbers::ln10, 0.08, 0.7);
}

}  // namespace

std::vector<UncertainKey> rock_avalanche_priors() {
  Distribution fraction = between(Kind::triangular, 0.5, 0.72);
  fraction.mode = 0.6;
  return {{"basal.friction_coefficient", "1", bed_friction()},
          {"basal.pore_pressure_ratio", "1", dry_or_damp()},
          {"grains.friction_angle_deg", "degree", normal(33, 4, 22, 45)},
          {"release.volume_factor", "1", lognormal(1, 0.25, 0.3, 3)},
          {"grains.cohesion_pa", "Pa", lognormal(2000, 1, 1, 20000)},
          {"basal.restitution", "1", between(Kind::uniform, 0.3, 0.7)},
          {"grains.diameter_m", "m", between(Kind::log_uniform, 0.3, 3)},
          {"grains.solid_fraction", "1", fraction},
          {"grains.friction_gain", "1", between(Kind::uniform, 0.2, 0.3)},
          {"grains.friction.inertial_number_scale", "1", between(Kind::uniform, 0.2, 0.4)}};
}

const DesignTable& hard_points() {
  static const DesignTable table = [] {
    const auto keys = rock_avalanche_priors();
    EnsembleSpec spec;
    spec.design = Design::latin_hypercube;
    spec.members = n_random;
    spec.seed = 20170828;
    spec.correlation = {{"basal.friction_coefficient/grains.friction_angle_deg", 0.5}};
    DesignTable points = draw_design(keys, spec);
    std::vector<std::vector<double>> corners(n_corners);
    for (std::size_t k = 0; k < keys.size(); ++k) {
      const Marginal marginal(keys[k].distribution, keys[k].path);
      for (int row = 0; row < n_corners; ++row)
        corners[row].push_back(marginal.quantile(k >= 6 ? 0.5 : row >> k & 1 ? 0.99 : 0.01));
    }
    points.values.insert(points.values.begin(), corners.begin(), corners.end());
    points.unit_cube.clear();
    points.design = Design::table;
    return points;
  }();
  return table;
}

Scenario at_point(Scenario s, int row, double volume_m3) {
  const DesignTable& points = hard_points();
  auto value = [&](const char* key) {
    for (std::size_t k = 0; k < points.keys.size(); ++k)
      if (points.keys[k] == key) return points.values.at(row)[k];
    throw SetupError(std::string(key) + " (no such column). Use a name of rock_avalanche_priors.");
  };
  if (!s.grains) s.grains.emplace();
  GrainsSpec& g = *s.grains;
  s.basal.friction_coefficient = value("basal.friction_coefficient");
  s.basal.pore_pressure_ratio = value("basal.pore_pressure_ratio");
  s.basal.restitution = value("basal.restitution");
  FrictionLaw law;
  law.static_coefficient = std::tan(value("grains.friction_angle_deg") * std::numbers::pi / 180);
  law.dynamic_coefficient = law.static_coefficient.value + value("grains.friction_gain");
  law.inertial_number_scale = value("grains.friction.inertial_number_scale");
  g.friction = law;
  g.cohesion_pa = value("grains.cohesion_pa");
  g.diameter_m = value("grains.diameter_m");
  g.solid_fraction = value("grains.solid_fraction");
  s.release.volume_m3 = Uncertain(volume_m3 * value("release.volume_factor"));
  return s;
}

}  // namespace sturz::test
