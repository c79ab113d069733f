// SPDX-License-Identifier: Apache-2.0
#include "ensemble/region/any_hit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

namespace sturz {
namespace {

TEST(AnyHit, OfOneSourceHasTheBoundsOfThatSource) {
  AnyHit any(1, 40);
  any.next_cell();
  any.add(10, 40);
  const ProbabilityBounds own = wilson_interval(10, 40, z_90);
  EXPECT_DOUBLE_EQ(any.probability(), 0.25);
  EXPECT_DOUBLE_EQ(any.bounds().lower, own.lower);
  EXPECT_DOUBLE_EQ(any.bounds().upper, own.upper);
}

TEST(AnyHit, BoundsStandAroundTheProbability) {
  AnyHit any(5, 8);
  for (int hits = 1; hits <= 8; ++hits) {
    any.next_cell();
    any.add(hits, 8);
    any.add(1, 8);
    EXPECT_LE(any.bounds().lower, any.probability()) << hits;
    EXPECT_GE(any.bounds().upper, any.probability()) << hits;
    EXPECT_LE(any.bounds().upper, 1);
  }
}

TEST(AnyHit, FarSourcesDoNotMakeItProbable) {
  AnyHit few(2, 8), many(300, 8);
  few.next_cell(), many.next_cell();
  EXPECT_EQ(many.bounds().lower, 0);
  EXPECT_EQ(many.bounds().upper, few.bounds().upper);
  EXPECT_EQ(many.bounds().upper, wilson_interval(0, 8, z_90).upper);
}

/// Share of 4,000 regions whose interval holds the truth.
struct Coverage {
  double any = 0, any_rows = 0;
};

/// \param p of each source \param shared whether a row's number is the same for all sources
Coverage coverage(const std::vector<double>& p, int n_rows, bool shared) {
  constexpr int trials = 4000;
  std::mt19937 random(12);
  std::uniform_real_distribution<> uniform(0, 1);
  double none = 1, largest = 0;
  for (const double one : p) none *= 1 - one, largest = std::max(largest, one);
  const double truth = 1 - none, truth_of_rows = shared ? largest : truth;
  Coverage held;
  for (int t = 0; t < trials; ++t) {
    std::vector<int> hits(p.size(), 0);
    int rows_hit = 0;
    for (int r = 0; r < n_rows; ++r) {
      const double of_row = uniform(random);
      bool some = false;
      for (std::size_t s = 0; s < p.size(); ++s) {
        const bool hit = (shared ? of_row : uniform(random)) < p[s];
        hits[s] += hit;
        some |= hit;
      }
      rows_hit += some;
    }
    AnyHit any(p.size(), n_rows);
    any.next_cell();
    for (const int h : hits)
      if (h > 0) any.add(h, n_rows);
    const auto holds = [](const ProbabilityBounds& b, double x) {
      return b.lower <= x && x <= b.upper;
    };
    held.any += holds(any.bounds(), truth);
    held.any_rows += holds(wilson_interval(rows_hit, n_rows, z_90), truth_of_rows);
  }
  return {held.any / trials, held.any_rows / trials};
}

/// An interval of 90 % after Wilson holds the truth in 90 % of the cases on average over p; where p
/// is small and members are few, in 85 % at the least (Brown, Cai and DasGupta 2001, figure 5).
TEST(AnyHit, BoundsHoldTheTruthForSharedRowsAndForOthers) {
  const std::vector<std::vector<double>> regions{
      {0.3}, {0.1, 0.2, 0.4}, {0.5, 0.5}, {0.05, 0.05, 0.05, 0.05, 0.05, 0.05}, {0.9, 0.2}};
  for (const auto& p : regions)
    for (const int n_rows : {16, 64})
      for (const bool shared : {false, true}) {
        const Coverage c = coverage(p, n_rows, shared);
        const bool rare_together = p.size() == 6 && n_rows == 16 && shared;
        const std::string which = std::to_string(p.size()) + " sources, " + std::to_string(n_rows) +
                                  " rows, " + (shared ? "shared" : "of their own");
        // Missed: half of the cases. Known (any_hit.hpp, decision 0050); when it is mended, this
        // says so.
        if (rare_together)
          EXPECT_LT(c.any, 0.85) << which;
        else
          EXPECT_GE(c.any, 0.85) << which;
        EXPECT_GE(c.any_rows, 0.85) << which;
      }
}

}  // namespace
}  // namespace sturz
