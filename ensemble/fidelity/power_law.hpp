// SPDX-License-Identifier: Apache-2.0
/// Seconds of a member over its spacing, as a power.
#pragma once

#include "engine/terrain/raster.hpp"

#include <span>

namespace sturz {

/// y = factor x^exponent; NaN where it could not be fitted.
struct PowerLaw {
  double factor = nan_d, exponent = nan_d;
  double worst_ratio = nan_d;  ///< of fit and value, the larger over the smaller, >= 1
  double at(double x) const;
};

/// Least squares of the logarithms. One point gives the exponent `assumed`.
/// \pre x and y are positive and as many
PowerLaw fit_power_law(std::span<const double> x, std::span<const double> y, double assumed);

}  // namespace sturz
