// SPDX-License-Identifier: Apache-2.0
/// Quantiles of a few numbers, many of which may be zero.
#pragma once

#include <span>

namespace sturz {

/// Quantile of a sample made of `n_zeros` zeros and `sorted` (ascending, none negative): linear
/// between order statistics x_0 .. x_{n-1}, which lie at fractions i / (n - 1) (definition 7 of
/// Hyndman & Fan 1996). NaN for an empty sample.
/// \param fraction in [0, 1]
double sample_quantile(std::span<const float> sorted, std::size_t n_zeros, double fraction);

}  // namespace sturz
