// SPDX-License-Identifier: Apache-2.0
/// Members whose law of error is known.
#pragma once

#include "engine/core/random.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

namespace sturz::test {

inline double normal_number(std::uint64_t seed, std::uint64_t a, std::uint64_t b) {
  return std::sqrt(-2 * std::log(unit_random(seed, a, b) + 1e-300)) *
         std::cos(2 * std::numbers::pi * unit_random(seed + 1000003, a, b));
}

/// Error of a member: (bias + slope) x^order + (common + own) x^scatter_order; all but the bias are
/// deviations.
struct Law {
  double order = 1, bias = 0, slope = 0, common = 0, own = 0, scatter_order = 1;
};

/// Members of the law at one spacing, in units of the finest one; `level` tells the draws of
/// spacings apart.
inline std::vector<double> members_of(const Law& law, double x, std::uint64_t level,
                                      std::uint64_t seed, std::size_t n = 16) {
  std::vector<double> values;
  const double common = law.common * normal_number(seed, 1, 900 + level);
  for (std::size_t m = 0; m < n; ++m)
    values.push_back(1000 * (1 + 0.1 * normal_number(seed, 2, m)) +
                     (law.bias + law.slope * normal_number(seed, 3, m)) * std::pow(x, law.order) +
                     (common + law.own * normal_number(seed, 10 + level, m)) *
                         std::pow(x, law.scatter_order));
  return values;
}

/// [n_spacings][n], coarsest first as the spacings are.
inline std::vector<std::vector<double>> ladder_of(const std::vector<double>& spacings,
                                                  const Law& law, std::uint64_t seed,
                                                  std::size_t n = 16) {
  std::vector<std::vector<double>> values;
  for (std::size_t l = 0; l < spacings.size(); ++l)
    values.push_back(members_of(law, spacings[l] / spacings.back(), l, seed, n));
  return values;
}

}  // namespace sturz::test
