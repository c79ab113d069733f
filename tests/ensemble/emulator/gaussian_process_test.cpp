// SPDX-License-Identifier: Apache-2.0
#include "ensemble/emulator/gaussian_process.hpp"

#include "engine/core/error.hpp"
#include "ensemble/emulator/bounded_minimum.hpp"
#include "ensemble/emulator/openturns_function.hpp"
#include "ensemble/emulator/quantity_emulator.hpp"
#include "ensemble/sampling/unit_cube.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <openturns/Basis.hxx>
#include <openturns/KrigingAlgorithm.hxx>
#include <openturns/LinearBasisFactory.hxx>
#include <openturns/Log.hxx>
#include <openturns/MaternModel.hxx>
#include <openturns/ResourceMap.hxx>

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

using Points = std::vector<std::vector<double>>;

double wavy(std::span<const double> u) {
  return std::sin(5 * u[0]) + u[1] * u[1] + 0.3 * u[0] * u[1];
}

std::vector<double> values_at(const Points& points) {
  std::vector<double> values;
  for (const auto& p : points) values.push_back(wavy(p));
  return values;
}

TEST(BoundedMinimum, FindsTheBottomOfAValleyAndAnEdge) {
  const auto valley = [](std::span<const double> x) {
    return std::pow(x[0] - 0.3, 2) + 10 * std::pow(x[1] - x[0], 2);
  };
  const Minimum inside = bounded_minimum(valley, {0.9, 0.1}, 300);
  EXPECT_NEAR(inside.at[0], 0.3, 0.01);
  EXPECT_NEAR(inside.at[1], 0.3, 0.01);
  const Minimum edge =
      bounded_minimum([](std::span<const double> x) { return x[0] - x[1]; }, {0.5, 0.5}, 200);
  EXPECT_NEAR(edge.at[0], 0, 1e-3);
  EXPECT_NEAR(edge.at[1], 1, 1e-3);
}

TEST(GaussianProcess, AgreesWithOpenTurnsAtTheSameLengths) {
  const Points points = draw_unit_cube(Design::sobol, 32, 2, 1);
  const std::vector<double> values = values_at(points);
  const std::vector<double> length{0.5, 0.9};
  const GaussianProcess ours(points, values, {length, 1e-8});
  OT::Log::Show(OT::Log::NONE);
  OT::Sample in(32, 2), out(32, 1);
  for (std::size_t i = 0; i < 32; ++i) {
    in(i, 0) = points[i][0];
    in(i, 1) = points[i][1];
    out(i, 0) = values[i];
  }
  OT::MaternModel matern(openturns_point(length), OT::Point{1.0}, 2.5);
  matern.setNuggetFactor(1e-8);
  OT::KrigingAlgorithm kriging(in, out, matern, OT::LinearBasisFactory(2).build());
  kriging.setOptimizeParameters(false);
  kriging.run();
  const OT::KrigingResult theirs = kriging.getResult();
  for (const auto& at : draw_unit_cube(Design::monte_carlo, 20, 2, 5)) {
    EXPECT_NEAR(ours.at(at).mean, theirs.getConditionalMean(openturns_point(at))[0], 2e-5);
    EXPECT_NEAR(ours.mean_at(at), ours.at(at).mean, 1e-12);
  }
}

TEST(GaussianProcess, LeftOutErrorsAreThoseOfAProcessWithoutThePoint) {
  const Points points = draw_unit_cube(Design::sobol, 24, 2, 3);
  const std::vector<double> values = values_at(points);
  const GaussianProcess::Scales scales{{0.4, 0.8}, 1e-3};
  double errors = 0, mean = 0, squares = 0;
  for (const double v : values) mean += v / 24;
  for (std::size_t i = 0; i < 24; ++i) {
    Points others = points;
    std::vector<double> their_values = values;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    their_values.erase(their_values.begin() + static_cast<std::ptrdiff_t>(i));
    errors +=
        std::pow(GaussianProcess(others, their_values, scales).mean_at(points[i]) - values[i], 2);
    squares += std::pow(values[i] - mean, 2);
  }
  const GaussianProcess whole(points, values, scales);
  EXPECT_NEAR(whole.leave_one_out().q2, 1 - errors / squares, 1e-9);
}

