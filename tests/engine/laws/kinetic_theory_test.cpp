// SPDX-License-Identifier: Apache-2.0
#include "engine/laws/kinetic_theory.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace sturz {
namespace {

constexpr double pi = std::numbers::pi;

/// docs/physics.md V10, V11: d = 10 mm, alpha_max = 0.63.
KineticTheory grains(double restitution) {
  KineticTheory law;
  law.grain_density = 2600;
  law.grain_diameter = 0.01;
  law.restitution = restitution;
  law.max_fraction = 0.63;
  return law;
}

TEST(KineticTheory, EqualsTheExpandedForms) {
  // The brackets multiplied out, as the other common way of writing them has it; theta shown.
  for (double e : {0.7, 0.8, 0.9, 0.99})
    for (double a : {1e-4, 0.02, 0.1, 0.3, 0.5, 0.6}) {
      const KineticTheory law = grains(e);
      const double rho = law.grain_density, d = law.grain_diameter, theta = 0.37;
      const double g0 = 1 / (1 - std::pow(a / law.max_fraction, 1.0 / 3)), e1 = 1 + e;
      const double root = std::sqrt(theta * pi), collisional = std::sqrt(theta / pi);
      const double lambda = 4.0 / 3 * a * a * rho * d * g0 * e1 * collisional;
      const double mu = 0.8 * a * a * rho * d * g0 * e1 * collisional +
                        10 * rho * d * root / (96 * e1 * g0) + rho * d * root * a / 6 +
                        rho * d * root * e1 * g0 * a * a / 15;
      const double k = 150 * rho * d * root / (384 * e1 * g0) + 15.0 / 16 * rho * d * root * a +
                       9.0 / 16 * rho * d * root * e1 * g0 * a * a +
                       2 * a * a * rho * d * g0 * e1 * collisional;
      const double gamma =
          12 * (1 - e * e) * a * a * rho * g0 * std::pow(theta, 1.5) / (d * std::sqrt(pi));
      const KineticCoefficients c = kinetic_coefficients(law, a);
      const double s = std::sqrt(theta);
      EXPECT_NEAR(c.radial, g0, 1e-12 * g0);
      EXPECT_NEAR(c.pressure, a * rho + 2 * rho * e1 * a * a * g0, 1e-12 * c.pressure);
      EXPECT_NEAR(c.bulk_viscosity * s, lambda, 1e-12 * lambda);
      EXPECT_NEAR(c.shear_viscosity * s, mu, 1e-12 * mu);
      EXPECT_NEAR(c.conductivity * s, k, 1e-12 * k);
      EXPECT_NEAR(c.dissipation * s * s * s, gamma, 1e-12 * gamma);
    }
}

TEST(KineticTheory, ViscosityIsNotThePapersPrintedOne) {
  // Eq. 17 as printed: 2 sqrt(5 pi)/96, and no 1/((1+e) g0); A.4 has the ratio 3.88.
  KineticTheory law = grains(0.9);
  const double a = 0.3, rho = law.grain_density, d = law.grain_diameter;
  for (double max_fraction : {0.62, 0.63, 0.64}) {
    law.max_fraction = max_fraction;
    const KineticCoefficients c = kinetic_coefficients(law, a);
    const double bracket = 1 + 0.8 * 1.9 * c.radial * a;
    const double printed = 2 * std::sqrt(5 * pi) * rho * d / 96 * bracket * bracket;
    const double kinetic = c.shear_viscosity - 0.6 * c.bulk_viscosity;
    EXPECT_NEAR(printed / kinetic, 2 * std::sqrt(5.0) / 10 * 1.9 * c.radial, 1e-12);
    EXPECT_NEAR(printed / kinetic, 3.88, max_fraction == 0.63 ? 0.005 : 0.1);
  }
}

TEST(KineticTheory, StaysFiniteFromEmptyToBeyondTheDensestPacking) {
  const KineticTheory law = grains(0.7);
  const KineticCoefficients empty = kinetic_coefficients(law, 0);
  EXPECT_EQ(empty.radial, 1);
  EXPECT_EQ(empty.pressure, 0);
  EXPECT_EQ(empty.dissipation, 0);
  EXPECT_NEAR(empty.shear_viscosity, 26 * 10 * std::sqrt(pi) / (96 * 1.7), 1e-9);
  const KineticCoefficients bounded = kinetic_coefficients(law, 0, 1.0);
  EXPECT_GE(bounded.shear_viscosity, 0);
  EXPECT_LT(bounded.shear_viscosity, 1e-6 * empty.shear_viscosity);
  EXPECT_LT(bounded.conductivity, 1e-6 * empty.conductivity);
  const double closest = kinetic_coefficients(law, 0.99 * law.max_fraction).radial;
  EXPECT_NEAR(closest, 1 / (1 - std::cbrt(0.99)), 1e-9);
  double last = 0;
  for (double a = 0.6; a < 0.95; a += 0.01) {
    const KineticCoefficients c = kinetic_coefficients(law, a);
    EXPECT_LE(c.radial, closest * (1 + 1e-12)) << a;
    EXPECT_GT(c.pressure, last) << a;
    last = c.pressure;
  }
}

TEST(KineticTheory, LongestPathBoundsTheDiffusivitiesAndNothingElse) {
  const KineticTheory law = grains(0.8);
  const double longest = 0.05;  // five grains; the mean free path is that at alpha = 0.02
  const auto path = [&](double a) {
    return law.grain_diameter / (6 * std::sqrt(2.0) * a * kinetic_coefficients(law, a).radial);
  };
  double greatest = 0;
  for (double a = 1e-9; a < 0.6; a *= 1.25) {
    const KineticCoefficients c = kinetic_coefficients(law, a, longest);
    const KineticCoefficients f = kinetic_coefficients(law, a);
    EXPECT_EQ(c.pressure, f.pressure);
    EXPECT_EQ(c.bulk_viscosity, f.bulk_viscosity);
    EXPECT_EQ(c.dissipation, f.dissipation);
    if (path(a) <= longest) {
      EXPECT_EQ(c.shear_viscosity, f.shear_viscosity) << a;
      EXPECT_EQ(c.conductivity, f.conductivity) << a;
    } else {
      const double share = longest / path(a), mu_col = 0.6 * f.bulk_viscosity;
      EXPECT_NEAR(c.shear_viscosity - mu_col, share * (f.shear_viscosity - mu_col),
                  1e-12 * f.shear_viscosity);
    }
    if (a < 0.1) greatest = std::max(greatest, c.shear_viscosity / (a * law.grain_density));
  }
  // nu/(longest s) tends to 5 sqrt(2 pi)/(8 (1+e)) and is never much more.
  const double limit = 5 * std::sqrt(2 * pi) / 8 / 1.8 * longest;
  const double thin = kinetic_coefficients(law, 1e-9, longest).shear_viscosity / 2600e-9;
  EXPECT_NEAR(thin, limit, 1e-3 * limit);
  EXPECT_LT(greatest, 1.3 * limit);
  EXPECT_GT(kinetic_coefficients(law, 1e-9).shear_viscosity / 2600e-9, 1e6 * limit);
}

/// Fourth-order reference of ds/dt = a - b s - c s^2.
double by_runge_kutta(double s, double a, double b, double c, double dt, int steps) {
  const auto f = [&](double x) { return a - b * x - c * x * x; };
  const double h = dt / steps;
  for (int n = 0; n < steps; ++n) {
    const double k1 = f(s), k2 = f(s + h / 2 * k1), k3 = f(s + h / 2 * k2), k4 = f(s + h * k3);
    s += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  return s;
}

class Draw {
 public:
  double between(double lo, double hi) {
    return std::uniform_real_distribution<double>(lo, hi)(random_);
  }
  double log_between(double lo, double hi) { return std::exp(between(std::log(lo), std::log(hi))); }

 private:
  std::mt19937 random_{7};
};

TEST(RiccatiStep, AgreesWithAFineReference) {
  Draw draw;
  for (int n = 0; n < 200; ++n) {
    const double s0 = draw.log_between(1e-3, 10), a = draw.log_between(1e-3, 10);
    const double b = draw.between(-3, 5), c = draw.log_between(1e-3, 10);
    const double dt = draw.log_between(1e-3, 1);
    const double stiff = std::abs(b) + 2 * c * std::max(s0, std::sqrt(a / c) + 5 / c);
    const int steps = 100 + static_cast<int>(std::min(100 * stiff * dt, 20000.0));
    const double reference = by_runge_kutta(s0, a, b, c, dt, steps);
    EXPECT_NEAR(riccati_step(s0, a, b, c, dt), reference, 1e-8 * reference)
        << s0 << ' ' << a << ' ' << b << ' ' << c << ' ' << dt;
  }
}

TEST(RiccatiStep, IsNeverNegativeAndNeverNotANumber) {
  Draw draw;
  for (int n = 0; n < 2000; ++n) {
    // One number in four is zero: the corners matter most.
    const auto any = [&](double lo, double hi) {
      return draw.between(0, 1) < 0.25 ? 0.0 : draw.log_between(lo, hi);
    };
    const double s0 = any(1e-12, 1e3), a = any(1e-9, 1e6), c = any(1e-6, 1e6);
    const double sign = draw.between(0, 1) < 0.5 ? -1 : 1, b = sign * any(1e-6, 1e6);
    const double dt = any(1e-9, 1e4), s = riccati_step(s0, a, b, c, dt);
    EXPECT_GE(s, 0) << s0 << ' ' << a << ' ' << b << ' ' << c << ' ' << dt;
  }
  EXPECT_EQ(riccati_step(0, 0, -1, 0, 1e4), 0);
  EXPECT_EQ(riccati_step(0, 0, -1, 2, 1e4), 0);
  EXPECT_EQ(riccati_step(0.3, 2, -1, 4, 0), 0.3);
}

TEST(RiccatiStep, HasTheClosedFormsOfItsLimits) {
  EXPECT_DOUBLE_EQ(riccati_step(0.5, 3, 0, 0, 2), 6.5);
  EXPECT_DOUBLE_EQ(riccati_step(0.5, 0, 0, 3, 2), 0.5 / 4);
  // Fading over 40 e-foldings keeps its digits: nothing cancels.
  EXPECT_NEAR(riccati_step(0.5, 0, 4, 0, 10), 0.5 * std::exp(-40), 1e-12 * 0.5 * std::exp(-40));
  EXPECT_NEAR(riccati_step(0.5, 0, -4, 0, 10), 0.5 * std::exp(40), 1e-12 * 0.5 * std::exp(40));
  EXPECT_NEAR(riccati_step(0.5, 3, 4, 0, 0.2), 0.75 + (0.5 - 0.75) * std::exp(-0.8), 1e-15);
  // Production and dissipation without b: sqrt(a/c) tanh.
  EXPECT_NEAR(riccati_step(0, 3, 0, 2, 0.1), std::sqrt(1.5) * std::tanh(std::sqrt(6.0) * 0.1),
              1e-15);
  // Slow ends: continuous where the root vanishes.
  const double at = riccati_step(0.5, 0, 0, 3, 2);
  for (double small : {1e-3, 1e-6, 1e-9, 1e-15, 1e-100, 1e-200})
    EXPECT_NEAR(riccati_step(0.5, small, small, 3, 2), at, 3 * small + 1e-16) << small;
}

TEST(RiccatiStep, TwoHalvesMakeAWhole) {
  Draw draw;
  for (int n = 0; n < 200; ++n) {
    const double s0 = draw.log_between(1e-3, 10), a = draw.log_between(1e-3, 10);
    const double b = draw.between(-3, 5), c = draw.log_between(1e-3, 10), dt = draw.between(0, 9);
    const double whole = riccati_step(s0, a, b, c, dt);
    const double halves = riccati_step(riccati_step(s0, a, b, c, dt / 3), a, b, c, 2 * dt / 3);
    EXPECT_NEAR(halves, whole, 1e-12 * whole);
  }
}

TEST(KineticTheory, CoolsByHaffsLawAtAnyTimeStep) {  // V10
  const struct {
    double fraction, restitution, tau;
  } published[] = {{0.2, 0.9, 0.37061}, {0.05, 0.8, 1.40382}, {0.4, 0.95, 0.15965}};
  for (const auto& [a, e, tau_published] : published) {
    const KineticTheory law = grains(e);
    const KineticCoefficients k = kinetic_coefficients(law, a);
    const double theta0 = 0.01;
    const double tau =
        law.grain_diameter * std::sqrt(pi) / (4 * (1 - e * e) * a * k.radial * std::sqrt(theta0));
    EXPECT_NEAR(tau, tau_published, 5e-6);
    const double c = k.dissipation / (3 * a * law.grain_density);
    for (double share : {0.01, 0.1, 1.0, 10.0, 100.0}) {
      double s = std::sqrt(theta0), t = 0;
      for (int n = 0; n < 100; ++n) {
        s = riccati_step(s, 0, 0, c, share * tau);
        t += share * tau;
        const double haff = theta0 / ((1 + t / tau) * (1 + t / tau));
        ASSERT_NEAR(s * s, haff, 1e-6 * haff) << a << " after " << n << " steps of " << share;
        ASSERT_NEAR(s * s, haff, 1e-12 * haff) << "round-off only";
      }
    }
  }
}

/// Granular temperature of grains that are sheared at a constant fraction until it is steady.
double sheared_to_rest(const KineticTheory& law, double a, double rate, double dt, double s) {
  const KineticCoefficients k = kinetic_coefficients(law, a);
  const double mass = 3 * a * law.grain_density;
  // 2 D':D' is the square of the rate in simple shear.
  for (int n = 0; n < 5000; ++n)
    s = riccati_step(s, k.shear_viscosity * rate * rate / mass, 0, k.dissipation / mass, dt);
  return s * s;
}

TEST(KineticTheory, ShearedGrainsReachTheClosedFormSteadyState) {  // V11
  const struct {
    double fraction, temperature, pressure, ratio;
  } published[] = {{0.1, 3.4827, 0.6369, 0.286},
                   {0.2, 1.3969, 0.9475, 0.282},
                   {0.3, 1.0492, 1.9525, 0.291},
                   {0.4, 0.93119, 4.4018, 0.299},
                   {0.5, 0.87692, 11.674, 0.305}};
  const KineticTheory law = grains(0.9);
  const double rate = 13, scale = rate * law.grain_diameter;
  for (const auto& [a, temperature, pressure, ratio] : published)
    for (double dt : {1e-3, 0.1}) {
      const double theta = sheared_to_rest(law, a, rate, dt, dt < 0.01 ? 0.0 : 2.0);
      const KineticCoefficients k = kinetic_coefficients(law, a);
      const double p = k.pressure * theta, tau = k.shear_viscosity * std::sqrt(theta) * rate;
      EXPECT_NEAR(theta / (scale * scale), temperature, 1e-3 * temperature) << a;
      EXPECT_NEAR(p / (law.grain_density * scale * scale), pressure, 1e-3 * pressure) << a;
      EXPECT_NEAR(tau / p, ratio, 5e-4) << a;  // three digits are published
    }
}

}  // namespace
}  // namespace sturz
