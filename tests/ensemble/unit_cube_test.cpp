// SPDX-License-Identifier: Apache-2.0
#include "ensemble/sampling/unit_cube.hpp"

#include "engine/core/error.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace sturz {
namespace {

using Cube = std::vector<std::vector<double>>;

/// How many points fall into each of n equal slices of dimension d.
std::vector<int> slices(const Cube& cube, std::size_t d, std::size_t n) {
  std::vector<int> count(n, 0);
  for (const auto& row : cube) ++count[static_cast<std::size_t>(row[d] * static_cast<double>(n))];
  return count;
}

class EveryDesign : public testing::TestWithParam<Design> {};

TEST_P(EveryDesign, HasTheMomentsOfTheUniformDistribution) {
  constexpr std::size_t n = 4096, n_dims = 5;
  const Cube cube = draw_unit_cube(GetParam(), n, n_dims, 7);
  ASSERT_EQ(cube.size(), n);
  for (std::size_t a = 0; a < n_dims; ++a) {
    for (std::size_t b = a; b < n_dims; ++b) {
      double mean = 0, product = 0;
      for (const auto& row : cube) {
        mean += row[a] / n;
        product += (row[a] - 0.5) * (row[b] - 0.5) / n;
      }
      EXPECT_NEAR(mean, 0.5, 4 * std::sqrt(1.0 / 12 / n));
      const double sd_of_product = a == b ? std::sqrt(1.0 / 180) : 1.0 / 12;
      EXPECT_NEAR(product, a == b ? 1.0 / 12 : 0, 4 * sd_of_product / std::sqrt(1.0 * n));
    }
  }
}

TEST_P(EveryDesign, IsAFunctionOfTheSeed) {
  const Cube first = draw_unit_cube(GetParam(), 64, 3, 42);
  draw_unit_cube(Design::monte_carlo, 17, 2, 99);  // moves the process-wide generator on
  EXPECT_EQ(draw_unit_cube(GetParam(), 64, 3, 42), first);
  EXPECT_NE(draw_unit_cube(GetParam(), 64, 3, 43), first);
  EXPECT_NE(draw_unit_cube(GetParam(), 64, 3, 42 + (1ULL << 40)), first);  // all 64 bits count
}

TEST_P(EveryDesign, StaysInsideTheOpenCube) {
  for (const auto& row : draw_unit_cube(GetParam(), 2000, 2, 3))
    for (const double u : row) {
      EXPECT_GE(u, unit_margin);
      EXPECT_LE(u, 1 - unit_margin);
    }
}

TEST_P(EveryDesign, GivesEmptyRowsWithoutDimensionsAndOneRowOnDemand) {
  EXPECT_EQ(draw_unit_cube(GetParam(), 5, 0, 1), Cube(5));
  EXPECT_EQ(draw_unit_cube(GetParam(), 1, 4, 1).at(0).size(), 4U);
}

INSTANTIATE_TEST_SUITE_P(Designs, EveryDesign,
                         testing::Values(Design::monte_carlo, Design::latin_hypercube,
                                         Design::sobol),
                         [](const auto& which) {
                           return which.param == Design::sobol         ? "Sobol"
                                  : which.param == Design::monte_carlo ? "MonteCarlo"
                                                                       : "LatinHypercube";
                         });

TEST(LatinHypercube, PutsOnePointIntoEachSliceOfEachDimension) {
  for (const std::size_t n : {1U, 2U, 7U, 100U, 257U}) {
    const Cube cube = draw_unit_cube(Design::latin_hypercube, n, 6, n);
    for (std::size_t d = 0; d < 6; ++d)
      EXPECT_EQ(slices(cube, d, n), std::vector<int>(n, 1)) << n << " points, dimension " << d;
  }
}

TEST(LatinHypercube, JittersInsideTheSlices) {
  constexpr std::size_t n = 64;
  std::set<double> places;
  for (const auto& row : draw_unit_cube(Design::latin_hypercube, n, 1, 5))
    places.insert(row[0] * n - std::floor(row[0] * n));
  EXPECT_EQ(places.size(), n);
}

TEST(SobolDesign, PutsOnePointIntoEachSliceOfEachDimensionForPowersOfTwo) {
  const Cube cube = draw_unit_cube(Design::sobol, 256, 8, 11);
  for (std::size_t d = 0; d < 8; ++d)
    EXPECT_EQ(slices(cube, d, 256), std::vector<int>(256, 1)) << "dimension " << d;
}

TEST(SobolDesign, FillsTheSquaresOfItsFirstTwoDimensionsEvenly) {
  // The first two dimensions are a (0, m, 2)-net: any split of 2^8 equal boxes has one point each.
  const Cube cube = draw_unit_cube(Design::sobol, 256, 2, 23);
  for (int bits = 0; bits <= 8; ++bits) {
    const double wide = std::exp2(bits), high = std::exp2(8 - bits);
    std::set<std::pair<int, int>> boxes;
    for (const auto& row : cube)
      boxes.emplace(static_cast<int>(row[0] * wide), static_cast<int>(row[1] * high));
    EXPECT_EQ(boxes.size(), 256U) << bits << " bits in the first dimension";
  }
}

class ExtendableDesign : public testing::TestWithParam<Design> {};

TEST_P(ExtendableDesign, StartsWithTheShorterOneBitByBit) {
  const Cube longer = draw_unit_cube(GetParam(), 512, 7, 2024);
  const Cube shorter = draw_unit_cube(GetParam(), 256, 7, 2024);
  EXPECT_TRUE(std::equal(shorter.begin(), shorter.end(), longer.begin()));
}

INSTANTIATE_TEST_SUITE_P(Designs, ExtendableDesign,
                         testing::Values(Design::monte_carlo, Design::sobol),
                         [](const auto& which) {
                           return which.param == Design::sobol ? "Sobol" : "MonteCarlo";
                         });

TEST(SobolDesign, KeepsAColumnWhenAKeyIsAdded) {
  const Cube two = draw_unit_cube(Design::sobol, 128, 2, 5),
             three = draw_unit_cube(Design::sobol, 128, 3, 5);
  for (std::size_t i = 0; i < two.size(); ++i)
    for (std::size_t d = 0; d < 2; ++d) EXPECT_EQ(two[i][d], three[i][d]);
}

TEST(SobolDesign, AveragesBetterThanMonteCarlo) {
  // Integral of a smooth product over the cube, exactly 1; 20 seeds each.
  const auto error = [](Design design) {
    double squares = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      double mean = 0;
      for (const auto& row : draw_unit_cube(design, 256, 4, seed)) {
        double product = 1;
        for (const double u : row) product *= 1 + 0.8 * (u - 0.5);
        mean += product / 256;
      }
      squares += (mean - 1) * (mean - 1) / 20;
    }
    return std::sqrt(squares);
  };
  EXPECT_LT(error(Design::sobol), 0.1 * error(Design::monte_carlo));
}

TEST(UnitCube, OfAUsersTableIsNotDrawn) {
  EXPECT_THROW(draw_unit_cube(Design::table, 8, 2, 1), std::logic_error);
}

}  // namespace
}  // namespace sturz
