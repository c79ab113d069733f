// SPDX-License-Identifier: Apache-2.0
// V22: a column of glass beads collapses in a viscous liquid (Rondon et al. 2011). Loose, it
// tightens, its pore pressure rises and it runs far; dense, it loosens and is held by suction.
#include "tests/physics/coupled/coupled_books.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

namespace sturz::test {
namespace {

/// L_0 = 6 cm, beads of 225 um and 2500 kg/m^3 in 12 mPa s; 4.8 cm high at a fraction of 0.55 or
/// 4.2 cm at 0.60. Critical fraction 0.58, slope of the dilatancy 4 (Pailha & Pouliquen 2009).
ImmersedGrains column(bool dense, double spacing) {
  ImmersedGrains g;
  g.spacing = spacing;
  g.solid_fraction = dense ? 0.60 : 0.55;
  g.grain_length = 0.06, g.grain_height = dense ? 0.042 : 0.048;
  g.liquid_length = 0.24, g.liquid_height = 0.08;
  g.grain_density = 2500;
  g.viscosity = 0.012;
  g.drag_diameter = 225e-6;
  g.sound_speed = 10 * std::sqrt(g.gravity * g.liquid_height);
  g.walled = true;
  DilatancySettings d;
  d.law.solid_density = g.grain_density;
  d.law.fluid_viscosity = g.viscosity;
  d.law.critical_fraction = 0.58;
  d.law.grain_diameter = g.drag_diameter;
  d.reference_fraction = g.solid_fraction;
  d.slope = 4;
  g.dilatancy = d;
  return g;
}

/// x that 98 % of the grains have not passed [m].
double front(const ParticleSet& p) {
  std::vector<double> x = p.x;
  std::sort(x.begin(), x.end());
  return x[static_cast<std::size_t>(0.98 * static_cast<double>(x.size()))];
}

/// Of the lowest layer in the middle of the column [Pa].
double pore_pressure(const State& s, const ImmersedGrains& g) {
  const MovingSet& p = s.sets[1];
  double sum = 0, n = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (p.z[i] > g.spacing || std::abs(p.x[i] - 0.5 * g.grain_length) > 0.01) continue;
    sum += pressure_of(p, i) - g.liquid_density * g.gravity * (g.liquid_height - p.z[i]);
    ++n;
  }
  return sum / n;
}

struct Collapse {
  double run_out = 0;   ///< front - L_0 [m]
  double pressure = 0;  ///< excess, mean over the first half second [Pa]
};
Collapse collapse(bool dense, double spacing, double end) {
  const ImmersedGrains g = column(dense, spacing);
  HandMade made = immersed(g);
  const std::string name = fmt::format("V22 {} column, dx {:.0f} mm, {} s",
                                       dense ? "dense" : "loose", 1000 * spacing, end);
  double pressure = 0, n = 0, next = 0;
  while (made.state.time < end) {
    made.advance();
    if (made.state.time > 0.05 && made.state.time < 0.5)
      pressure += pore_pressure(made.state, g), ++n;
    if (made.state.time < next) continue;
    next += end / 10;
    fmt::print("{} at {:.2f} s: front {:.1f} mm, pore pressure {:+.0f} Pa, fastest {:.3f} m/s\n",
               name, made.state.time, 1000 * front(made.state.sets[0]),
               pore_pressure(made.state, g), made.state.sets[0].motion.max_speed);
  }
  expect_coupled_books(name, made.state);
  return {front(made.state.sets[0]) - g.grain_length, pressure / n};
}

/// The first quarter of a second, in which the pore pressure decides. With STURZ_COUPLED_LONG until
/// both are at rest, as docs/studies/liquid_among_grains.md tells.
TEST(ColumnInLiquid, LooseRunsFartherThanDense) {
  const bool at_rest = std::getenv("STURZ_COUPLED_LONG") != nullptr;
  const double spacing = 0.006;
  const double end = at_rest ? 7 : 0.25;
  const Collapse loose = collapse(false, spacing, end), dense = collapse(true, spacing, end);
  EXPECT_GT(loose.pressure, 0);
  EXPECT_LT(dense.pressure, 0);
  EXPECT_GT(loose.run_out, dense.run_out);
  const std::string name = fmt::format("V22 loose over dense, {} s", end);
  record({name + ", loose", "mm", 1000 * loose.run_out, 0, 0});
  record({name + ", dense", "mm", 1000 * dense.run_out, 0, 0});
  record({name + ", pore pressure, loose", "Pa", loose.pressure, 0, 0});
  record({name + ", pore pressure, dense", "Pa", dense.pressure, 0, 0});
  if (at_rest)
    expect_within({name + ", ratio", "run-outs", loose.run_out / dense.run_out, 2,
                   loose.run_out / dense.run_out - 2, 0.5});
}

}  // namespace
}  // namespace sturz::test
