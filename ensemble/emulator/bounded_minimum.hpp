// SPDX-License-Identifier: Apache-2.0
/// Smallest value of a function on a box, without its derivatives.
#pragma once

#include <functional>
#include <span>
#include <vector>

namespace sturz {

struct Minimum {
  std::vector<double> at;  ///< [n], in the box
  double value = 0;
};

/// Local search from `start` by linear models on a shrinking simplex (COBYLA, Powell 1994; by
/// OpenTURNS) on the unit cube [0, 1]^n. It draws nothing: the same call gives the same bits.
/// What is returned is the best point that was looked at, `start` if nothing is better; a search
/// that ends for want of evaluations is no error.
/// \param function of n numbers in [0, 1]; must be finite
/// \param start [n], in the cube
/// \param evaluations at most about so many
Minimum bounded_minimum(const std::function<double(std::span<const double>)>& function,
                        std::vector<double> start, int evaluations);

}  // namespace sturz
