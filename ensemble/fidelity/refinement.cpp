// SPDX-License-Identifier: Apache-2.0
#include "ensemble/fidelity/refinement.hpp"

#include "engine/core/random.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace sturz {
namespace {

// No scheme here is of a higher order than two: a larger one that fits is not its own.
constexpr double least_order = 0.5, most_order = 3, order_of_scheme = 2;
constexpr int n_resamplings = 200;

struct Fit {
  double order = nan_d, limit = nan_d, residual = nan_d;
};

/// Least squares of means = limit + coefficient d^order for a given order.
Fit straight_fit(std::span<const double> spacings, std::span<const double> means, double order) {
  const auto n = static_cast<double>(spacings.size());
  double mean_x = 0, mean_y = 0, xx = 0, xy = 0;
  std::vector<double> x;
  for (const double d : spacings) x.push_back(std::pow(d / spacings.front(), order));
  for (std::size_t l = 0; l < x.size(); ++l) {
    mean_x += x[l] / n;
    mean_y += means[l] / n;
  }
  for (std::size_t l = 0; l < x.size(); ++l) {
    xx += (x[l] - mean_x) * (x[l] - mean_x);
    xy += (x[l] - mean_x) * (means[l] - mean_y);
  }
  Fit fit;
  fit.order = order;
  const double slope = xy / xx;
  fit.limit = mean_y - slope * mean_x;
  fit.residual = 0;
  for (std::size_t l = 0; l < x.size(); ++l) {
    const double e = means[l] - fit.limit - slope * x[l];
    fit.residual += e * e;
  }
  return fit;
}

/// The order between 0.25 and 4 that fits best: a look at every twentieth, then thirds of the best.
Fit best_fit(std::span<const double> spacings, std::span<const double> means) {
  constexpr double first = 0.25, last = 4, step = 0.05;
  double best = first;
  double least = straight_fit(spacings, means, first).residual;
  for (double p = first + step; p <= last; p += step) {
    const double residual = straight_fit(spacings, means, p).residual;
    if (residual < least) best = p, least = residual;
  }
  double low = std::max(first, best - step), high = std::min(last, best + step);
  for (int i = 0; i < 60; ++i) {
    const double a = low + (high - low) / 3, b = high - (high - low) / 3;
    const bool left =
        straight_fit(spacings, means, a).residual < straight_fit(spacings, means, b).residual;
    (left ? high : low) = left ? b : a;
  }
  return straight_fit(spacings, means, 0.5 * (low + high));
}

/// What the limit is told by: the fit, or that of order two where the fit is steeper (Eca and
/// Hoekstra 2014).
Fit extrapolated(std::span<const double> spacings, std::span<const double> means, const Fit& fit) {
  return fit.order > order_of_scheme ? straight_fit(spacings, means, order_of_scheme) : fit;
}

/// Means that go one way all along, with an order that a scheme may have.
bool is_converging(std::span<const double> means, const Fit& fit) {
  for (std::size_t l = 2; l < means.size(); ++l)
    if ((means[l] - means[l - 1]) * (means[1] - means[0]) <= 0) return false;
  return fit.order >= least_order && fit.order <= most_order;
}

std::vector<double> means_of(const std::vector<std::vector<double>>& values,
                             std::span<const std::size_t> members) {
  std::vector<double> means;
  for (const std::vector<double>& level : values) {
    double sum = 0;
    for (const std::size_t m : members) sum += level[m];
    means.push_back(sum / static_cast<double>(members.size()));
  }
  return means;
}

/// The middle 90 of 100 values.
Interval middle_90(std::vector<double> values) {
  if (values.size() < 10) return {};
  std::sort(values.begin(), values.end());
  const auto at = [&](double share) {
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5)];
  };
  return {at(0.05), at(0.95)};
}

void resample(Refinement& r, const std::vector<std::vector<double>>& values, std::uint64_t seed) {
  const std::size_t n = values.front().size();
  if (n < 2) return;
  std::vector<double> orders, limits;
  std::vector<std::size_t> members(n);
  for (std::uint64_t k = 0; k < n_resamplings; ++k) {
    for (std::size_t i = 0; i < n; ++i)
      members[i] = static_cast<std::size_t>(unit_random(seed, k, i) * static_cast<double>(n));
    const std::vector<double> means = means_of(values, members);
    const Fit fit = best_fit(r.spacings_m, means);
    if (!is_converging(means, fit)) continue;
    orders.push_back(fit.order);
    limits.push_back(extrapolated(r.spacings_m, means, fit).limit);
  }
  r.resampled_converging = static_cast<double>(orders.size()) / n_resamplings;
  r.order_90 = middle_90(std::move(orders));
  r.limit_90 = middle_90(std::move(limits));
}

}  // namespace

Refinement refine(std::span<const double> spacings_m,
                  const std::vector<std::vector<double>>& values, std::uint64_t seed) {
  expect(!spacings_m.empty() && spacings_m.size() == values.size(), "a column per spacing");
  expect(std::is_sorted(spacings_m.rbegin(), spacings_m.rend()) && spacings_m.back() > 0,
         "spacings descend");
  for (const auto& level : values)
    expect(level.size() == values.front().size() && !level.empty(), "the same members");
  Refinement r;
  r.spacings_m.assign(spacings_m.begin(), spacings_m.end());
  std::vector<std::size_t> all(values.front().size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  r.means = means_of(values, all);
  r.limit = r.means.back();
  if (spacings_m.size() >= 3) {
    const Fit fit = best_fit(spacings_m, r.means);
    r.converges = is_converging(r.means, fit);
    resample(r, values, seed);
    if (r.converges) {
      r.order = fit.order;
      r.limit = extrapolated(spacings_m, r.means, fit).limit;
    }
  }
  return r;
}

}  // namespace sturz
