// SPDX-License-Identifier: Apache-2.0
#include "ensemble/sampling/structured_cube.hpp"
#include "ensemble/sampling/unit_cube.hpp"
#include "ensemble/sensitivity/morris.hpp"
#include "ensemble/sensitivity/sobol_indices.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace sturz {
namespace {

using Points = std::vector<std::vector<double>>;
constexpr double pi = std::numbers::pi;

/// Ishigami and Homma (1990), a = 7, b = 0.1.
double ishigami(const std::vector<double>& u) {
  const double x = pi * (2 * u[0] - 1), y = pi * (2 * u[1] - 1), z = pi * (2 * u[2] - 1);
  return std::sin(x) + 7 * std::pow(std::sin(y), 2) + 0.1 * std::pow(z, 4) * std::sin(x);
}
/// V1 = (1 + b pi^4 / 5)^2 / 2, V2 = a^2 / 8, V13 = 8 b^2 pi^8 / 225.
struct IshigamiShares {
  double v1 = std::pow(1 + 0.1 * std::pow(pi, 4) / 5, 2) / 2, v2 = 49.0 / 8,
         v13 = 8 * 0.01 * std::pow(pi, 8) / 225, v = v1 + v2 + v13;
  std::vector<double> first{v1 / v, v2 / v, 0}, total{(v1 + v13) / v, v2 / v, v13 / v};
};

constexpr double g_a[] = {0, 1, 4.5, 9};
/// Sobol' (1993): product of (|4 u - 2| + a) / (1 + a).
double g_function(const std::vector<double>& u) {
  double product = 1;
  for (std::size_t d = 0; d < 4; ++d) product *= (std::abs(4 * u[d] - 2) + g_a[d]) / (1 + g_a[d]);
  return product;
}

std::vector<Observation> results(const Points& cube, double (*f)(const std::vector<double>&)) {
  std::vector<Observation> all;
  for (const auto& u : cube) all.push_back({f(u), Known::exactly});
  return all;
}

void expect_inside(const std::vector<Share>& shares, const std::vector<double>& truth) {
  ASSERT_EQ(shares.size(), truth.size());
  for (std::size_t d = 0; d < truth.size(); ++d) {
    EXPECT_LE(shares[d].lower, truth[d] + 1e-3) << d;
    EXPECT_GE(shares[d].upper, truth[d] - 1e-3) << d;
  }
}

TEST(SobolIndices, IshigamiLiesInsideTheIntervals) {
  const Points cube = saltelli_cube(1024UL * 5, 3, 2);
  const auto found = sobol_indices(cube, results(cube, ishigami));
  ASSERT_TRUE(found);
  const IshigamiShares truth;
  expect_inside(found->first, truth.first);
  expect_inside(found->total, truth.total);
  EXPECT_EQ(found->n_sets, 1024);
  EXPECT_LT(found->total[1].upper - found->total[1].lower, 0.2);
  EXPECT_NEAR(found->first[1].value, truth.first[1], 0.05);
}

TEST(SobolIndices, GFunctionLiesInsideTheIntervals) {
  const Points cube = saltelli_cube(1024UL * 6, 4, 7);
  const auto found = sobol_indices(cube, results(cube, g_function));
  ASSERT_TRUE(found);
  double v[4], all = 1;
  for (int d = 0; d < 4; ++d) {
    v[d] = 1.0 / 3 / std::pow(1 + g_a[d], 2);
    all *= 1 + v[d];
  }
  std::vector<double> first, total;
  for (const double one : v) {
    first.push_back(one / (all - 1));
    total.push_back(one * all / (1 + one) / (all - 1));
  }
  expect_inside(found->first, first);
  expect_inside(found->total, total);
}

TEST(SobolIndices, SetsWithCensoredMembersAreLeftOutAndCounted) {
  const Points cube = saltelli_cube(64UL * 5, 3, 2);
  auto some = results(cube, ishigami);
  some[7].known = Known::at_least;     // set 1
  some[40].known = Known::not_at_all;  // set 8
  some[43].value = std::nan("");       // set 8 again
  const auto found = sobol_indices(cube, some);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->n_sets, 62);
  EXPECT_EQ(found->n_left_out, 2);
  for (auto& r : some) r.known = Known::at_least;
  EXPECT_FALSE(sobol_indices(cube, some));
  for (auto& r : some) r = {3, Known::exactly};
  EXPECT_FALSE(sobol_indices(cube, some));
}

