// SPDX-License-Identifier: Apache-2.0
#include "engine/core/error.hpp"
#include "ensemble/fidelity/error_grid.hpp"
#include "ensemble/fidelity/error_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace sturz {
namespace {

constexpr std::array sizes{0.02, 0.04, 0.06, 0.09, 0.13, 0.18, 0.25, 0.35,
                           0.5,  0.7,  1.0,  1.4,  2.0,  2.8,  4.0};

/// How well the law of distances between maps holds, in logarithms.
constexpr double distance_deviation = 0.15;

}  // namespace

std::vector<double> expected_distances(std::span<const double> spacings_m,
                                       const std::vector<std::vector<double>>& distances,
                                       double noise, std::span<const ErrorQuestion> questions) {
  expect(std::is_sorted(spacings_m.rbegin(), spacings_m.rend()) && !spacings_m.empty() &&
             spacings_m.back() > 0,
         "spacings descend");
  expect(spacings_m.size() == distances.size(), "a row per spacing");
  std::vector<double> found(questions.size(), nan_d);
  const std::size_t n = spacings_m.size();
  double squares = 0;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < i; ++j) squares += distances[i][j] * distances[i][j];
  const double scale = std::sqrt(2 * squares / static_cast<double>(n * (n - 1)));
  if (n < 2 || !std::isfinite(scale)) return found;
  if (!(scale > 0)) {
    std::fill(found.begin(), found.end(), noise);
    return found;
  }
  const double floor2 = noise * noise;
  const auto size_of = [&](const Target& t, double bias, double scatter) {
    return std::sqrt(std::pow(scale * bias * t.lift, 2) +
                     std::pow(scale * scatter, 2) * (t.at + t.finer) + floor2);
  };
  std::vector<ErrorQuestion> pairs;
  std::vector<double> seen;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j) {
      pairs.push_back({spacings_m[i], spacings_m[j]});
      seen.push_back(std::max(distances[i][j], 1e-3 * scale));
    }
  Weighted all(questions.size());
  for (const double p : orders)
    for (const double q : scatter_orders) {
      const std::vector<Target> known = targets_of(spacings_m, pairs, p, q);
      const std::vector<Target> asked = targets_of(spacings_m, questions, p, q);
      for (const double bias : sizes)
        for (const double scatter : sizes) {
          double fit = order_prior(p) + order_prior(q);
          for (std::size_t k = 0; k < known.size(); ++k)
            fit -= 0.5 * std::pow(std::log(seen[k] / size_of(known[k], bias, scatter)) /
                                      distance_deviation,
                                  2);
          all.take(fit, [&](std::vector<double>& sums, double w) {
            for (std::size_t k = 0; k < asked.size(); ++k)
              sums[k] += w * size_of(asked[k], bias, scatter);
          });
        }
    }
  for (std::size_t k = 0; k < questions.size(); ++k) found[k] = all.average(k);
  return found;
}

}  // namespace sturz
