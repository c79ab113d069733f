// SPDX-License-Identifier: Apache-2.0
#include "ensemble/fidelity/checked_error.hpp"

#include <algorithm>
#include <cmath>

namespace sturz {

bool CheckedError::is_told() const { return std::isfinite(said) && std::isfinite(found); }

double CheckedError::factor() const { return std::max(said / found, found / said); }

bool CheckedError::is_met() const {
  if (!is_told()) return false;
  if (found <= noise) return said <= 2 * noise;
  return factor() <= 2;
}

}  // namespace sturz
