// SPDX-License-Identifier: Apache-2.0
#include "engine/effects/liquid/update.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace sturz {
namespace {

LiquidSettings settings(double exponent = 7) {
  LiquidSettings g;
  g.sound_speed = 30;
  g.exponent = exponent;
  return g;
}

/// What the energies of several steps add up to, with what is stored at the end.
LiquidEnergies advance(LiquidParticle& p, const LiquidSettings& g, double dt, int steps) {
  const LiquidUpdate update(g, dt);
  LiquidEnergies sums;
  for (int n = 0; n < steps; ++n) {
    sums.elastic = 0;
    update.apply(p, sums);
  }
  return sums;
}

void compress(LiquidParticle& p, double rate) {
  for (double& l : p.l) l = 0;
  p.l[0] = p.l[4] = p.l[8] = -rate / 3;
}

void shear(LiquidParticle& p, double rate) {
  for (double& l : p.l) l = 0;
  p.l[2] = rate;
}

double tau_of(const LiquidParticle& p) { return std::sqrt(p.s.norm2()); }

class Tait : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Exponents, Tait, testing::Values(7.0, 4.4, 1.5));

TEST_P(Tait, PressureIsTheDerivativeOfTheStoredEnergy) {
  const LiquidSettings g = settings(GetParam());
  for (const double e : {1e-4, 1e-3, 0.02, 0.3}) {
    double integral = 0;  // of P/rho^2 d(rho), by Simpson's rule
    const int n = 2000;
    for (int k = 0; k < n; ++k) {
      const auto f = [&](double at) {
        return g.pressure_at(at) / (g.reference_density * (1 + at) * (1 + at));
      };
      const double a = e * k / n, b = e * (k + 1) / n;
      integral += (b - a) / 6 * (f(a) + 4 * f((a + b) / 2) + f(b));
    }
    EXPECT_NEAR(g.stored_at(e) / integral, 1, 1e-6) << e;
  }
}

TEST_P(Tait, DensityThatCarriesAPressureIsItsInverse) {
  const LiquidSettings g = settings(GetParam());
  for (const double e : {1e-5, 1e-3, 0.1, 0.5})
    EXPECT_NEAR(g.density_change_at(g.pressure_at(e)) / e, 1, 1e-10) << e;
  EXPECT_EQ(g.density_change_at(0), 0);
  EXPECT_EQ(g.density_change_at(-5), 0);
}

TEST_P(Tait, SoundTravelsAtItsSpeed) {
  const LiquidSettings g = settings(GetParam());
  const double e = 1e-6;
  EXPECT_NEAR(g.pressure_at(e) / (g.reference_density * e), 30 * 30, 0.01);
}

TEST(LiquidUpdate, DensityFollowsTheContinuityEquation) {
  LiquidParticle p;
  compress(p, 0.05);
  advance(p, settings(), 1e-3, 2000);
  EXPECT_NEAR(1 + p.e, std::exp(0.1), 1e-5);
}

/// There and back: what was put in comes out again, and on the way it is the integral of P dV.
TEST(LiquidUpdate, CompressionIsStoredAndGivenBack) {
  const LiquidSettings g = settings();
  const double dt = 1e-4;
  LiquidParticle p;
  compress(p, 0.4);
  double by_pressure = 0, volume = 1, pressure = 0;
  LiquidEnergies there;
  for (int n = 0; n < 2000; ++n) {
    const LiquidEnergies step = advance(p, g, dt, 1);
    const double now = g.pressure_at(p.e), smaller = 1 / (1 + p.e);
    by_pressure += 0.5 * (pressure + now) * (volume - smaller);
    pressure = now, volume = smaller;
    there.power += step.power, there.viscous += step.viscous;
    there.elastic = step.elastic;
  }
  EXPECT_NEAR(there.power / by_pressure, 1, 1e-4);
  EXPECT_NEAR(there.elastic / by_pressure, 1, 1e-4);
  EXPECT_NEAR(there.viscous, 0, 1e-12 * by_pressure);
  compress(p, -0.4);
  const LiquidEnergies back = advance(p, g, dt, 2000);
  EXPECT_NEAR(p.e, 0, 1e-12);
  EXPECT_NEAR(back.power / there.power, -1, 1e-9);
}

