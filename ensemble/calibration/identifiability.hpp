// SPDX-License-Identifier: Apache-2.0
/// What the observations tell of each uncertain value, and of which combinations only.
#pragma once

#include "ensemble/calibration/posterior.hpp"
#include "ensemble/sampling/copula.hpp"

#include <vector>

namespace sturz {

/// A direction in the unit cube of the keys (each value as its place in its prior, correlations of
/// the prior applied) along which the posterior is 1 / variance_left times narrower (in variance)
/// than the prior.
struct Direction {
  double variance_left = 1;   ///< posterior variance along it over the prior's
  std::vector<double> along;  ///< [n_dims], length 1, largest component positive
};

/// Two values of which the observations tell a combination rather than each: friction and pore
/// pressure, or the two coefficients of Voellmy.
struct Ridge {
  std::size_t a = 0, b = 0;
  double correlation = 0;  ///< of the posterior, in the unit cube of the keys
};

/// Variances are those of a sample: by weights that one member holds alone nothing is told, and
/// they are NaN.
struct Identifiability {
  std::vector<double> mean, sd;                  ///< [n_dims] of the posterior, as above
  std::vector<double> variance_removed;          ///< [n_dims]: 1 - variance / (1/12), not below 0
  std::vector<std::vector<double>> correlation;  ///< [n_dims][n_dims]
  std::vector<Direction> directions;             ///< [n_dims], the best known one first
  /// |correlation| of 0.6 and more that the prior does not have, strongest first.
  std::vector<Ridge> ridges;
};

/// \param copula of the keys; null: they are independent
Identifiability identifiability_of(const Posterior&, const Copula* copula = nullptr);

}  // namespace sturz
