// SPDX-License-Identifier: Apache-2.0
#include "ensemble/scores/score_sheet.hpp"

#include "engine/core/error.hpp"
#include "engine/terrain/raster.hpp"

#include <algorithm>
#include <cmath>

namespace sturz {

Observation misfit(const std::vector<ObservedQuantity>& observed,
                   const std::vector<Observation>& simulated) {
  expect(observed.size() == simulated.size(), "one simulated value for each quantity");
  Observation result{nan_d, Known::exactly};
  double sum = 0, n = 0;
  for (std::size_t i = 0; i < observed.size(); ++i) {
    const Observation& s = simulated[i];
    const double z = (s.value - observed[i].value) / observed[i].sd;
    const bool bound = s.known == Known::at_least && z >= 0;
    if (bound) result.known = std::max(result.known, Known::at_least);
    if (s.known != Known::exactly && !bound) {
      result.known = Known::not_at_all;
      continue;
    }
    sum += z * z;
    ++n;
  }
  if (n > 0)
    result.value = std::sqrt(sum / n);
  else
    result.known = Known::not_at_all;
  return result;
}

}  // namespace sturz