/// Whatever the motion, energies of all steps close, and flow only ever takes.
TEST(LiquidUpdate, WorkIsStoredOrDissipated) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(-1, 1);
  for (const HerschelBulkley& law :
       {HerschelBulkley{0, 0.001, 1}, HerschelBulkley{500, 20, 1}, HerschelBulkley{200, 50, 0.4}}) {
    LiquidSettings g = settings();
    g.law = law;
    LiquidParticle p;
    double power = 0, viscous = 0, diffused = 0, stored = 0, outside = 0, least = 0;
    const double dt = 2e-4;
    for (int turn = 0; turn < 60; ++turn) {
      for (double& l : p.l) l = 4 * u(random);
      p.diffusion = 0.02 * u(random);
      for (int n = 0; n < 50; ++n) {
        const Symmetric s = p.s;
        const double e = p.e;
        const LiquidEnergies step = advance(p, g, dt, 1);
        const double trace = p.l[0] + p.l[4] + p.l[8];
        // V sigma : D dt by itself, deviators in the middle of the step, V = m/(rho_0 (1 + e)).
        const Symmetric d{p.l[0] - trace / 3,      p.l[4] - trace / 3,
                          p.l[8] - trace / 3,      0.5 * (p.l[1] + p.l[3]),
                          0.5 * (p.l[5] + p.l[7]), 0.5 * (p.l[2] + p.l[6])};
        outside += 0.5 * dt * (s.dot(d) + p.s.dot(d)) -
                   dt * trace * 0.5 * (g.pressure_at(e) / (1 + e) + g.pressure_at(p.e) / (1 + p.e));
        power += step.power, viscous += step.viscous, diffused += step.diffusion;
        stored = step.elastic;
        least = std::min(least, step.viscous);
      }
    }
    EXPECT_NEAR(stored + viscous, power + diffused, 1e-9 * (stored + viscous));
    EXPECT_NEAR(power / outside, 1, 0.03) << law.consistency;
    EXPECT_GT(viscous, 0);
    EXPECT_GT(least, -0.01 * viscous);
  }
}

TEST(LiquidUpdate, SteadyShearHasTheStressOfItsLawAndHeatsByIt) {
  for (const HerschelBulkley& law : {HerschelBulkley{0, 0.001, 1}, HerschelBulkley{0, 30, 1},
                                     HerschelBulkley{300, 30, 1}, HerschelBulkley{100, 40, 0.5}})
    for (const double dt : {1e-4, 1e-3}) {
      LiquidSettings g = settings();
      g.law = law;
      LiquidParticle p;
      const double rate = 2;
      shear(p, rate);
      advance(p, g, dt, static_cast<int>(3 / dt));
      const LiquidEnergies sums = advance(p, g, dt, 100);
      // The stress turns by rate dt/2 within a step, and lags by tau/G.
      EXPECT_NEAR(tau_of(p) / law.stress(rate), 1, 2e-3);
      EXPECT_NEAR(p.s.zx / law.stress(rate), 1, 3e-3);
      EXPECT_NEAR(sums.viscous / (law.stress(rate) * rate * 100 * dt), 1, 5e-3);
    }
}

TEST(LiquidUpdate, HoldsItsYieldStressAtRestAndTurnsItWithTheMass) {
  LiquidSettings g = settings();
  g.law = {200, 5, 1};
  LiquidParticle p;
  p.s = {50, -20, -30, 40, 10, 60};
  p.e = 1e-3;
  const double tau = tau_of(p);
  ASSERT_LT(tau, 200);
  p.l[1] = -3, p.l[3] = 3;  // a rotation about z
  const LiquidEnergies sums = advance(p, g, 1e-3, 2000);
  EXPECT_NEAR(tau_of(p), tau, 1e-9 * tau);
  EXPECT_NEAR(sums.viscous, 0, 1e-9);
  EXPECT_NEAR(p.s.zz, -30, 1e-9);
}