/// Share of the function inside the 95 % intervals of a process that learned it with noise.
/// \param noise_variance goes up by what the process takes for it
double share_inside(std::uint64_t seed, double& noise_variance) {
  const Points points = draw_unit_cube(Design::latin_hypercube, 60, 2, 8);
  std::vector<double> values = values_at(points);
  const Points noise = draw_unit_cube(Design::monte_carlo, 60, 1, seed);
  for (std::size_t i = 0; i < 60; ++i) values[i] += 0.2 * (noise[i][0] - 0.5) * std::sqrt(12.0);
  const GaussianProcess process = GaussianProcess::fitted(points, values);
  EXPECT_NEAR(std::sqrt(process.at(points[0]).noise), 0.2, 0.07) << seed;
  EXPECT_GT(process.leave_one_out().q2, 0.85) << seed;
  noise_variance += process.at(points[0]).noise;
  const Points checks = draw_unit_cube(Design::sobol, 256, 2, 4);
  int inside = 0;
  for (const auto& u : checks) {
    const GaussianPrediction p = process.at(u);
    inside += std::abs(p.mean - wavy(u)) <= 1.96 * std::sqrt(p.variance);
  }
  return inside / 256.0;
}

/// Errors at neighbouring points are those of one and the same draw of the noise: a single draw
/// says little of the intervals, whatever the number of points (0.68 to 1 are all met).
TEST(GaussianProcess, FindsLengthsNoiseAndHonestIntervals) {
  constexpr int n_draws = 40;
  double inside = 0, noise_variance = 0;
  for (int draw = 0; draw < n_draws; ++draw) inside += share_inside(77 + draw, noise_variance);
  EXPECT_GE(inside / n_draws, 0.85);
  EXPECT_NEAR(std::sqrt(noise_variance / n_draws), 0.2, 0.015);
}

/// A value with noise n leaves v n / (v + n) of the variance v there, and no value leaves less.
TEST(GaussianProcess, OneMorePointTakesTheVarianceThereAndNothingElse) {
  const Points points = draw_unit_cube(Design::sobol, 16, 2, 3);
  const std::vector<double> here{0.93, 0.07}, far{0.1, 0.9};
  const auto expect_less = [&](const GaussianProcess& process) {
    const GaussianProcess more = process.with_point(here);
    const GaussianPrediction before = process.at(here), after = more.at(here);
    EXPECT_NEAR(after.mean, before.mean, 1e-6);
    const double left = before.variance * before.noise / (before.variance + before.noise);
    EXPECT_NEAR(after.variance, left, 1e-3 * left);
    EXPECT_NEAR(after.noise, before.noise, 1e-12 * before.noise);
    EXPECT_LE(more.at(far).variance, process.at(far).variance * (1 + 1e-9));
    return after.variance / before.variance;
  };
  EXPECT_LT(expect_less(GaussianProcess(points, values_at(points), {{0.5, 0.9}, 1e-6})), 0.05);
  EXPECT_GT(expect_less(GaussianProcess(points, values_at(points), {{0.5, 0.9}, 1})), 0.3);
  EXPECT_LT(expect_less(GaussianProcess::fitted(points, values_at(points))), 1);
}

Points cube_of(std::size_t n) { return draw_unit_cube(Design::sobol, n, 2, 3); }

std::vector<Observation> exactly(const Points& points) {
  std::vector<Observation> all;
  for (const auto& p : points) all.push_back({wavy(p), Known::exactly});
  return all;
}

