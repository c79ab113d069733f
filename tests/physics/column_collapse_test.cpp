// SPDX-License-Identifier: Apache-2.0
// V8b: a granular column collapses over rough ground, one slice four particles thick.
#include "scenarios/catalogue.hpp"
#include "tests/physics/verification.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <utility>

namespace sturz::test {
namespace {

/// Where the deposit gets thinner than max(dx/2, 5 cm), from volume per column of width dx,
/// linear in between (the column starts with length 1 m).
double run_out_m(const SimulationParts& parts) {
  const double dx = parts.spacing_m, least = std::max(0.5 * dx, 0.05);
  const ParticleSet& p = parts.state.grains;
  std::vector<double> thickness(static_cast<std::size_t>(8 / dx), 0);
  for (std::size_t i = 0; i < p.size(); ++i) {
    const auto k = static_cast<std::size_t>(std::max(0.0, p.x[i] / dx));
    if (k < thickness.size()) thickness[k] += p.mass[i] / parts.reference_density / (dx * 4 * dx);
  }
  std::size_t last = thickness.size() - 1;
  while (last > 0 && thickness[last] <= least) --last;
  const double share = (thickness[last] - least) / (thickness[last] - thickness[last + 1]);
  return (last + 0.5 + share) * dx - 1;
}

/// Glass beads: mu(I) of Jop et al. in the grains, their avalanche angle of 27.4 degrees at the
/// rough base.
Scenario beads(double aspect, int particles_along) {
  Scenario s = column_collapse(aspect, particles_along);
  s.basal.friction_coefficient = std::tan(27.4 * degree);
  return s;
}

struct Case {
  double aspect;
  std::vector<int> particles_along;
};
void PrintTo(const Case& c, std::ostream* out) { *out << "aspect " << c.aspect; }

class ColumnCollapse : public testing::TestWithParam<Case> {};

// The taller column has twice the particles and falls for longer: coarser, for the same time.
INSTANTIATE_TEST_SUITE_P(Aspects, ColumnCollapse,
                         testing::Values(Case{0.5, {10, 14, 20}}, Case{1, {10, 14, 20}},
                                         Case{2, {8, 11, 16}}),
                         [](const auto& i) {
                           return fmt::format("{:.0f}Percent", 100 * i.param.aspect);
                         });

/// Delta L = 1.2 a L0 for a < 2.3, within 20 % at the finest resolution; coarser ones are reported.
TEST_P(ColumnCollapse, RunsOutAsExperimentsDo) {
  const double expected = 1.2 * GetParam().aspect;
  std::vector<double> dx, run_out;
  for (const int n : GetParam().particles_along) {
    const Finished f = run(beads(GetParam().aspect, n));
    dx.push_back(f.simulation.parts().spacing_m);
    run_out.push_back(run_out_m(f.simulation.parts()));
    const Line line = relative(fmt::format("V8b collapse, a {}, {} along", GetParam().aspect, n),
                               "run-out / L0", run_out.back(), expected, 0.2);
    n == GetParam().particles_along.back() ? expect_within(line, f) : record(line, f);
    expect_conserved(f);
  }
  const Convergence c = observed_convergence(dx, run_out);
  fmt::print("V8b collapse, a {}: observed order {:.2f}, Richardson limit {:.3f}\n",
             GetParam().aspect, c.order, c.limit);
  RecordProperty("observed_order", fmt::format("{:.3f}", c.order));
  RecordProperty("richardson_limit", fmt::format("{:.4f}", c.limit));
  RecordProperty("monotonic", c.monotonic);
}

/// One friction for all rates, that of the avalanche angle, runs shorter.
TEST(ColumnCollapse, ConstantFrictionIsReported) {
  for (const double viscosity : {0.1, 0.05}) {
    Scenario s = beads(1, 14);
    s.grains->friction.reset();
    s.grains->friction_angle_deg = Uncertain(27.4);
    s.numerics.artificial_viscosity = viscosity;
    const Finished f = run(s);
    record(relative(fmt::format("V8b collapse, a 1, friction 27.4 deg, viscosity {}", viscosity),
                    "run-out / L0", run_out_m(f.simulation.parts()), 1.2, 0.2),
           f);
    expect_conserved(f);
  }
}

}  // namespace
}  // namespace sturz::test
