// SPDX-License-Identifier: Apache-2.0
/// Where the deposit of a collapse ends.
#pragma once

#include <cstddef>
#include <vector>

namespace sturz::test {

/// Distances from the axis, in the unit of dx.
struct DepositEdge {
  double contour = 0;  ///< where it gets thinner than max(dx/2, 5 cm), docs/physics.md C.5
  /// Where its slope between that and twice that thickness meets the ground. Experiments measure to
  /// the last grains that touch each other; grains are much smaller than dx.
  double toe = 0;
};

/// \param thickness  means over rings or slices of width dx, from the axis outwards [m]
DepositEdge deposit_edge(const std::vector<double>& thickness, double dx);

/// Adds to slice k, making room for it.
void add_to_slice(std::vector<double>& thickness, std::size_t k, double share);

}  // namespace sturz::test
