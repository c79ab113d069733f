// SPDX-License-Identifier: Apache-2.0
#include "ensemble/hazard/convergence.hpp"

#include "ensemble/hazard/wilson.hpp"
#include "tests/support/memory_members.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

using test::MemoryMembers;
using test::random_member;
using test::small_grid;

TEST(Convergence, MatchesBruteForce) {
  const Grid grid = small_grid(8, 10, 5);
  MemoryMembers source(grid);
  std::vector<MemberResult> valid;
  std::mt19937 random(3);
  for (int m = 0; m < 31; ++m) {  // more than 20 valid ones: 1 of 20 is the limit itself
    MemberResult r = random_member(m, grid, random);
    if (m % 5 == 2) r.outcome = Outcome::failed;
    source.add(r);
    if (is_valid(r.outcome)) valid.push_back(r);
  }
  const auto hits = [&](std::size_t n, int row, int col) {
    return std::count_if(
        valid.begin(), valid.begin() + static_cast<std::ptrdiff_t>(n), [&](const MemberResult& r) {
          return !std::isnan(MemoryMembers::value(r, PeakLayer::arrival, row, col));
        });
  };
  const std::vector<ConvergencePoint> points = probability_convergence(source);
  ASSERT_EQ(points.size(), valid.size());
  for (std::size_t n = 1; n <= valid.size(); ++n) {
    double cells = 0, sum = 0, width = 0, likely = 0, possible = 0, sure = 0, perhaps = 0;
    for (int row = 0; row < grid.n_rows; ++row)
      for (int col = 0; col < grid.n_cols; ++col) {
        if (hits(valid.size(), row, col) == 0) continue;
        const auto k = hits(n, row, col);
        const double p = static_cast<double>(k) / static_cast<double>(n);
        const ProbabilityBounds bounds = wilson_interval(k, static_cast<std::int64_t>(n));
        ++cells;
        sum += p;
        width += (bounds.upper - bounds.lower) / 2;
        likely += p >= 0.5;
        sure += bounds.lower >= 0.5;
        perhaps += k > 0 && bounds.upper >= 0.5;
        possible += p >= 0.05;
      }
    const ConvergencePoint& point = points[n - 1];
    EXPECT_EQ(point.n_members, static_cast<std::int64_t>(n));
    EXPECT_NEAR(point.mean_probability_reached, sum / cells, 1e-12);
    EXPECT_NEAR(point.mean_half_width, width / cells, 1e-12);
    EXPECT_EQ(point.area_likely_m2, likely * 25);
    EXPECT_EQ(point.area_likely_lower_m2, sure * 25);
    EXPECT_EQ(point.area_likely_upper_m2, perhaps * 25);
    EXPECT_EQ(point.area_possible_m2, possible * 25);
  }
}

TEST(Convergence, IsTheSameForEveryOrderAndTileSize) {
  const Grid grid = small_grid(8, 10);
  std::mt19937 random(9);
  std::vector<MemberResult> results;
  for (int m = 0; m < 30; ++m) results.push_back(random_member(m, grid, random));
  const auto half_widths = [&](std::size_t limit) {
    MemoryMembers source(grid);
    for (const MemberResult& r : results) source.add(r);
    std::vector<double> widths;
    for (const auto& point : probability_convergence(source, limit, 7))
      widths.push_back(point.mean_half_width);
    return widths;
  };
  const std::vector<double> expected = half_widths(1 << 20);
  EXPECT_EQ(expected.size(), 7U);
  std::shuffle(results.begin(), results.end(), random);
  EXPECT_EQ(half_widths(500), expected);
}

TEST(Convergence, ThinsItsPointsAndEndsWithTheWholeEnsemble) {
  const Grid grid = small_grid(3, 3);
  MemoryMembers source(grid);
  std::mt19937 random(2);
  for (int m = 0; m < 101; ++m) source.add(random_member(m, grid, random));
  const auto points = probability_convergence(source, 1 << 20, 10);
  ASSERT_EQ(points.size(), 10U);
  EXPECT_EQ(points.back().n_members, 101);
  for (std::size_t i = 1; i < points.size(); ++i)
    EXPECT_GT(points[i].n_members, points[i - 1].n_members);
  EXPECT_LT(points.back().mean_half_width, points.front().mean_half_width);
}

TEST(Convergence, IsEmptyWithoutValidMembers) {
  EXPECT_TRUE(probability_convergence(MemoryMembers(small_grid(2, 2))).empty());
}

}  // namespace
}  // namespace sturz
