// SPDX-License-Identifier: Apache-2.0
/// What is exceeded how often, from members of several scenarios.
///
/// A scenario i comes f_i times a year, and each of its n_i valid members stands for f_i / n_i of
/// these. So the annual rate at which x is reached or exceeded is
///   lambda(x) = sum_i f_i P_i(X >= x) = sum over members with X >= x of f_i / n_i
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace sturz {

/// A scenario as its members count.
struct ScenarioRate {
  double frequency = 0;       ///< 1/year
  std::size_t n_members = 0;  ///< valid ones
};

/// Peak of one member at one place.
struct ScenarioPeak {
  float value = 0;
  std::size_t scenario = 0;
};

/// Annual rate of what `hits[i]` of the members of scenario i do [1/year].
double annual_rate(std::span<const ScenarioRate> scenarios, std::span<const std::size_t> hits);

/// Monte Carlo standard error of that rate: sqrt(sum_i f_i^2 p_i (1 - p_i) / n_i), of independent
/// members [1/year].
double annual_rate_error(std::span<const ScenarioRate> scenarios,
                         std::span<const std::size_t> hits);

/// A rate is as large as another one up to round-off of its sum.
bool reaches_rate(double rate, double wanted);

/// The largest peak v with lambda(v) >= 1/T for each return period: what is reached or exceeded at
/// least once in T years on average. 0 where nothing is. Members that are not listed have 0.
/// \param peaks changed: sorted
/// \param periods years, rising
std::vector<double> return_levels(std::span<const ScenarioRate> scenarios,
                                  std::vector<ScenarioPeak>& peaks,
                                  std::span<const double> periods);

}  // namespace sturz
