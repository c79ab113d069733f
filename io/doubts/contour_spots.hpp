// SPDX-License-Identifier: Apache-2.0
/// The mark that an interpolation between contour lines leaves: flat spots at their levels.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace sturz {

struct ContourSpots {
  double interval_m = 0;  ///< between the lines
  std::size_t cells = 0;  ///< flat and at a level
  int levels = 0;         ///< at which most flat cells lie on the line
  std::size_t first_cell = 0;
};

/// \param values [n_rows][n_cols] metres, NaN = nodata
/// \return nothing unless five levels or more have ten flat cells (equal to their neighbours east,
///   south and south-east within 1 cm) on the line, four times as many as off it, and these are at
///   least 60 % of all levels with flat cells. Intervals of 5 to 100 m and 20 to 200 ft are tried,
///   the widest that fits is told
std::optional<ContourSpots> contour_spots(std::span<const double> values, int n_rows, int n_cols);

}  // namespace sturz