TEST(LiquidUpdate, PullsAtNothing) {
  const LiquidSettings g = settings();
  LiquidParticle p;
  p.e = 0.01;
  compress(p, -5);
  advance(p, g, 1e-3, 1000);
  EXPECT_EQ(g.pressure_at(p.e), 0);
  EXPECT_EQ(p.e, LiquidSettings::separation_threshold);
  EXPECT_EQ(tau_of(p), 0);
  // It comes back as it went: pressure after 2 % of compression, not at once.
  compress(p, 5);
  advance(p, g, 1e-3, 3);
  EXPECT_EQ(g.pressure_at(p.e), 0);
  advance(p, g, 1e-3, 3);
  EXPECT_GT(g.pressure_at(p.e), 0);
}

/// In pores 1 + e is the saturation: as low as it gets, but not diffused away.
TEST(LiquidUpdate, SaturationIsKeptAndBounded) {
  const LiquidSettings g = settings();
  LiquidParticle p;
  p.grain_share = 1.5;
  p.e = -0.4;
  p.diffusion = 3;
  advance(p, g, 1e-3, 500);
  EXPECT_EQ(p.e, -0.4);
  compress(p, -50);
  advance(p, g, 1e-2, 1000);
  EXPECT_NEAR(p.e, -0.95, 1e-12);
}

/// Grains that flow in push the liquid out of the same space.
TEST(LiquidUpdate, GrainsThatComeInCompressIt) {
  LiquidParticle p;
  p.grain_share = 1;
  p.slip_divergence = -0.01;
  advance(p, settings(), 1e-4, 1);
  EXPECT_NEAR(p.e, 1e-4 * 2 * 0.01, 1e-12);
}

TEST(LiquidUpdate, LeastDensityHasNoJumps) {
  EXPECT_EQ(least_density_change(0), LiquidSettings::separation_threshold);
  EXPECT_NEAR(least_density_change(0.3 / 0.7), -0.95, 1e-12);
  EXPECT_EQ(least_density_change(1e9), -0.95);
  double last = least_density_change(0);
  for (double x = 0; x < 3; x += 1e-4) {
    const double now = least_density_change(x);
    ASSERT_LE(now, last);
    ASSERT_GT(now, last - 5e-4);
    last = now;
  }
}

/// The thinner it is spread, the less shear it carries: the same at any step, whether it flows
/// within a step (water) or over many (a stiff mud).
TEST(LiquidUpdate, ShearOfSprayDoesNotDependOnTheStep) {
  for (const HerschelBulkley& law :
       {HerschelBulkley{0, 0.001, 1}, HerschelBulkley{0, 2000, 1}, HerschelBulkley{400, 100, 0.6}})
    for (const double dt : {1e-5, 1e-4, 1e-3}) {
      LiquidSettings g = settings();
      g.law = law;
      LiquidParticle p;
      p.e = 0.5 * LiquidSettings::separation_threshold;
      shear(p, 1);
      advance(p, g, dt, static_cast<int>(0.3 / dt));
      EXPECT_NEAR(tau_of(p) / (0.5 * law.stress(1)), 1, 0.01) << law.consistency << " " << dt;
    }
}

/// What evens out noise of the density fades where there are pores that are not full; a trace of
/// grains is no pore.
TEST(LiquidUpdate, DiffusionFadesWithTheGrains) {
  const LiquidSettings g = settings();
  const LiquidUpdate update(g, 1e-3);
  const auto after = [&](double share, double e) {
    LiquidParticle p;
    p.grain_share = share, p.e = e, p.diffusion = 3;
    LiquidEnergies out;
    update.apply(p, out);
    return p.e;
  };
  EXPECT_NEAR(after(0, -0.01), -0.007, 1e-12);
  double last = after(0, -0.01);
  for (double share = 0; share < 0.2; share += 1e-3) {
    EXPECT_LT(std::abs(after(share, -0.01) - last), 4e-5) << share;
    last = after(share, -0.01);
  }
  EXPECT_NEAR(after(0.2, -0.01), -0.01, 1e-12) << "air in pores stays";
  EXPECT_NEAR(after(0.2, 0.01), 0.013, 1e-12) << "full pores are as any liquid";
}

}  // namespace
}  // namespace sturz
