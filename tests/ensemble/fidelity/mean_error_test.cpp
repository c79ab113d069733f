// SPDX-License-Identifier: Apache-2.0
// Is what is said of the error of a mean as large as the error? Families whose law is known, from
// bias alone to scatter alone, few members and many, looked at from both sides: an error that is
// told too large is as wrong as one that is told too small.
#include "ensemble/fidelity/error_model.hpp"
#include "tests/ensemble/fidelity/made_up_laws.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace sturz {
namespace {

using test::Law;

const std::vector<double> three{8, 6, 4};
constexpr double finer_m = 2;
constexpr int n_repeats = 15;

/// Deviations in units of the members' scatter, so that scatter small or large is a bias large or
/// small.
struct Family {
  double bias = 0;
  double common = 0;    // over the members' own
  bool slopes = false;  // the members differ in their slopes, three times as much as by chance
  std::size_t n = 0;

  double own() const { return slopes ? 0.3 : 1; }
  double slope() const { return slopes ? 1 : 0; }
  std::string name() const {
    std::ostringstream text;
    text << "bias " << bias << ", common " << common << (slopes ? ", slopes" : ", scatter")
         << ", n " << n;
    return text.str();
  }
};

std::vector<Family> families() {
  std::vector<Family> all;
  for (const double bias : {0.0, 0.3, 3.0, 30.0})
    for (const double common : {0.0, 1.0})
      for (const bool slopes : {false, true})
        for (const std::size_t n : {8, 16, 64, 400}) all.push_back({bias, common, slopes, n});
  return all;
}

/// Root mean square of the error of the mean of very many members at the finest spacing.
double true_to_limit(const Family& f) { return std::hypot(f.bias, f.common * f.own()); }

/// The same of the difference of the mean of n at the finest and at half of it.
double true_to_finer(const Family& f, const Law& law) {
  const double y = finer_m / three.back(), lift = 1 - std::pow(y, law.order);
  const auto n = static_cast<double>(f.n);
  const double drawn =
      (law.common * law.common + law.own * law.own / n) * (1 + std::pow(y, 2 * law.scatter_order));
  return std::sqrt(law.bias * law.bias * lift * lift + drawn +
                   law.slope * law.slope * lift * lift / n);
}

/// No look at three spacings tells the bias of a mean of n better: standard error of generalised
/// least squares where orders (one) and scatter are known. With differences to the finest of
/// lift (1, 1/2) and covariance own^2 / n (5 1; 1 3.25) that is 2.09 own / sqrt(n); the mean slope
/// of n members cannot be told from bias at all.
double known_at_best(const Family& f) {
  return std::hypot(2.09 * f.own(), f.slope()) / std::sqrt(static_cast<double>(f.n));
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

struct Ratios {
  double to_limit = 0, to_finer = 0;  // said over true, median
};
Ratios ratios_of(const Family& f, std::uint64_t seed) {
  const double to_limit =
      f.common > 0 ? true_to_limit(f) : std::max(true_to_limit(f), known_at_best(f));
  std::vector<double> limit, finer;
  double true2 = 0;
  for (std::uint64_t k = 0; k < n_repeats; ++k) {
    Law law{1, f.bias, f.slope(), f.common * f.own(), f.own(), 1};
    law.order = k % 3 == 0 ? 0.7 : k % 3 == 1 ? 1 : 1.4;
    law.scatter_order = k % 5 < 2 ? 0.75 : k % 5 < 4 ? 1 : 1.25;
    const auto said = expected_sizes(three, test::ladder_of(three, law, seed + k, f.n), 0,
                                     std::vector<ErrorQuestion>{{4, 0}, {4, finer_m}});
    limit.push_back(said[0].mean / to_limit);
    finer.push_back(said[1].mean);
    true2 += std::pow(true_to_finer(f, law), 2) / n_repeats;
  }
  return {median(limit), median(finer) / std::sqrt(true2)};
}

bool within(double ratio) { return ratio > 0.5 && ratio < 2; }

/// What is out of the band, found when it was first measured (1 of 128; 2.02).
const std::vector<std::string> missed{"bias 0, common 0, scatter, n 400, to a finer one"};

/// Band, set before anything was measured: the median over repeats is within a factor of two of
/// the root mean square that the family has. Where nothing common scatters, the error of the mean
/// of very many may be zero, and what could be known at best stands in its place.
TEST(ErrorOfTheMean, IsSaidWithinAFactorOfTwoFromBothSides) {
  std::uint64_t seed = 1;
  for (const Family& f : families()) {
    const Ratios r = ratios_of(f, seed += 1000);
    for (const auto& [what, ratio] :
         {std::pair(", to the limit", r.to_limit), std::pair(", to a finer one", r.to_finer)}) {
      const std::string name = f.name() + what;
      const bool known_miss = std::find(missed.begin(), missed.end(), name) != missed.end();
      EXPECT_EQ(within(ratio), !known_miss) << name << ": " << ratio;
    }
  }
}

}  // namespace
}  // namespace sturz
