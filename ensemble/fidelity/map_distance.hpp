// SPDX-License-Identifier: Apache-2.0
/// How far two maps of a probability lie apart.
#pragma once

#include "engine/core/cancel.hpp"
#include "engine/simulation/member_parts.hpp"

#include <cstdint>
#include <vector>

namespace sturz {

/// Share of members whose peak thickness exceeds `threshold_m`, in the cells of `extent`.
/// \param numbers of the members that count, ascending; all are there \throws Cancelled
Raster<double> share_thicker(const MemberParts&, const std::vector<std::int64_t>& numbers,
                             const Window& extent, double threshold_m, CancelFlag cancel = {});

struct MapDistance {
  double area_between_m2 = 0;  ///< sum over cells of |P - Q| times the cell's area
  double mean_area_m2 = 0;     ///< the same of Q: the mean area of a member
  double worst_cell = 0;       ///< largest |P - Q|
  /// Mean distance between the outlines of P >= 0.5 and Q >= 0.5, both ways; NaN where one is
  /// empty.
  double boundary_m = nan_d;
  /// area_between_m2 over mean_area_m2; NaN where nothing is reached.
  double relative() const { return mean_area_m2 > 0 ? area_between_m2 / mean_area_m2 : nan_d; }
};

/// \pre both lie on one grid
MapDistance map_distance(const Raster<double>& p, const Raster<double>& q);

}  // namespace sturz
