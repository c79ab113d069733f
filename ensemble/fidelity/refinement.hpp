// SPDX-License-Identifier: Apache-2.0
/// What a result tends to as the spacing shrinks, and how fast.
///
/// Richardson's extrapolation of Q(d) = Q0 + a d^p through the means of three or more spacings
/// (Roache 1998; least squares over p after Eca and Hoekstra 2014, J. Comput. Phys. 262, 104-130).
/// What each spacing is off by is told by error_model.hpp, which knows the scatter of the members
/// too.
#pragma once

#include "engine/core/error.hpp"
#include "engine/terrain/raster.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace sturz {

struct Interval {
  double low = nan_d, high = nan_d;
};

struct Refinement {
  /// The means approach a limit from one side, with an order between 0.5 and 3. Otherwise the
  /// finest mean stands for the limit and the order is NaN.
  bool converges = false;
  double order = nan_d;             ///< p that fits best
  double limit = nan_d;             ///< Q0, with the same order, at most two
  Interval order_90, limit_90;      ///< 90 % intervals by drawing the members anew
  double resampled_converging = 0;  ///< share of those draws that converge too
  std::vector<double> means;        ///< [n_spacings] over the members
  std::vector<double> spacings_m;   ///< as they were given
};

/// \param spacings_m coarsest first, at least one
/// \param values [n_spacings][n_members], the same members (shared draws) at every spacing
/// \param seed of the resampling (200 draws of the members)
/// With fewer than three spacings nothing converges.
/// \throws std::logic_error for spacings that do not descend, or columns of other lengths
Refinement refine(std::span<const double> spacings_m,
                  const std::vector<std::vector<double>>& values, std::uint64_t seed);

}  // namespace sturz
