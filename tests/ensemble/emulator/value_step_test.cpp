// SPDX-License-Identifier: Apache-2.0
// Values that jump, and emulators beside the step.
#include "ensemble/emulator/value_step.hpp"

#include "ensemble/emulator/quantity_emulator.hpp"
#include "ensemble/sampling/random_words.hpp"
#include "ensemble/sampling/unit_cube.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace sturz {
namespace {

using Points = std::vector<std::vector<double>>;
using Model = std::function<double(const std::vector<double>&)>;

Points cube_of(std::size_t n, std::size_t n_dims, std::uint64_t seed = 3) {
  return draw_unit_cube(Design::monte_carlo, n, n_dims, seed);
}

std::vector<double> values_of(const Model& model, const Points& cube) {
  std::vector<double> values;
  for (const auto& u : cube) values.push_back(model(u));
  return values;
}

bool runs_past(const std::vector<double>& u) {
  return u[0] + (u.size() > 1 ? 0.3 * u[1] : 0) < 0.6;
}
/// Half a bench holds, half run past; what they reach still depends on the first value.
double bench(const std::vector<double>& u) { return (runs_past(u) ? 1625 : 957) + 40 * (1 - u[0]); }
double flat_bench(const std::vector<double>& u) { return runs_past(u) ? 1625 : 957; }

TEST(ValueStep, IsFoundWhereMembersLieOnTwoSides) {
  const auto found = step_of({957, 960, 1625, 955, 1630, 1640, 958, 1633, 950, 1628});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->below, 960);
  EXPECT_EQ(found->above, 1625);
  EXPECT_EQ(found->n_below, 5);
  EXPECT_EQ(found->n_above, 5);
  EXPECT_EQ(found->least, 950);
  EXPECT_EQ(found->most, 1640);
  for (const std::size_t n : {20, 40, 200})
    for (const std::size_t n_dims : {1, 3})
      for (const auto& model : {Model(bench), Model(flat_bench)})
        EXPECT_TRUE(step_of(values_of(model, cube_of(n, n_dims)))) << n << " " << n_dims;
}

TEST(ValueStep, OneFarMemberAThinTailAndSmoothFunctionsAreNone) {
  EXPECT_FALSE(step_of({}));
  EXPECT_FALSE(step_of({1, 1, 1, 1, 1, 1, 1, 1}));
  EXPECT_FALSE(step_of({1, 1.1, 1.2, 1.3, 1.4, 1.5, 1.6, 90}));  // who flew off
  EXPECT_FALSE(step_of({0, 1, 2, 3, 4, 5, 6, 7, 8, 9}));
  int taken = 0, all = 0;
  const Model smooth[] = {
      [](const auto& u) { return u[0]; }, [](const auto& u) { return std::exp(5 * u[0]); },
      [](const auto& u) { return 1 / (0.05 + u[0]) + u[1]; },
      [](const auto& u) { return 1 / (1 + std::exp(-8 * (u[0] - 0.5))) + 0.1 * u[1]; },
      [](const auto& u) { return std::sin(6 * u[0]) + 0.2 * u[1]; }};
  for (const Model& model : smooth)
    for (const std::size_t n : {16, 40, 100})
      for (std::uint64_t seed = 1; seed <= 20; ++seed, ++all)
        taken += step_of(values_of(model, cube_of(n, 2, seed))).has_value();
  EXPECT_LE(taken, all / 50);
}

QuantityEmulator emulator_of(const Model& model, const Points& cube) {
  std::vector<Observation> simulated;
  for (const double v : values_of(model, cube)) simulated.push_back({v, Known::exactly});
  return emulate("runout_m", cube, simulated);
}

