// SPDX-License-Identifier: Apache-2.0
// The pore pressure of a dilating mixture against independent integrations of the same equations.
#include "engine/laws/pore_pressure.hpp"

#include "tests/support/wet_box.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace sturz {
namespace {

using test::flume_mixture;
using test::WetBox;

constexpr double g = standard_gravity;

MixtureLaw permeable() {  // k = 1e-8 m^2 at m = 0.61
  MixtureLaw law = flume_mixture();
  law.permeability = 1e-8, law.reference_fraction = 0.61, law.compressibility = 0.02;
  return law;
}

constexpr std::array times{0.1, 0.5, 1.0, 2.0, 5.0};

TEST(PorePressure, T1RelaxesAtRestWithFrozenCoefficients) {
  WetBox box(permeable(), 0.61);
  const double start = 0.5 * (box.law.density(0.61) - box.law.fluid_density) * g;
  box.excess = start;
  const PoreRates r = box.rates(0, false);
  EXPECT_NEAR(r.decay, 1.04385, 5e-6);
  EXPECT_NEAR(r.compaction, 4.0e-6, 1e-12);
  EXPECT_EQ(r.source, 0);
  const double ratio[] = {0.900878, 0.593376, 0.352096, 0.123971, 0.005411};
  const double fraction[] = {0.61111021, 0.61456723, 0.61729347, 0.61988217, 0.62123184};
  for (std::size_t k = 0; k < times.size(); ++k) {
    const PoreChange c = advance(r, start, times[k]);
    EXPECT_NEAR(c.excess / start, ratio[k], 6e-7);
    EXPECT_NEAR(0.61 * std::exp(r.compaction * c.mean_excess * times[k]), fraction[k], 6e-9);
    // In pieces the same: there is no step.
    double excess = start;
    for (int piece = 0; piece < 7; ++piece) excess = advance(r, excess, times[k] / 7).excess;
    EXPECT_NEAR(excess, c.excess, 1e-12 * start);
  }
}

TEST(PorePressure, T1RelaxesAtRestWithTheCoefficientsThatItHas) {
  WetBox box(permeable(), 0.61);
  const double start = 0.5 * (box.law.density(0.61) - box.law.fluid_density) * g;
  box.excess = start;
  const double ratio[] = {0.897951, 0.551537, 0.273617, 0.058413, 0.000462};
  const double fraction[] = {0.61109484, 0.61424863, 0.61632509, 0.61773447, 0.61808959};
  const double dt = 1e-3;
  int n = 0;
  for (std::size_t k = 0; k < times.size(); ++k) {
    for (; n < static_cast<int>(std::lround(times[k] / dt)); ++n) box.drain(0, dt);
    EXPECT_NEAR(box.excess / start, ratio[k], 2e-4 * ratio[k] + 2e-6) << times[k];
    EXPECT_NEAR(box.m, fraction[k], 2e-6) << times[k];
  }
}

TEST(PorePressure, T2ReachesTheSteadyPressureOfImposedShear) {
  const WetBox box(permeable(), 0.62);
  const PoreRates r = box.rates(0.1, false);
  const double steady = advance(r, 0, 1e3).excess;
  EXPECT_NEAR(steady, 1280.71, 0.01 * 1280.71 * 0.01);
  const WetColumn c = box.column();
  const double tan_psi = dilatancy(box.law, 0.62, 0.2, c.effective_stress()).tangent;
  const double limit = -box.law.fluid_viscosity * 0.1 * tan_psi / box.law.permeability_at(0.62);
  EXPECT_NEAR(limit, 1270.86, 0.13);
  EXPECT_NEAR(steady, limit, 0.01 * limit);
}

TEST(PorePressure, T3LiquefiesLooseAndDrawsInDenseMixturesUnderImposedShear) {
  struct Row {
    double m;
    std::array<double, 6> lambda;
  };
  const Row rows[] = {{0.55, {.682, .9364, 1, 1, 1, 1}},
                      {0.60, {.602, .7946, .9221, .9999, .9999, .9999}},
                      {0.62, {.5621, .6832, .7922, .9202, .9995, .9995}},
                      {0.64, {.5166, .5114, .5049, .4918, .4529, .3937}},
                      {0.66, {.4645, .2406, 0, 0, 0, 0}}};
  const double at[] = {0.1, 0.5, 1, 2, 5, 10};
  for (const Row& row : rows) {
    WetBox box(flume_mixture(), row.m);
    int n = 0;
    for (int k = 0; k < 6; ++k) {
      for (; n < static_cast<int>(std::lround(at[k] / 1e-3)); ++n) box.drain(1, 1e-3);
      EXPECT_NEAR(box.lambda(), row.lambda[k], 2e-4) << row.m << " at " << at[k] << " s";
    }
  }
}

/// Largest relative error of speed and path over the sheets.
double worst_error(double dt) {
  double worst = 0;
  for (const test::WetSheet& sheet : test::wet_sheets) {
    WetBox box(flume_mixture(), sheet.m, 31);
    int n = 0;
    const double at[] = {1, 2, 5, 10};
    for (int k = 0; k < 4; ++k) {
      for (; n < static_cast<int>(std::lround(at[k] / dt)); ++n) box.slide(dt);
      const test::WetSlide& expected = sheet.at[k];
      worst = std::max({worst, std::abs(box.speed - expected.u) / std::max(0.5, expected.u),
                        std::abs(box.path - expected.x) / expected.x});
      if (dt > 1e-3) continue;
      EXPECT_NEAR(box.lambda(), expected.lambda, 1.5e-3) << sheet.m << " at " << at[k] << " s";
      EXPECT_NEAR(box.m, expected.m, 1e-4) << sheet.m << " at " << at[k] << " s";
    }
  }
  return worst;
}

TEST(PorePressure, T4DecidesWhetherASheetRunsOrSticks) {
  EXPECT_LT(worst_error(1e-3), 0.002);
  EXPECT_LT(worst_error(0.05), 0.005) << "with the steps of columns";
}

TEST(PorePressure, T5StretchesUndrainedAsTheClosedForm) {
  const MixtureLaw law = flume_mixture();
  const double bulk = law.density(0.61), r = (law.fluid_density + 3 * bulk) / (4 * bulk);
  EXPECT_NEAR(r, 0.88247, 5e-6);
  const double x[] = {.9, .75, .5, 1.5, 2};
  const double water[] = {.4907, .4123, .1773, .6474, .7062};
  const double wetter[] = {.7908, .7725, .7175, .8275, .8412};
  for (int k = 0; k < 5; ++k)
    for (const auto& [start, table] : {std::pair{0.5299, water}, std::pair{0.8, wetter}}) {
      const double p = start * bulk * g + law.undrained(bulk, g * (x[k] - 1));
      const double lambda = p / (bulk * g * x[k]);
      EXPECT_NEAR(lambda, (start - r * (1 - x[k])) / x[k], 1e-14);
      EXPECT_NEAR(lambda, table[k], 1.1e-4);
    }
}

TEST(PorePressure, NothingDilatesAtRest) {
  const WetBox dense(flume_mixture(), 0.7);
  EXPECT_EQ(dense.rates(0, false).source, 0);
  EXPECT_EQ(advance(dense.rates(0, true), 0, 100).excess, 0);
  // Slow shear is not far from rest.
  EXPECT_NEAR(dense.rates(1e-9, false).source, 0, 1e-3);
}

TEST(PorePressure, StaysFiniteInTheThinnestFilm) {
  const MixtureLaw law = flume_mixture();
  const WetColumn film{0.6, 0.5, 1e-7, 1.9e-3, 1.1e-3, g};
  for (double speed : {0.0, 1e-6, 30.0}) {
    const auto d = dilatancy(law, 0.6, 2 * speed / film.thickness, film.effective_stress());
    for (const PoreRates& r :
         {pore_rates(law, film, 1e-9, speed, d), tangent_rates(law, film, 1e-9, speed, d)})
      EXPECT_TRUE(std::isfinite(advance(r, film.excess, 0.1).mean_excess)) << speed;
  }
}

TEST(PorePressure, TangentIsTheDerivative) {
  const MixtureLaw law = flume_mixture();
  for (double excess : {-2000.0, 500.0, 7000.0})
    for (double speed : {0.0, 0.3, 12.0}) {
      WetColumn c{0.6, excess, 1.2, 1.2 * law.density(0.6) * g, 1.2 * law.fluid_density * g, g};
      const auto change = [&](double p) {
        c.excess = p;
        const auto d = dilatancy(law, 0.6, 2 * speed / c.thickness, c.effective_stress());
        const PoreRates r = pore_rates(law, c, 1e-9, speed, d);
        return r.source - r.decay * p;
      };
      const double slope = (change(excess + 0.5) - change(excess - 0.5));
      c.excess = excess;
      const auto d = dilatancy(law, 0.6, 2 * speed / c.thickness, c.effective_stress());
      const PoreRates r = tangent_rates(law, c, 1e-9, speed, d);
      EXPECT_NEAR(-r.decay, slope, 1e-4 * std::abs(slope) + 1e-9) << excess << ", " << speed;
      EXPECT_NEAR(r.source - r.decay * excess, change(excess),
                  1e-9 * std::abs(change(excess)) + 1e-9);
    }
}

TEST(PorePressure, FrictionIsThatOfTheSummedAngles) {
  const double phi = 0.6, psi = -0.05;
  EXPECT_NEAR(mixture_friction(std::tan(phi), std::tan(psi)), std::tan(phi + psi), 1e-14);
  EXPECT_EQ(mixture_friction(0.1, -0.3), 0) << "never drives";
  EXPECT_LT(mixture_friction(0.8, 0, grains_touching(0.05)), 1e-3) << "grains that do not touch";
  EXPECT_NEAR(mixture_friction(0.8, 0, grains_touching(0.1)), 0.4, 1e-14);
  for (double m : {0.02, 0.09, 0.13, 0.25})
    EXPECT_NEAR(grains_touching(m), 0.5 * (1 + std::tanh(100 * (m - 0.1))), 1e-14) << m;
  EXPECT_NEAR(grains_touching(touching_fraction), 1, 1e-15) << "no jump";
}

}  // namespace
}  // namespace sturz
