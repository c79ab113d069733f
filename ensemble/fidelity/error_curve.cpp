// SPDX-License-Identifier: Apache-2.0
#include "ensemble/fidelity/error_curve.hpp"

#include "engine/terrain/raster.hpp"

#include <cmath>
#include <cstddef>

namespace sturz {

double ErrorCurve::at(double spacing_m) const {
  if (errors_.empty()) return nan_d;
  if (errors_.size() == 1 || spacing_m >= spacings_m_.front()) return errors_.front();
  std::size_t l = 1;
  while (l + 1 < spacings_m_.size() && spacing_m < spacings_m_[l]) ++l;
  if (!(errors_[l] > 0) || !(errors_[l - 1] > 0)) return errors_[l];
  const double power =
      std::log(errors_[l - 1] / errors_[l]) / std::log(spacings_m_[l - 1] / spacings_m_[l]);
  return errors_[l] * std::pow(spacing_m / spacings_m_[l], power);
}

}  // namespace sturz
