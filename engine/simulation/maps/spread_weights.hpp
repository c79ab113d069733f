// SPDX-License-Identifier: Apache-2.0
/// How one particle is shared out among cells: a quadratic B-spline in each direction.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

namespace sturz {

/// Quadratic B-spline of unit width: support 1.5 each side, integral one.
inline double b_spline(double t) {
  const double outer = std::max(0.0, 1.5 - std::abs(t)), inner = std::max(0.0, 0.5 - std::abs(t));
  return 0.5 * outer * outer - 1.5 * inner * inner;
}

/// Weights of one particle along one direction, summing to one over the cells on and off the grid.
/// \tparam n_fixed number of cells known to the compiler, 0: `n_cells` says it
/// \param place   in cells from the centre of cell 0
/// \return the first cell
template <int n_fixed>
inline int spread_weights(double place, double width_cells, int n_cells, double* weight) {
  const int n = n_fixed > 0 ? n_fixed : n_cells;
  const double first = std::floor(place - 1.5 * width_cells) + 1;
  const double per_width = 1 / width_cells;
  double sum = 0;
  for (int k = 0; k < n; ++k) {
    weight[k] = b_spline((place - first - k) * per_width);
    sum += weight[k];
  }
  const double scale = 1 / sum;
  for (int k = 0; k < n; ++k) weight[k] *= scale;
  return static_cast<int>(first);
}

/// Weights of both directions. \return first row and column
template <int n_fixed>
inline std::pair<int, int> weights(double x, double y, double width, int n, double* wx,
                                   double* wy) {
  const int col = spread_weights<n_fixed>(x, width, n, wx);
  return {spread_weights<n_fixed>(y, width, n, wy), col};
}

/// The usual narrow spreads get loops of known length.
inline std::pair<int, int> weights(double x, double y, double width, int n, double* wx,
                                   double* wy) {
  switch (n) {
    case 3:
      return weights<3>(x, y, width, n, wx, wy);
    case 4:
      return weights<4>(x, y, width, n, wx, wy);
    case 5:
      return weights<5>(x, y, width, n, wx, wy);
    case 6:
      return weights<6>(x, y, width, n, wx, wy);
    default:
      return weights<0>(x, y, width, n, wx, wy);
  }
}

}  // namespace sturz
