// SPDX-License-Identifier: Apache-2.0
// V20 for grains in a liquid: momentum of both together, energy, bits.
#include "tests/physics/coupled/coupled_books.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace sturz::test {
namespace {

struct Momentum {
  Vec3 sum{0, 0, 0};
  double scale = 0;  ///< sum of m |v|
};
Momentum momentum_of(const State& s) {
  Momentum out;
  for (const MovingSet& p : s.sets)
    for (std::size_t i = 0; i < p.size(); ++i) {
      const Vec3 v(p.vx[i], p.vy[i], p.vz[i]);
      out.sum += p.mass[i] * v;
      out.scale += p.mass[i] * v.norm();
    }
  return out;
}

/// Takes all but a share of the water from the pores of a half.
void drain(MovingSet& water, double from_x, double saturation) {
  auto& change = water.scalar(fields::density_change);
  for (std::size_t i = 0; i < water.size(); ++i) {
    if (water.x[i] < from_x) continue;
    change[i] = saturation - 1;
    for (auto& t : water.components(fields::stress)) t[i] = 0;
    water.mass[i] *= saturation;
  }
  water.ledger.released_mass = 0;
  for (const double m : water.mass) water.ledger.released_mass += m;
}

/// Water under pressure beside pores that are not full: what pushes their water is as large as what
/// pushes back, whatever little there is. On a bed without friction nothing else acts along x.
TEST(CoupledBooks, PoresThatAreNotFullKeepMomentum) {
  for (const double saturation : {0.6, 0.05}) {
    ImmersedGrains g;
    g.spacing = 0.1;
    g.grain_length = g.liquid_length = 1.2;
    g.friction = 0;
    HandMade made = immersed(g);
    drain(made.state.sets[1], 0.6, saturation);
    advance_to(made, 0.1);
    const Momentum m = momentum_of(made.state);
    EXPECT_GT(m.scale, 0.1);
    for (const int axis : {0, 1}) EXPECT_LT(std::abs(m.sum[axis]), 3e-6 * m.scale) << saturation;
    std::printf("saturation %g: momentum off by %.1e of %.3g N s\n", saturation,
                std::abs(m.sum.x()) / m.scale, m.scale);
  }
}

/// A collapse between walls into shallow water.
ImmersedGrains dam() {
  ImmersedGrains g;
  g.spacing = 0.1;
  g.grain_length = 0.6, g.grain_height = 0.8;
  g.liquid_length = 1.2, g.liquid_height = 0.8;
  g.walled = true;
  return g;
}

/// Energy of both sets while a wet mass comes down: no work is forgotten, whatever drag does to
/// what ground and walls push.
TEST(CoupledBooks, EnergyOfACollapseIsAccountedFor) {
  for (const double diameter : {1e-4, 1e-3, 2e-2}) {
    ImmersedGrains g = dam();
    g.drag_diameter = diameter;
    HandMade made = immersed(g);
    advance_to(made, 0.5);
    expect_coupled_books("collapse in water, drag diameter " + std::to_string(diameter),
                         made.state);
  }
}

std::vector<double> run_on(int threads) {
  ImmersedGrains g = dam();
  g.threads = threads;
  HandMade made = immersed(g);
  for (int n = 0; n < 150; ++n) made.advance();
  std::vector<double> out;
  for (const MovingSet& p : made.state.sets) {
    std::vector<double> values(6 * p.size());
    for (std::size_t i = 0; i < p.size(); ++i) {
      double* at = &values[std::size_t{6} * p.id[i]];
      at[0] = p.x[i], at[1] = p.y[i], at[2] = p.z[i];
      at[3] = p.vx[i], at[4] = p.vy[i], at[5] = p.vz[i];
    }
    out.insert(out.end(), values.begin(), values.end());
    out.push_back(p.ledger.contact_work);
    out.push_back(p.ledger.drag_loss);
    out.push_back(p.ledger.exchange_work);
  }
  return out;
}

TEST(CoupledBooks, BitsDoNotKnowTheNumberOfThreads) { EXPECT_EQ(run_on(2), run_on(1)); }

}  // namespace
}  // namespace sturz::test
