// SPDX-License-Identifier: Apache-2.0
// SamosAT's bed and a least shear stress beside Voellmy: hand values, and one column down a slope
// beside its ordinary differential equation.
#include "engine/core/constants.hpp"
#include "engine/effects/fields.hpp"
#include "tests/support/hand_made.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace sturz {
namespace {

using test::HandMade;

constexpr double g = standard_gravity, density = 1560;

BasalResistance samosat() {
  BasalResistance b;
  b.samosat = true;
  b.friction_coefficient = 0.155;
  return b;
}

TEST(SamosAtBed, HandValues) {
  const BasalResistance b = samosat();
  // 30 m/s, 2 m thick, g_n = 8: R_s = 900/16 = 56.25.
  EXPECT_NEAR(b.slowness(30, 8, 2), 1 + 0.222 / (0.222 + 56.25), 1e-15);
  EXPECT_NEAR(b.plastic(8, 2, 200, 30), 0.155 * 8 * 1.0039311516, 1e-9);
  EXPECT_EQ(b.slowness(0, 8, 2), 2) << "twice the friction at rest";
  // ln(2/0.05)/0.43 + 4.13 = 8.57878943 + 4.13 = 12.70878943
  EXPECT_NEAR(b.rate(30, 2, 200, g), 30 / (2 * 12.70878943 * 12.70878943), 1e-9);
  EXPECT_NEAR(b.rate(30, 0.02, 200, g), 30 / (0.02 * 4.13 * 4.13), 1e-9)
      << "thinner than the roughness";
  EXPECT_TRUE(b.has_rate());
  EXPECT_EQ(b.slowness(30, 0, 2), 1) << "a column in the air";
}

/// Speed after `time` of du/dt = pull - brake(u), by small steps of fourth order.
double solved(double u, double time, const std::function<double(double)>& change) {
  const int n = 4000;
  const double dt = time / n;
  for (int i = 0; i < n; ++i) {
    const double a = change(u), b = change(u + 0.5 * dt * a), c = change(u + 0.5 * dt * b),
                 d = change(u + dt * c);
    u += dt / 6 * (a + 2 * b + 2 * c + d);
  }
  return u;
}

struct Slide {
  double speed, expected;
};

/// A column alone spreads over its support: of so much it is some metres thick.
constexpr double set_down = 40;

/// One column from speed u0 along a slope of 0.5, and the equation of its own thickness.
Slide slide(const BasalResistance& bed, double u0, double time, double step) {
  constexpr double slope = 0.5;
  const double cos = 1 / std::sqrt(1 + slope * slope), sin = slope * cos;
  DepthAveragedSettings s;
  s.bed[0] = bed;
  HandMade made = test::columns_on(test::even_ground(400, slope), {{-190, 0, 0}}, set_down,
                                   {u0 * cos, 0, -u0 * sin}, {}, s);
  while (made.state.time < time - 1e-9)
    made.step.apply(made.state, std::min(time - made.state.time, step));
  const MovingSet& p = made.state.grains();
  const double h = p.scalar(fields::thickness)[0];
  const double at = made.state.time - 0.5 * made.state.previous_dt;  // where its speed stands
  const double expected = solved(u0, at, [&](double u) {
    return g * sin - bed.plastic(g * cos, h, density, u) - u * bed.rate(u, h, density, g);
  });
  return {std::hypot(p.vx[0], p.vz[0]), expected};
}

TEST(SamosAtBed, AColumnFollowsItsEquation) {
  double coarse = 0;
  for (const double step : {0.04, 0.02, 0.01}) {
    const Slide s = slide(samosat(), 1, 6, step);
    EXPECT_NEAR(s.speed, s.expected, 0.1 * step * s.expected) << "of first order in " << step;
    EXPECT_GT(s.expected, 10);
    const double error = std::abs(s.speed - s.expected);
    if (coarse > 0) {
      EXPECT_LT(error, 0.75 * coarse) << step;
    }
    coarse = error;
  }
}

TEST(SamosAtBed, SlowMassStopsWhereFastMassRuns) {
  // Slope 0.25 between mu and 2 mu: what starts slowly stays, what is fast goes on.
  DepthAveragedSettings s;
  s.bed[0] = samosat();
  const auto speed_after = [&](double u0) {
    HandMade made = test::columns_on(test::even_ground(400, 0.25), {{-190, 0, 0}}, set_down,
                                     {u0, 0, -0.25 * u0}, {}, s);
    while (made.state.time < 4) made.step.apply(made.state, 0.02);
    return std::abs(made.state.grains().vx[0]);
  };
  EXPECT_EQ(speed_after(0.5), 0);
  EXPECT_GT(speed_after(8), 8);
}

/// tau = tau_0 + mu sigma + rho g u^2/xi: cohesion is that least shear stress, at any speed.
TEST(LeastShearStress, CohesionStandsBesideVoellmy) {
  BasalResistance b{0.155, 0, 500};
  b.turbulent_coefficient = 2000;
  // 1.2 m of 200 kg/m3 at 20 m/s under g_n = 9: 500/240 + 1.395 + 9.80665*400/2400
  EXPECT_NEAR(b.plastic(9, 1.2, 200, 20) + 20 * b.rate(20, 1.2, 200, g),
              500 / 240.0 + 0.155 * 9 + g * 400 / (2000 * 1.2), 1e-12);
  EXPECT_EQ(b.plastic(9, 1.2, 200, 0), b.plastic(9, 1.2, 200, 20)) << "at rest and in motion";
  const Slide s = slide(b, 1, 5, 0.01);
  EXPECT_NEAR(s.speed, s.expected, 2e-3 * s.expected);
}

TEST(LeastShearStress, HoldsAColumnThatFrictionWouldNot) {
  struct End {
    double gain, thickness, speed;
  };
  const auto after = [&](double tau_0) {
    DepthAveragedSettings s;
    s.bed[0] = {0.155, 0, tau_0};
    s.bed[0].turbulent_coefficient = 2000;
    HandMade made =
        test::columns_on(test::even_ground(60, 0.5), {{-10, 0, 0}}, set_down, {0, 0, 0}, {}, s);
    // Its first steps still know the thickness that it was set down with.
    const MovingSet& p = made.state.grains();
    for (int i = 0; i < 20; ++i) made.step.apply(made.state, 0.01);
    const double first = p.vx[0];
    for (int i = 0; i < 9; ++i) made.step.apply(made.state, 0.01);
    return End{p.vx[0] - first, p.scalar(fields::thickness)[0], p.vx[0]};
  };
  // What it takes: rho h g (sin - mu cos).
  const double h = after(1e9).thickness;
  const double least = density * h * g * (0.5 - 0.155) / std::sqrt(1.25);
  EXPECT_GT(after(0.98 * least).speed, 0);
  EXPECT_LT(after(0.98 * least).gain, 0.1 * after(0).gain);
  EXPECT_EQ(after(1.02 * least * set_down / h).speed, 0);
  EXPECT_GT(after(0).speed, 0.2);
}

}  // namespace
}  // namespace sturz
