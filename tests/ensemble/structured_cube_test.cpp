// SPDX-License-Identifier: Apache-2.0
#include "ensemble/sampling/structured_cube.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace sturz {
namespace {

using Cube = std::vector<std::vector<double>>;

TEST(MorrisCube, MovesEveryCoordinateOnceByHalfTheCube) {
  constexpr std::size_t n_dims = 5, n_sets = 40;
  const Cube cube = morris_cube(n_sets * (n_dims + 1), n_dims, 11);
  for (std::size_t s = 0; s < n_sets; ++s) {
    std::set<std::size_t> moved;
    for (std::size_t i = 1; i <= n_dims; ++i) {
      const auto &a = cube[s * (n_dims + 1) + i - 1], &b = cube[s * (n_dims + 1) + i];
      for (std::size_t d = 0; d < n_dims; ++d)
        if (a[d] != b[d]) {
          EXPECT_EQ(std::abs(a[d] - b[d]), morris_step);
          EXPECT_TRUE(moved.insert(d).second);
        }
    }
    EXPECT_EQ(moved.size(), n_dims);
  }
}

TEST(MorrisCube, UsesEveryLevelAndOrder) {
  const Cube cube = morris_cube(1800, 2, 5);
  std::set<double> levels;
  int first_moves_first = 0;
  for (std::size_t s = 0; s < 600; ++s) {
    levels.insert(cube[3 * s][0]);
    first_moves_first += cube[3 * s][0] != cube[3 * s + 1][0];
  }
  EXPECT_EQ(levels.size(), 8U);
  EXPECT_NEAR(first_moves_first, 300, 4 * 12.3);  // binomial, four standard deviations
}

TEST(SaltelliCube, ExchangesOneCoordinateAtATime) {
  constexpr std::size_t n_dims = 3, set = n_dims + 2;
  const Cube cube = saltelli_cube(16 * set, n_dims, 3);
  for (std::size_t s = 0; s < 16; ++s)
    for (std::size_t k = 0; k < n_dims; ++k)
      for (std::size_t d = 0; d < n_dims; ++d)
        EXPECT_EQ(cube[s * set + 2 + k][d], cube[s * set + (d == k ? 1 : 0)][d]);
}

TEST(StructuredCube, LongerTablesStartWithShorterOnesAndSeedsDiffer) {
  for (const auto draw : {morris_cube, saltelli_cube}) {
    const Cube longer = draw(60, 4, 9), shorter = draw(25, 4, 9);
    EXPECT_TRUE(std::equal(shorter.begin(), shorter.end(), longer.begin()));
    EXPECT_NE(draw(25, 4, 10), shorter);
    for (const auto& row : longer)
      for (const double u : row) EXPECT_TRUE(u > 0 && u < 1);
  }
}

}  // namespace
}  // namespace sturz
