// SPDX-License-Identifier: Apache-2.0
#include "ensemble/comparison/paired_difference.hpp"

#include "ensemble/hazard/wilson.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sturz {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

double number(std::int64_t k) { return static_cast<double>(k); }

/// Correlation of the two shares; 0 where one of them is 0 or 1.
double correlation(const PairCounts& c) {
  const double a = number(c.both), b = number(c.only_a), e = number(c.only_b),
               d = number(c.neither);
  const double product = (a + b) * (e + d) * (a + e) * (b + d);
  if (!(product > 0)) return 0;
  double numerator = a * d - b * e;
  if (numerator > 0) numerator = std::max(numerator - number(c.n()) / 2, 0.0);
  return numerator / std::sqrt(product);
}

/// Square root of x^2 - 2 phi x y + y^2, which round-off may take below 0.
double side(double x, double y, double phi) {
  return std::sqrt(std::max(0.0, x * x - 2 * phi * x * y + y * y));
}

DifferenceBounds square_and_add(std::int64_t hits_a, std::int64_t n_a, std::int64_t hits_b,
                                std::int64_t n_b, double phi) {
  if (n_a == 0 || n_b == 0) return {nan, nan, nan};
  const double a = number(hits_a) / number(n_a), b = number(hits_b) / number(n_b);
  const ProbabilityBounds of_a = wilson_interval(hits_a, n_a), of_b = wilson_interval(hits_b, n_b);
  const double difference = b - a;
  return {difference, std::max(-1.0, difference - side(b - of_b.lower, of_a.upper - a, phi)),
          std::min(1.0, difference + side(a - of_a.lower, of_b.upper - b, phi))};
}

}  // namespace

DifferenceBounds paired_difference(const PairCounts& c) {
  return square_and_add(c.a(), c.n(), c.b(), c.n(), correlation(c));
}

DifferenceBounds unpaired_difference(std::int64_t hits_a, std::int64_t n_a, std::int64_t hits_b,
                                     std::int64_t n_b) {
  return square_and_add(hits_a, n_a, hits_b, n_b, 0);
}

}  // namespace sturz
