// SPDX-License-Identifier: Apache-2.0
/// How sure a probability is that was counted from a few members.
#pragma once

#include <cstdint>

namespace sturz {

struct ProbabilityBounds {
  double lower = 0, upper = 1;
};

/// Quantiles of the standard normal for two-sided intervals of 90 and 95 %.
inline constexpr double z_90 = 1.6448536269514722, z_95 = 1.959963984540054;

/// Two-sided score interval of a probability (Wilson 1927) after `hits` of `trials`:
///   (k + z^2/2 +- z sqrt(k (n - k) / n + z^2/4)) / (n + z^2)
/// It holds for independent members; Latin hypercube and Sobol' members scatter less, so there
/// it errs on the wide side. NaN for no trials.
/// \param z of the interval: 95 % unless told
ProbabilityBounds wilson_interval(std::int64_t hits, std::int64_t trials, double z = z_95);
/// The 95 % interval for a share of members that do not count alike, as if it had come from
/// `effective` members that do. NaN for none.
ProbabilityBounds wilson_interval_of_share(double share, double effective);

}  // namespace sturz
