// SPDX-License-Identifier: Apache-2.0
/// Does a result grow with a parameter? Counted over pairs whose order is known.
#pragma once

#include "ensemble/censoring/censored_quantile.hpp"

#include <cstdint>
#include <span>

namespace sturz {

/// Kendall's tau over the pairs that can be ordered (for censored values: Harrell's concordance,
/// 2 C - 1; Harrell and others 1982).
struct RankAgreement {
  double tau = nan_d;        ///< -1 falls .. 1 grows; NaN: no pair can be ordered
  std::int64_t ordered = 0;  ///< pairs whose order of the result is known
  std::int64_t pairs = 0;    ///< all of them
};

/// Pairs with equal parameters or results say nothing and are left out. One value that is at least
/// c is larger than every fully known one up to c; two such values have no order.
/// \param parameter [n], \param result [n]; rows that are not finite are left out. O(n^2).
RankAgreement rank_agreement(std::span<const double> parameter,
                             std::span<const Observation> result);

}  // namespace sturz
