// SPDX-License-Identifier: Apache-2.0
#include "ensemble/fidelity/power_law.hpp"

#include "engine/core/error.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace sturz {

double PowerLaw::at(double x) const { return factor * std::pow(x, exponent); }

PowerLaw fit_power_law(std::span<const double> x, std::span<const double> y, double assumed) {
  expect(x.size() == y.size(), "a value per place");
  PowerLaw law;
  if (x.empty()) return law;
  const auto n = static_cast<double>(x.size());
  double mean_x = 0, mean_y = 0, xx = 0, xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    expect(x[i] > 0 && y[i] > 0, "logarithms need positive numbers");
    mean_x += std::log(x[i]) / n;
    mean_y += std::log(y[i]) / n;
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += std::pow(std::log(x[i]) - mean_x, 2);
    xy += (std::log(x[i]) - mean_x) * (std::log(y[i]) - mean_y);
  }
  law.exponent = xx > 0 ? xy / xx : assumed;
  law.factor = std::exp(mean_y - law.exponent * mean_x);
  law.worst_ratio = 1;
  for (std::size_t i = 0; i < x.size(); ++i)
    law.worst_ratio = std::max({law.worst_ratio, law.at(x[i]) / y[i], y[i] / law.at(x[i])});
  return law;
}

}  // namespace sturz
