// SPDX-License-Identifier: Apache-2.0
#include "ensemble/fidelity/error_grid.hpp"

#include <algorithm>
#include <cmath>

namespace sturz {

double order_prior(double order) {
  constexpr double order_mean = 1, order_deviation = 0.4;
  return -0.5 * std::pow((order - order_mean) / order_deviation, 2);
}

std::vector<Target> targets_of(std::span<const double> spacings,
                               std::span<const ErrorQuestion> questions, double p, double q) {
  std::vector<Target> targets;
  for (const ErrorQuestion& question : questions) {
    Target t;
    const double x = question.spacing_m / spacings.back(), y = question.finer_m / spacings.back();
    t.lift = std::pow(x, p) - (y > 0 ? std::pow(y, p) : 0);
    t.at = std::pow(x, 2 * q);
    t.finer = y > 0 ? std::pow(y, 2 * q) : 0;
    const auto place = std::find(spacings.begin(), spacings.end(), question.spacing_m);
    if (place != spacings.end()) t.level = place - spacings.begin();
    targets.push_back(t);
  }
  return targets;
}

}  // namespace sturz