TEST(SobolIndices, AnEmulatorOfFewMembersGivesThemToo) {
  const Points cube = draw_unit_cube(Design::sobol, 160, 3, 5);
  const EmulatedIndices found = emulated_indices("y", cube, results(cube, ishigami), 1);
  EXPECT_GT(found.emulator.q2, 0.8);
  const IshigamiShares truth;
  expect_inside(found.indices.first, truth.first);
  expect_inside(found.indices.total, truth.total);
  const EmulatedIndices again = emulated_indices("y", cube, results(cube, ishigami), 1);
  EXPECT_EQ(again.indices.total[2].upper, found.indices.total[2].upper);  // the same bits
}

/// 17 members of three values have a linear trend, and 15 of them would not by themselves: two of
/// ten groups then measured the change of the trend (0.7 wide).
TEST(SobolIndices, TheEmulatorsErrorIsThatOfFewerMembersNotOfAnotherTrend) {
  const Points cube = draw_unit_cube(Design::sobol, 17, 3, 5);
  const Points noise = draw_unit_cube(Design::monte_carlo, 17, 1, 3);
  std::vector<Observation> noisy;
  for (std::size_t i = 0; i < 17; ++i)
    noisy.push_back({4 * cube[i][0] + cube[i][1] + noise[i][0] - 0.5, Known::exactly});
  const EmulatedIndices found = emulated_indices("y", cube, noisy, 1);
  EXPECT_LT(found.indices.first[0].upper - found.indices.first[0].lower, 0.3);
  EXPECT_GT(found.indices.first[0].value, 0.8);
}

TEST(Morris, RanksAndTellsStraightFromCurved) {
  const auto f = [](const std::vector<double>& u) {
    return 10 * u[0] + 3 * u[1] + 8 * (u[2] - 0.5) * (u[3] - 0.5) + 0 * u[4];
  };
  const Points cube = morris_cube(20UL * 6, 5, 4);
  const auto m = morris_measures(cube, results(cube, f));
  EXPECT_NEAR(m[0].mean, 10, 1e-9);
  EXPECT_EQ(m[0].deviation, 0);  // rounding is no spread
  EXPECT_EQ(m[0].mean_absolute_error, 0);
  EXPECT_NEAR(m[1].mean_absolute, 3, 1e-9);
  EXPECT_GT(m[2].mean_absolute, 0.5);
  EXPECT_GT(m[2].deviation, std::abs(m[2].mean));
  EXPECT_EQ(m[4].mean_absolute, 0);
  EXPECT_GT(m[0].mean_absolute, m[1].mean_absolute);
  EXPECT_GT(m[1].mean_absolute, m[4].mean_absolute);
  EXPECT_EQ(m[3].n, 20);
}

TEST(Morris, GFunctionComesInItsOrder) {
  const Points cube = morris_cube(50UL * 5, 4, 6);
  const auto m = morris_measures(cube, results(cube, g_function));
  // Half a cube from the middle of an eighth meets the same value of |4 u - 2| from the other side
  // or not: what differs is the slope, and that falls with a.
  for (int d = 0; d < 3; ++d) EXPECT_GE(m[d].mean_absolute, m[d + 1].mean_absolute) << d;
}

TEST(Morris, EffectsWithACensoredEndAreLeftOutAndCounted) {
  const Points cube = morris_cube(3UL * 3, 2, 1);
  auto some = results(cube, [](const std::vector<double>& u) { return u[0] + u[1]; });
  some[4].known = Known::at_least;  // the middle of the second trajectory: both of its effects
  const auto m = morris_measures(cube, some);
  for (const auto& measure : m) {
    EXPECT_EQ(measure.n, 2);
    EXPECT_EQ(measure.n_censored, 1);
    EXPECT_NEAR(measure.mean, 1, 1e-12);
  }
  for (auto& r : some) r.known = Known::at_least;
  EXPECT_TRUE(std::isnan(morris_measures(cube, some)[0].mean_absolute));
}

/// One uncertain value has every share, and one that decides beside an idle one at most all.
TEST(SobolIndices, EndWhereSharesEnd) {
  const auto alone = saltelli_cube(192, 1, 5), beside = saltelli_cube(256, 2, 5);
  for (const auto& cube : {alone, beside}) {
    std::vector<Observation> results;
    for (const auto& u : cube) results.push_back({std::exp(3 * u[0]), Known::exactly});
    const auto found = sobol_indices(cube, results);
    ASSERT_TRUE(found.has_value());
    EXPECT_NEAR(found->first[0].value, 1, 1e-9);
    EXPECT_GE(found->first[0].lower, -1);
    EXPECT_LE(found->first[0].upper, 1);
    EXPECT_GE(found->total.back().lower, 0);
    EXPECT_LE(found->total[0].upper, 2);
  }
}

}  // namespace
}  // namespace sturz
