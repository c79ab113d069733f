// SPDX-License-Identifier: Apache-2.0
// V8b: a granular column collapses over rough ground, one slice four particles thick.
#include "scenarios/catalogue.hpp"
#include "tests/physics/collapse/deposit_edge.hpp"
#include "tests/physics/verification.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <ostream>
#include <utility>

namespace sturz::test {
namespace {

/// The column starts with length 1 m.
struct Deposit {
  double run_out = 0;  ///< (L - L0) / L0, by the particles
  double contour = 0;  ///< the same of the thickness's contour
  double height = 0;   ///< top of the highest particle within 0.3 L0
};

Deposit deposit_of(const SimulationParts& parts) {
  const double dx = parts.facts.spacing_m;
  const ParticleSet& p = parts.state.grains();
  std::vector<double> thickness;
  Deposit out;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double x = std::max(0.0, p.x[i]);
    add_to_slice(thickness, static_cast<std::size_t>(x / dx),
                 p.mass[i] / parts.state.grains().bulk_density / (dx * 4 * dx));
    if (x < 0.3) out.height = std::max(out.height, p.z[i] + 0.5 * dx);
  }
  out.run_out = reach_along_x(p, dx) - 1;
  out.contour = contour(thickness, dx) - 1;
  return out;
}

/// One friction at all rates, the repose angle of the sands of Lube et al. 2005. Grains of 1 mm
/// where L0 is 10 cm.
Scenario sand(double aspect, int particles_along) {
  Scenario s = column_collapse(aspect, particles_along);
  s.grains->friction.reset();
  s.grains->friction_angle_deg = Uncertain(31);
  s.grains->diameter_m = 0.01;
  s.basal.friction_coefficient = std::tan(31 * degree);
  return s;
}
double sand_run_out(double a) { return a < 2.3 ? 1.2 * a : 1.9 * std::pow(a, 2.0 / 3); }
double sand_height(double a) { return a < 0.7 ? a : std::cbrt(a); }

/// mu(I) of Jop et al. in the grains, their avalanche angle of 27.4 degrees at the rough bed.
Scenario beads(double aspect, int particles_along) {
  Scenario s = column_collapse(aspect, particles_along);
  s.grains->diameter_m = 0.01;
  s.basal.friction_coefficient = std::tan(27.4 * degree);
  return s;
}
/// Slices of discs and spheres, grain by grain and without side walls (docs/physics.md C.3).
double beads_run_out(double a) { return a < 2.3 ? 1.67 * a : 2.7 * std::pow(a, 2.0 / 3); }

/// Even numbers, so that the column ends between the cells of the ground.
struct Case {
  double aspect;
  std::vector<int> particles_along;
  double tolerance;
};
void PrintTo(const Case& c, std::ostream* out) { *out << "aspect " << c.aspect; }
// Taller columns have more particles and fall for longer: coarser, for the same time.
const std::vector<Case> cases{
    {0.5, {10, 14, 20}, 0.2}, {1, {10, 14, 20}, 0.2}, {2, {8, 10, 14}, 0.2}, {5, {6, 8, 10}, 0.35}};

class ColumnCollapse : public testing::TestWithParam<Case> {};

INSTANTIATE_TEST_SUITE_P(Aspects, ColumnCollapse, testing::ValuesIn(cases), [](const auto& i) {
  return fmt::format("{:.0f}Percent", 100 * i.param.aspect);
});

void report_order(const std::string& name, const std::vector<double>& dx,
                  const std::vector<double>& run_out) {
  const Convergence c = observed_convergence(dx, run_out);
  fmt::print("{}: observed order {:.2f}, Richardson limit {:.3f}\n", name, c.order, c.limit);
  testing::Test::RecordProperty("observed_order", fmt::format("{:.3f}", c.order));
  testing::Test::RecordProperty("richardson_limit", fmt::format("{:.4f}", c.limit));
  testing::Test::RecordProperty("monotonic", c.monotonic);
}

TEST_P(ColumnCollapse, SandRunsOutAsExperimentsDo) {
  const Case& c = GetParam();
  std::vector<double> dx, run_out;
  for (const int n : c.particles_along) {
    const Finished f = run(sand(c.aspect, n));
    const Deposit d = deposit_of(f.simulation.parts());
    const std::string name = fmt::format("V8b collapse, sand, a {}, {} along", c.aspect, n);
    expect_within(relative(name, "run-out / L0", d.run_out, sand_run_out(c.aspect), c.tolerance),
                  f);
    expect_within(relative(name + ", height", "h / L0", d.height, sand_height(c.aspect), 0.2), f);
    record(relative(name + ", contour", "run-out / L0", d.contour, sand_run_out(c.aspect)), f);
    expect_conserved(name, f);
    dx.push_back(f.simulation.parts().facts.spacing_m);
    run_out.push_back(d.run_out);
  }
  report_order(fmt::format("V8b collapse, sand, a {}", c.aspect), dx, run_out);
}

TEST_P(ColumnCollapse, BeadsRunOutAsSimulatedGrainByGrain) {
  const Case& c = GetParam();
  const int n = c.particles_along.back();
  const Finished f = run(beads(c.aspect, n));
  const Deposit d = deposit_of(f.simulation.parts());
  const std::string name = fmt::format("V8b collapse, beads, a {}, {} along", c.aspect, n);
  expect_within(relative(name, "run-out / L0", d.run_out, beads_run_out(c.aspect), c.tolerance), f);
  record(relative(name + ", contour", "run-out / L0", d.contour, beads_run_out(c.aspect)), f);
  expect_conserved(name, f);
}

/// Tall columns: the run-out goes with a^(2/3) in the experiments beyond a = 2.3.
TEST(ColumnCollapse, ExponentOfTallColumnsIsReported) {
  std::map<double, double> run_out;
  std::optional<Finished> last;
  for (const double a : {2.5, 10.0}) {
    last.emplace(run(sand(a, 6)));
    run_out[a] = deposit_of(last->simulation.parts()).run_out;
    expect_conserved(fmt::format("V8b collapse, sand, a {}, 6 along", a), *last);
  }
  const double exponent = std::log(run_out[10] / run_out[2.5]) / std::log(4.0);
  record({"V8b collapse, sand, 6 along, exponent", "between a 2.5 and 10", exponent, 2.0 / 3,
          exponent - 2.0 / 3},
         *last);
}

/// The viscosity gives way to the friction where grains flow: half of it changes little.
TEST(ColumnCollapse, ViscosityIsReported) {
  for (const double viscosity : {0.05, 0.2}) {
    Scenario s = sand(1, 14);
    s.numerics.artificial_viscosity = viscosity;
    const Finished f = run(s);
    const std::string name =
        fmt::format("V8b collapse, sand, a 1, 14 along, viscosity {}", viscosity);
    record(
        relative(name, "run-out / L0", deposit_of(f.simulation.parts()).run_out, sand_run_out(1)),
        f);
    expect_conserved(name, f);
  }
}

}  // namespace
}  // namespace sturz::test
