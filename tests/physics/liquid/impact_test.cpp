// SPDX-License-Identifier: Apache-2.0
// SPHERIC test 2 (Kleefsman and others 2005): a dam break that hits a box on the floor of a tank.
#include "tests/physics/liquid/liquid_books.hpp"
#include "tests/support/liquid/impact_tank.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace sturz::test {
namespace {

constexpr double height = ImpactTank::height, face = ImpactTank::west + ImpactTank::face;

/// Mean pressure of the particles beside the face at height z, near its middle [Pa].
double pressure_at(const SimulationParts& parts, double z) {
  const ParticleSet& p = parts.state.sets[0];
  const double dx = parts.facts.spacing_m;
  double sum = 0, n = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double before = face - p.x[i];
    if (before < 0 || before > 1.5 * dx || std::abs(p.y[i]) > 2 * dx) continue;
    if (std::abs(p.z[i] - z) > std::max(dx, 0.02)) continue;
    sum += pressure_of(p, i), n += 1;
  }
  return n > 0 ? sum / n : 0;
}

/// p/(rho g H) of gauge P1 (z = 0.021 m) over t sqrt(g/H), as printed with PySPH.
constexpr std::array<std::array<double, 2>, 11> measured_p1{{{1.672, 0.447},
                                                             {1.684, 1.435},
                                                             {1.711, 2.022},
                                                             {1.778, 1.721},
                                                             {1.948, 1.358},
                                                             {2.308, 1.080},
                                                             {2.733, 0.776},
                                                             {3.581, 0.641},
                                                             {5.703, 0.463},
                                                             {8.673, 0.550},
                                                             {12.07, 0.359}}};

double measured_at(double t) {
  for (std::size_t k = 1; k < measured_p1.size(); ++k)
    if (measured_p1[k - 1][0] <= t && t <= measured_p1[k][0])
      return measured_p1[k - 1][1] + (measured_p1[k][1] - measured_p1[k - 1][1]) *
                                         (t - measured_p1[k - 1][0]) /
                                         (measured_p1[k][0] - measured_p1[k - 1][0]);
  return 0;
}

struct Gauge {
  std::vector<double> time, pressure;

  /// First time at which the pressure is above `least`.
  double arrival(double least) const {
    for (std::size_t k = 0; k < time.size(); ++k)
      if (pressure[k] > least) return time[k];
    return 1e9;
  }
  double impulse(double from, double to) const {
    double sum = 0;
    for (std::size_t k = 1; k < time.size(); ++k)
      if (time[k - 1] >= from && time[k] <= to)
        sum += 0.5 * (pressure[k] + pressure[k - 1]) * (time[k] - time[k - 1]);
    return sum;
  }
};

TEST(LiquidImpact, HitsTheBoxWhenAndAsHardAsMeasured) {
  const double unit = std::sqrt(height / gravity_m_s2), weight = 1000 * gravity_m_s2 * height;
  Gauge reference;
  for (double t = measured_p1[0][0]; t < 7; t += 0.002)
    reference.time.push_back(t * unit), reference.pressure.push_back(weight * measured_at(t));
  const double hit = reference.time.front();
  for (const int across : resolutions({14, 20}, {40})) {
    const LiquidBox b = ImpactTank::scene(across);
    Gauge p1, p3;
    const Finished f =
        run(simulation_of(b, 1.5),
            {0.004, [&](double t, const SimulationParts& parts) {
               p1.time.push_back(t), p1.pressure.push_back(pressure_at(parts, 0.021));
               p3.time.push_back(t), p3.pressure.push_back(pressure_at(parts, 0.101));
             }});
    const std::string name = fmt::format("SPHERIC 2, {} across", across);
    const double arrival = p1.arrival(0.2 * weight);
    expect_within({name + ", arrival at P1", "s", arrival, hit, arrival - hit, 0.03}, f);
    expect_within(relative(name + ", impulse at P1", "Pa s", p1.impulse(arrival, arrival + 1),
                           reference.impulse(hit, hit + 1), 0.2),
                  f);
    const double peak = *std::max_element(p1.pressure.begin(), p1.pressure.end()) / weight;
    record({name + ", peak at P1", "rho g H", peak, 2.022, peak / 2.022 - 1}, f);
    const double above = *std::max_element(p3.pressure.begin(), p3.pressure.end()) / weight;
    record({name + ", peak at P3", "rho g H", above, 1.217, above / 1.217 - 1}, f);
    EXPECT_EQ(f.simulation.parts().state.ledger().lost_mass, 0) << name;
    expect_liquid_books(name, f, {});
  }
}

}  // namespace
}  // namespace sturz::test
