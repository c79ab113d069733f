// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/measure/statistics.hpp"

#include "engine/core/error.hpp"

#include <algorithm>
#include <cmath>

namespace sturz::bench {
namespace {

/// P(at most k of n fair coins show heads).
double binomial_half(int n, int k) {
  double term = std::pow(0.5, n), sum = 0;
  for (int i = 0; i <= k; ++i) {
    sum += term;
    term *= static_cast<double>(n - i) / (i + 1);
  }
  return sum;
}

}  // namespace

Summary summarize(std::vector<double> values) {
  expect(!values.empty(), "a summary needs a value");
  std::sort(values.begin(), values.end());
  const int n = static_cast<int>(values.size());
  Summary s;
  s.n = n;
  s.least = values.front(), s.most = values.back();
  s.median = 0.5 * (values[(n - 1) / 2] + values[n / 2]);
  // The median lies outside [x_k, x_(n-1-k)] when at most k values lie on one side of it.
  int k = 0;
  while (k + 1 < (n + 1) / 2 && 2 * binomial_half(n, k + 1) <= 0.05) ++k;
  s.low = values[k], s.high = values[n - 1 - k];
  s.coverage = std::max(0.0, 1 - 2 * binomial_half(n, k));
  return s;
}

std::vector<double> ratios(const std::vector<double>& a, const std::vector<double>& b) {
  expect(a.size() == b.size(), "ratios are taken pair by pair");
  std::vector<double> out(a.size());
  for (std::size_t k = 0; k < a.size(); ++k) out[k] = a[k] / b[k];
  return out;
}

}  // namespace sturz::bench