/// Expects of new members their own side, and of no point what lies between.
TEST(EmulatorBesideAStep, ExpectsOneSideOrTheOther) {
  const Model rough = [](const std::vector<double>& u) {
    return bench(u) + 3 * std::sin(1e4 * u[0]);
  };
  for (const auto& model : {Model(bench), Model(flat_bench), rough}) {
    const QuantityEmulator e = emulator_of(model, cube_of(60, 2));
    ASSERT_TRUE(e.report().step);
    EXPECT_GT(e.report().step->told, 0.85);
    EXPECT_GT(e.report().q2, 0.7);
    int right = 0;
    double probability = 0;
    const Points others = cube_of(500, 2, 77);
    for (const auto& u : others) {
      const EmulatedValue v = e.at(u);
      EXPECT_TRUE(v.likely.mean < 1000 || v.likely.mean > 1600) << v.likely.mean;
      EXPECT_TRUE(v.other.mean < 1000 || v.other.mean > 1600) << v.other.mean;
      EXPECT_GE(v.other_share, 0);
      EXPECT_LE(v.other_share, 0.5);
      right += (v.likely.mean > 1300) == runs_past(u);
      probability += v.other_share;
    }
    EXPECT_GT(right, 450);
    EXPECT_NEAR(probability, 500 - right, 25);  // as often wrong as it says
  }
}

/// Where the place of a member does not tell its side, the share of the members does.
TEST(EmulatorBesideAStep, KnowsWhenItCannotTellTheSide) {
  const Points cube = cube_of(60, 2);
  std::vector<Observation> simulated;
  for (std::uint32_t i = 0; i < 60; ++i)
    simulated.push_back({random_unit(5, Stream::resample, i) < 0.3 ? 1625.0 : 957.0});
  const QuantityEmulator e = emulate("runout_m", cube, simulated);
  ASSERT_TRUE(e.report().step);
  EXPECT_LT(e.report().q2, 0.2);
  double above = 0;
  for (const auto& u : cube_of(100, 2, 9)) {
    const EmulatedValue v = e.at(u);
    above += (v.likely.mean > 1300 ? 1 - v.other_share : v.other_share) / 100;
  }
  EXPECT_NEAR(above, 0.3, 0.12);
}

/// A new member is worth most where the sides meet, and less once it is there.
TEST(EmulatorBesideAStep, MembersAreWantedWhereTheSidesMeet) {
  const QuantityEmulator e = emulator_of(bench, cube_of(30, 2));
  double at_the_step = 0, far = 0;
  std::vector<double> widest;
  for (const auto& u : cube_of(400, 2, 5)) {
    const double v = e.at(u).variance, off = std::abs(u[0] + 0.3 * u[1] - 0.6);
    if (off < 0.05 && v > at_the_step) at_the_step = v, widest = u;
    if (off > 0.3) far = std::max(far, v);
  }
  EXPECT_GT(at_the_step, 3 * far);
  EXPECT_LT(e.with_point(widest).at(widest).variance, 0.5 * at_the_step);
}

/// A member that is cut off beyond the lower side ran past; one cut off before it says nothing.
TEST(EmulatorBesideAStep, BoundsBeyondTheLowerSideLieOnTheUpper) {
  const Points cube = cube_of(60, 2);
  std::vector<Observation> simulated;
  for (const double v : values_of(bench, cube)) simulated.push_back({v, Known::exactly});
  int cut = 0;
  for (std::size_t i = 0; i < cube.size(); ++i)
    if (runs_past(cube[i]) && cube[i][1] > 0.7) simulated[i] = {1900, Known::at_least}, ++cut;
  for (std::size_t i = 0; i < 60 && !runs_past(cube[i]); ++i) simulated[i] = {500, Known::at_least};
  const QuantityEmulator e = emulate("runout_m", cube, simulated);
  ASSERT_TRUE(e.report().step);
  EXPECT_EQ(e.report().n_bounds_used, cut);
  EXPECT_EQ(e.report().lowest_bound_used, 1900);
  EXPECT_EQ(e.report().n_used, e.report().n_exact + cut);
}

}  // namespace
}  // namespace sturz
