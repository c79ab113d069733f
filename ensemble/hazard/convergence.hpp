// SPDX-License-Identifier: Apache-2.0
/// Would more members change the map? Probabilities made from the first N members, N growing.
#pragma once

#include "engine/simulation/member_result.hpp"

#include <cstdint>
#include <vector>

namespace sturz {

/// What the first `n_members` valid members (in order of their number) say. Means go over the
/// cells that any valid member of the whole ensemble reached, so all points share one area.
struct ConvergencePoint {
  std::int64_t n_members = 0;
  double mean_probability_reached = 0;
  double area_likely_m2 = 0;  ///< where P(reached) >= 0.5
  /// Where the 95 % interval of P(reached) lies above 0.5, and where it does so or touches it.
  double area_likely_lower_m2 = 0, area_likely_upper_m2 = 0;
  double area_possible_m2 = 0;  ///< where P(reached) >= 0.05
  double mean_half_width = 0;   ///< half of the 95 % Wilson interval of P(reached)
};

/// At most `max_points` points, evenly spaced in N; the last is the whole ensemble. Empty when
/// there is no valid member; areas and means are 0 when no member reached a cell.
std::vector<ConvergencePoint> probability_convergence(
    const MemberSource& members, std::size_t memory_limit_bytes = std::size_t{512} << 20,
    int max_points = 40);

}  // namespace sturz
