// SPDX-License-Identifier: Apache-2.0
#include "ensemble/fidelity/multilevel_gain.hpp"

#include "engine/core/error.hpp"
#include "engine/core/random.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sturz {
namespace {

constexpr int n_resamplings = 200;

/// Sums over cells of the members' variances and of their covariance with the first level.
struct Moments {
  double first = 0, level = 0, both = 0;
  double squared_correlation() const {
    return first > 0 && level > 0 ? both * both / (first * level) : 0;
  }
};

Moments moments(const LevelValues& r, std::size_t level, std::span<const std::size_t> members) {
  const std::vector<double>&a = r.values.front(), &b = r.values[level];
  const std::size_t n_all = a.size() / r.n_cells;
  const auto n = static_cast<double>(members.size());
  Moments sum;
  for (std::size_t cell = 0; cell < r.n_cells; ++cell) {
    const std::size_t begin = cell * n_all;
    double mean_a = 0, mean_b = 0;
    for (const std::size_t m : members) {
      mean_a += a[begin + m] / n;
      mean_b += b[begin + m] / n;
    }
    for (const std::size_t m : members) {
      const double da = a[begin + m] - mean_a, db = b[begin + m] - mean_b;
      sum.first += da * da;
      sum.level += db * db;
      sum.both += da * db;
    }
  }
  return sum;
}

/// [n_results][n_levels]
std::vector<std::vector<double>> correlations(std::span<const LevelValues> results,
                                              std::size_t n_levels,
                                              std::span<const std::size_t> members) {
  std::vector<std::vector<double>> all;
  for (const LevelValues& r : results) {
    std::vector<double>& row = all.emplace_back(n_levels, 1.0);
    for (std::size_t l = 1; l < n_levels; ++l)
      row[l] = moments(r, l, members).squared_correlation();
  }
  return all;
}

/// What each level's members leave of the variance, times their number, for one result.
std::vector<double> parts(std::span<const double> squared, std::span<const std::size_t> levels) {
  std::vector<double> d;
  for (std::size_t i = 0; i < levels.size(); ++i)
    d.push_back(squared[levels[i]] - (i + 1 < levels.size() ? squared[levels[i + 1]] : 0));
  return d;
}

struct Found {
  std::vector<std::size_t> levels;
  std::vector<double> members;
  double gain = 0;  // 0: these levels do not serve in this order
};

/// One set of levels, taken in the order of their mean correlation.
Found try_levels(const std::vector<std::vector<double>>& squared, std::span<const double> cost_s,
                 std::vector<std::size_t> levels) {
  std::vector<double> mean(cost_s.size(), 0);
  for (const auto& row : squared)
    for (std::size_t l = 0; l < mean.size(); ++l)
      mean[l] += row[l] / static_cast<double>(squared.size());
  std::sort(levels.begin() + 1, levels.end(),
            [&](std::size_t a, std::size_t b) { return mean[a] > mean[b]; });
  const std::vector<double> d = parts(mean, levels);
  Found found{levels, {}, 0};
  if (*std::min_element(d.begin(), d.end()) <= 0) return found;
  double sum = 0;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    sum += std::sqrt(cost_s[levels[i]] * d[i]);
    found.members.push_back(std::sqrt(cost_s[levels[0]] * d[i] / (cost_s[levels[i]] * d[0])));
    // Samples are nested: a cheaper level has more of them.
    if (i > 0 && found.members[i] <= found.members[i - 1]) return found;
  }
  found.gain = cost_s[levels[0]] / (sum * sum);
  return found;
}

/// Of one result, with members that were chosen for all.
double gain_with(std::span<const double> squared, std::span<const double> cost_s,
                 const Found& found) {
  const std::vector<double> d = parts(squared, found.levels);
  double seconds = 0, variance = 0;
  for (std::size_t i = 0; i < found.levels.size(); ++i) {
    seconds += found.members[i] * cost_s[found.levels[i]];
    variance += d[i] / found.members[i];
  }
  return cost_s[found.levels[0]] / (seconds * variance);
}

double mean_gain(const std::vector<std::vector<double>>& squared, std::span<const double> cost_s,
                 const Found& found) {
  double inverse = 0;
  for (const auto& row : squared) inverse += 1 / gain_with(row, cost_s, found);
  return static_cast<double>(squared.size()) / inverse;
}

Interval resampled_gain(std::span<const LevelValues> results, std::span<const double> cost_s,
                        const Found& found, std::size_t n, std::uint64_t seed) {
  std::vector<double> gains;
  std::vector<std::size_t> members(n);
  for (std::uint64_t k = 0; k < n_resamplings; ++k) {
    for (std::size_t i = 0; i < n; ++i)
      members[i] = static_cast<std::size_t>(unit_random(seed, k, i) * static_cast<double>(n));
    gains.push_back(mean_gain(correlations(results, cost_s.size(), members), cost_s, found));
  }
  std::sort(gains.begin(), gains.end());
  return {gains[n_resamplings / 20], gains[n_resamplings - 1 - n_resamplings / 20]};
}

}  // namespace

double squared_correlation(const LevelValues& r, std::size_t level) {
  std::vector<std::size_t> all(r.values.front().size() / r.n_cells);
  std::iota(all.begin(), all.end(), std::size_t{0});
  return moments(r, level, all).squared_correlation();
}

MultilevelGain multilevel_gain(std::span<const LevelValues> results, std::span<const double> cost_s,
                               std::uint64_t seed) {
  expect(!results.empty() && !cost_s.empty() && cost_s.size() <= 8, "some results, few levels");
  const std::size_t n = results.front().values.front().size() / results.front().n_cells;
  std::vector<std::size_t> all(n);
  std::iota(all.begin(), all.end(), std::size_t{0});
  const auto squared = correlations(results, cost_s.size(), all);
  Found best{{0}, {1.0}, 1};
  for (unsigned set = 1; set < 1U << (cost_s.size() - 1); ++set) {
    std::vector<std::size_t> levels{0};
    for (std::size_t l = 1; l < cost_s.size(); ++l)
      if ((set >> (l - 1) & 1U) != 0) levels.push_back(l);
    if (const Found found = try_levels(squared, cost_s, levels); found.gain > best.gain)
      best = found;
  }
  MultilevelGain gain;
  gain.levels = best.levels;
  gain.members = best.members;
  gain.gain = mean_gain(squared, cost_s, best);
  gain.gain_90 = resampled_gain(results, cost_s, best, n, seed);
  for (const auto& row : squared) gain.gains.push_back(gain_with(row, cost_s, best));
  return gain;
}

}  // namespace sturz
