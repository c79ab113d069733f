// SPDX-License-Identifier: Apache-2.0
// Posteriors of quantities that jump, and of those that end at 0.
#include "ensemble/calibration/calibration.hpp"
#include "ensemble/hazard/weighting/weighted_sample.hpp"
#include "ensemble/sampling/random_words.hpp"
#include "ensemble/sampling/unit_cube.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <openturns/DistFunc.hxx>

#include <algorithm>
#include <cmath>
#include <functional>

namespace sturz {
namespace {

using Points = std::vector<std::vector<double>>;
using Model = std::function<std::vector<double>(const std::vector<double>&)>;
using testing::HasSubstr;

double normal_draw(std::uint64_t seed, std::uint32_t index) {
  return OT::DistFunc::qNormal(random_unit(seed, Stream::resample, index));
}

CalibrationData data_of(const Model& model, std::size_t n, std::vector<ObservedQuantity> observed,
                        std::size_t n_dims = 2) {
  CalibrationData data;
  for (std::size_t d = 0; d < n_dims; ++d) data.keys.push_back("key" + std::to_string(d));
  data.cube = draw_unit_cube(Design::sobol, n, n_dims, 12);
  data.n_drawn = n;
  data.comparison.observed = std::move(observed);
  for (std::size_t i = 0; i < n; ++i) {
    data.comparison.simulated.members.push_back(static_cast<std::int64_t>(i));
    auto& row = data.comparison.simulated.values.emplace_back();
    for (const double v : model(data.cube[i])) row.push_back({v, Known::exactly});
  }
  return data;
}

// --- a step: a bench holds some members, the others run past it ---
double bench_runout(const std::vector<double>& u) {
  return (u[0] + 0.3 * u[1] < 0.6 ? 1625 : 957) + 40 * (1 - u[0]);
}

CalibrationData bench_data(double observed) {
  return data_of([](const auto& u) { return std::vector<double>{bench_runout(u)}; }, 40,
                 {{"runout_m", observed, 20, "m"}});
}

/// Share of the posterior where members are held.
double held_share(const Posterior& p) {
  double share = 0;
  for (std::size_t i = 0; i < p.cube.size(); ++i)
    share += p.weights[i] * (bench_runout(p.cube[i]) < 1300);
  return share;
}

TEST(Step, ThePosteriorLiesOnTheSideThatWasObserved) {
  for (const double observed : {975.0, 1645.0}) {
    const Calibration c = calibrate(bench_data(observed), {});
    EXPECT_NEAR(held_share(c.posterior), observed < 1300 ? 1 : 0, 0.1) << observed;
    EXPECT_NEAR(c.check[0].median, observed, 40);
    EXPECT_THAT(c.warnings, testing::Contains(HasSubstr("runout_m jumps: ")));
    EXPECT_THAT(c.warnings, testing::Not(testing::Contains(HasSubstr("lies in the gap"))));
    for (const SimulatedRow& row : c.posterior.simulated)
      EXPECT_TRUE(row[0].value < 1000 || row[0].value > 1620) << row[0].value;
    ASSERT_TRUE(c.best);
    EXPECT_NEAR(bench_runout(c.best->cube), observed, 40);
  }
}

/// One smooth emulator finds values for it: those of the few points where it crosses the gap.
TEST(Step, AnObservationInTheGapIsSaidAndNoValuesAreFoundForIt) {
  const Calibration c = calibrate(bench_data(1300), {});
  EXPECT_THAT(c.warnings, testing::Contains(HasSubstr("The observed 1300 lies in the gap")));
  for (const SimulatedRow& row : c.posterior.simulated)
    EXPECT_TRUE(row[0].value < 1000 || row[0].value > 1620) << row[0].value;
  EXPECT_GT(c.identifiability.sd[0], 0.15);  // whole sides are left
}

TEST(Step, TwinsAreHeldByTheirNinetyPercentIntervals) {
  const CalibrationData data = bench_data(1000);
  const EmulatorSet emulators(data.comparison.observed, data.cube,
                              data.comparison.simulated.values);
  int held = 0;
  const Points truths = draw_unit_cube(Design::monte_carlo, 60, 2, 99);
  for (std::size_t t = 0; t < truths.size(); ++t) {
    const double seen = bench_runout(truths[t]) + 20 * normal_draw(500, static_cast<unsigned>(t));
    const Likelihood likelihood({{"runout_m", seen, 20, "m"}}, data.comparison.simulated.values, 0);
    const Posterior p = emulated_posterior(likelihood, emulators, 2, {2, 300, 800, 512}, t + 1);
    for (std::size_t d = 0; d < 2; ++d) {
      std::vector<double> column;
      for (const auto& u : p.cube) column.push_back(u[d]);
      held += weighted_quantile(column, p.weights, 0.05) <= truths[t][d] &&
              truths[t][d] <= weighted_quantile(column, p.weights, 0.95);
    }
  }
  EXPECT_GE(held / 120.0, 0.85);
}

// --- distances: 0 is observed, and nothing is below it ---
double distance(const std::vector<double>& u) { return 50 * std::abs(u[0] - 0.4) + 2 * u[1]; }

TEST(Distances, AreNeverPredictedBelowZero) {
  CalibrationData data = data_of(
      [](const auto& u) {
        return std::vector<double>{distance(u), 300 - 200 * u[0], 8 * std::max(0.0, u[0] - 0.5)};
      },
      30, {{"outline_distance_m", 0, 3, "m"}, {"runout_m", 220, 6, "m"}, {"depth_m", 0, 1, "m"}});
  for (ObservedQuantity& o : data.comparison.observed) o.least = 0;
  for (const PosteriorMethod method : {PosteriorMethod::emulator, PosteriorMethod::weights}) {
    CalibrationSettings settings;
    settings.method = method;
    const Calibration c = calibrate(data, settings);
    for (const SimulatedRow& row : c.posterior.simulated)
      for (const SimulatedValue& v : row) EXPECT_GE(v.value, 0);
    for (const PredictedQuantity& p : c.check) {
      EXPECT_GE(p.lower, 0) << p.name;
      EXPECT_GE(p.median, p.lower);
      EXPECT_GT(p.upper, p.median);
      EXPECT_EQ(p.ends_at_least, p.name != "runout_m") << p.name;
      EXPECT_GT(p.below, 0.025) << p.name;  // an observed 0 is no tail of what stands at 0
    }
    for (const HeldOutQuantity& h : c.held_out.quantities) EXPECT_GE(h.predicted.lower, 0);
    EXPECT_THAT(c.warnings, testing::Not(testing::Contains(HasSubstr("is not explained"))));
  }
}

}  // namespace
}  // namespace sturz
