// SPDX-License-Identifier: Apache-2.0
#include "ensemble/sensitivity/morris.hpp"

#include "engine/core/error.hpp"

#include <cmath>

namespace sturz {
namespace {

/// The coordinate that differs between two rows of a trajectory.
std::size_t moved(const std::vector<double>& a, const std::vector<double>& b) {
  std::size_t which = a.size();
  for (std::size_t d = 0; d < a.size(); ++d) {
    if (a[d] == b[d]) continue;
    expect(which == a.size(), "one coordinate moves from row to row of a trajectory");
    which = d;
  }
  expect(which < a.size(), "a coordinate moves from row to row of a trajectory");
  return which;
}

MorrisMeasure measure(std::span<const double> effects, std::int64_t n_censored) {
  MorrisMeasure m{nan_d,     nan_d, nan_d, nan_d, static_cast<std::int64_t>(effects.size()),
                  n_censored};
  const auto n = static_cast<double>(effects.size());
  if (effects.empty()) return m;
  m.mean = m.mean_absolute = 0;
  for (const double e : effects) {
    m.mean += e / n;
    m.mean_absolute += std::abs(e) / n;
  }
  if (effects.size() < 2) return m;
  double squares = 0, absolute_squares = 0;
  for (const double e : effects) {
    squares += (e - m.mean) * (e - m.mean);
    absolute_squares += std::pow(std::abs(e) - m.mean_absolute, 2);
  }
  // What rounding leaves where all effects are one is no spread.
  const auto spread = [&](double variance) {
    const double found = std::sqrt(variance);
    return found < 1e-12 * m.mean_absolute ? 0 : found;
  };
  m.deviation = spread(squares / (n - 1));
  m.mean_absolute_error = spread(absolute_squares / (n - 1) / n);
  return m;
}

}  // namespace

std::vector<MorrisMeasure> morris_measures(const std::vector<std::vector<double>>& cube,
                                           std::span<const Observation> results) {
  expect(cube.size() == results.size(), "one result per row");
  const std::size_t n_dims = cube.empty() ? 0 : cube.front().size();
  std::vector<std::vector<double>> effects(n_dims);
  std::vector<std::int64_t> n_censored(n_dims, 0);
  const auto is_known = [](const Observation& o) {
    return o.known == Known::exactly && std::isfinite(o.value);
  };
  for (std::size_t i = 1; i < cube.size(); ++i) {
    if (i % (n_dims + 1) == 0) continue;  // the first row of the next trajectory
    const std::size_t d = moved(cube[i - 1], cube[i]);
    if (is_known(results[i - 1]) && is_known(results[i]))
      effects[d].push_back((results[i].value - results[i - 1].value) /
                           (cube[i][d] - cube[i - 1][d]));
    else
      ++n_censored[d];
  }
  std::vector<MorrisMeasure> measures;
  for (std::size_t d = 0; d < n_dims; ++d) measures.push_back(measure(effects[d], n_censored[d]));
  return measures;
}

}  // namespace sturz
