// SPDX-License-Identifier: Apache-2.0
/// Quantiles of members that do not count alike, many of which may be zero.
#pragma once

#include <span>

namespace sturz {

struct WeighedValue {
  float value = 0;
  double weight = 0;
};

/// Mean of the weighted inverse distribution over a window as wide as one effective member, from
/// f (n - 1) / n to that and 1 / n, n = `effective` (Akinshin 2023, of definition 7 of Hyndman and
/// Fan 1996: the same number where all weights are equal). Ties and weightless values leave no
/// trace. NaN for an empty sample.
/// \param sorted ascending, none negative, weights >= 0
/// \param zero_weight of the values 0 that are not in `sorted`
/// \param effective number of members, >= 1 \param fraction in [0, 1]
double weighted_map_quantile(std::span<const WeighedValue> sorted, double zero_weight,
                             double effective, double fraction);

}  // namespace sturz
