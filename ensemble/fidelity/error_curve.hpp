// SPDX-License-Identifier: Apache-2.0
/// An error as a function of the spacing.
#pragma once

#include <utility>
#include <vector>

namespace sturz {

/// An estimated error over the spacing: a power between those that were asked about, and the last
/// power beyond the finest of them.
class ErrorCurve {
 public:
  ErrorCurve() = default;
  /// \param spacings_m coarsest first, as many as errors
  ErrorCurve(std::vector<double> spacings_m, std::vector<double> errors)
      : spacings_m_(std::move(spacings_m)), errors_(std::move(errors)) {}
  /// NaN where nothing is known; the coarsest error above the coarsest spacing.
  double at(double spacing_m) const;

 private:
  std::vector<double> spacings_m_, errors_;
};

}  // namespace sturz