TEST(QuantityEmulator, CountsWhatIsCensoredAndUsesBoundsThatContradict) {
  const Points cube = cube_of(40);
  std::vector<Observation> simulated = exactly(cube);
  simulated[3] = {simulated[3].value - 5, Known::at_least};  // says nothing new
  simulated[4] = {simulated[4].value + 5, Known::at_least};
  simulated[5].known = Known::not_at_all;
  const EmulatorReport r = emulate("runout_m", cube, simulated).report();
  EXPECT_EQ(r.n_exact, 37);
  EXPECT_EQ(r.n_at_least, 2);
  EXPECT_EQ(r.n_bounds_used, 1);
  EXPECT_EQ(r.n_not_known, 1);
}

/// Of more than 400 the last ones teach, and chosen members come last.
TEST(QuantityEmulator, ChosenMembersTeachHoweverManyWereDrawn) {
  Points cube = draw_unit_cube(Design::sobol, 400, 2, 3);
  std::vector<Observation> simulated = exactly(cube);
  for (std::size_t i = 0; i < 5; ++i) {  // a step that the drawn ones know nothing of
    cube.push_back({0.5 + 0.001 * static_cast<double>(i), 0.5});
    simulated.push_back({wavy(cube.back()) + 3, Known::exactly});
  }
  simulated[0].known = Known::not_at_all;
  const std::vector<std::size_t> teachers = teaching_members(simulated);
  ASSERT_EQ(teachers.size(), most_emulated_members);
  EXPECT_EQ(teachers.front(), 5U);
  EXPECT_EQ(teachers.back(), 404U);
  const QuantityEmulator e = emulate("runout_m", cube, simulated);
  EXPECT_EQ(e.report().n_exact, 404);
  EXPECT_EQ(e.report().n_used, 400);
  EXPECT_GT(e.mean_at(cube.back()), wavy(cube.back()) + 0.3);
}

/// Beyond a bound lies what a normal there would reach, not the bound itself.
TEST(QuantityEmulator, BoundsTeachWhatLiesBeyondThem) {
  const Points cube = cube_of(40);
  std::vector<Observation> cut = exactly(cube), as_values = cut;
  for (std::size_t i = 0; i < 40; ++i) {
    if (cube[i][0] < 0.7) continue;  // beyond, the others do not foresee what is there
    cut[i] = {cut[i].value + 0.5, Known::at_least};
    as_values[i] = {cut[i].value, Known::exactly};
  }
  const QuantityEmulator e = emulate("runout_m", cube, cut);
  ASSERT_GT(e.report().n_bounds_used, 5);
  EXPECT_LT(e.report().lowest_bound_used, 1);
  EXPECT_EQ(e.report().n_used, e.report().n_exact + e.report().n_bounds_used);
  const QuantityEmulator taken = emulate("runout_m", cube, as_values);
  double more = 0;
  for (std::size_t i = 0; i < 40; ++i)
    if (cut[i].known == Known::at_least) more += e.mean_at(cube[i]) - taken.mean_at(cube[i]);
  EXPECT_GT(more / static_cast<double>(e.report().n_bounds_used), 0.01);
}

std::string error_of(const Points& cube, const std::vector<Observation>& simulated) {
  try {
    emulate("runout_m", cube, simulated);
  } catch (const SetupError& problem) {
    return problem.what();
  }
  return "no error";
}

TEST(QuantityEmulator, RefusesWhatTellsNothing) {
  using testing::HasSubstr;
  std::vector<Observation> censored = exactly(cube_of(30)), same = censored;
  for (auto& o : censored) o.known = Known::at_least;
  for (auto& o : same) o.value = 7;
  EXPECT_THAT(error_of(cube_of(30), censored),
              HasSubstr("runout_m: 0 members say its value, of 30"));
  EXPECT_THAT(error_of(cube_of(30), same), HasSubstr("runout_m: 7 in every member"));
  EXPECT_THAT(error_of(cube_of(1), exactly(cube_of(1))), HasSubstr("needs 7 at least"));
  EXPECT_THAT(error_of({}, {}), HasSubstr("no member"));
}

}  // namespace
}  // namespace sturz
