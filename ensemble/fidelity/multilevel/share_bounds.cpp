// SPDX-License-Identifier: Apache-2.0
#include "ensemble/fidelity/multilevel/share_bounds.hpp"

#include "engine/core/error.hpp"
#include "ensemble/fidelity/multilevel/increments.hpp"

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

constexpr double beyond_a_bound = 0.05;  // on each side of 90 %

/// How far a share may lie higher: the largest d with
///   d^2 <= width^2 (error^2 + (d lean - d^2) / n).
/// \param cubes of surprises upwards
double reach(double share, double error, double width, double n, double squares, double cubes) {
  const double lean =
      std::max(0.0, 1 - 2 * share) * std::clamp((cubes + 1) / (squares + 1), 0.0, 1.0);
  const double w2 = width * width, a = 1 + w2 / n, b = w2 * lean / n;
  return (b + std::sqrt(b * b + 4 * a * w2 * error * error)) / (2 * a);
}

}  // namespace

Interval share_bounds(double share, double standard_error, double degrees, const Surprises& s) {
  expect(s.draws > 0, "draws of the dearest level");
  const double width = student_width(0.9, degrees), p = std::clamp(share, 0.0, 1.0);
  const double unseen = unseen_share(static_cast<std::size_t>(s.draws));
  // The share itself may lie beyond 0 and 1: its bounds are around it, not around what is said.
  const double low = share - reach(1 - p, standard_error, width, s.draws, s.squares, -s.cubes);
  const double high = share + reach(p, standard_error, width, s.draws, s.squares, s.cubes);
  return {std::clamp(low, 0.0, 1 - unseen), std::clamp(high, unseen, 1.0)};
}

double unseen_share(std::size_t n_dear) {
  return 1 - std::pow(beyond_a_bound, 1 / static_cast<double>(n_dear));
}

std::size_t draws_for_quantile(double level) {
  const double most = std::max(level, 1 - level);
  return static_cast<std::size_t>(std::ceil(std::log(beyond_a_bound) / std::log(most) - 1e-9));
}

}  // namespace sturz
