// SPDX-License-Identifier: Apache-2.0
/// Elementary effects: what matters, from few members (Morris 1991; Campolongo and others 2007).
#pragma once

#include "ensemble/censoring/censored_quantile.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace sturz {

/// Of one uncertain value. An effect is the difference of the result over the step in the unit cube
/// of the prior: the change that the whole range of the prior would make at that slope.
struct MorrisMeasure {
  double mean = 0;                 ///< mu: falls or grows; near 0 beside a large mu* it does both
  double mean_absolute = 0;        ///< mu*: how much it matters
  double mean_absolute_error = 0;  ///< standard error of mu*
  double deviation = 0;            ///< sigma: not straight, or depends on the others
  std::int64_t n = 0;              ///< effects that count
  std::int64_t n_censored = 0;     ///< effects left out: an end of the step is not fully known
};

/// Measures of every coordinate from the trajectories of a design (morris_cube). Only steps
/// between two fully known results count; NaN where there are none (sigma: fewer than two).
/// \param cube [n][n_dims], sets of n_dims + 1 rows in order; a last one that is not whole counts
///   as far as it goes \param results [n]
/// \return [n_dims]
std::vector<MorrisMeasure> morris_measures(const std::vector<std::vector<double>>& cube,
                                           std::span<const Observation> results);

}  // namespace sturz
