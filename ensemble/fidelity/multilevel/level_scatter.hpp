// SPDX-License-Identifier: Apache-2.0
/// How far increments scatter where that depends on the size of the result.
#pragma once

#include "ensemble/fidelity/multilevel/increments.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace sturz {

/// Few draws of a dear level seldom have the largest results, whose increments are the largest, and
/// so scatter less than all do. Of how many there are, the many draws of the cheapest level tell:
/// the square of an increment is fitted as a + b d^2, where d is how far the cheapest level's
/// prediction lies from its mean (a, b >= 0, relative least squares), and averaged over all draws.
class LevelScatter {
 public:
  explicit LevelScatter(std::size_t n_levels) : n_levels_(n_levels) {}
  /// \param told as IncrementMoments::add()
  void add(std::size_t from, std::span<const double> told);
  /// Variances of the increments as the fit has them over all draws; of the cheapest level 0, whose
  /// own draws tell it. \return [n_levels]
  std::vector<double> expected() const;
  /// Standard error of each level's sample variance over it: sqrt((k - 1) / n), with a kurtosis k
  /// of 3 or more. \return [n_levels]
  std::vector<double> doubt() const;

 private:
  struct One {
    double increment, size;
  };
  std::size_t n_levels_;
  std::array<std::vector<One>, most_levels>
      of_level_;                          ///< of the draws that have it; the last: predictions
  double n_ = 0, sum_ = 0, squares_ = 0;  ///< sizes of all draws, less the first
  double first_ = 0;
};

}  // namespace sturz
