// SPDX-License-Identifier: Apache-2.0
#include "tests/physics/deposit_edge.hpp"

#include <algorithm>

namespace sturz::test {
namespace {

/// Outermost place where the thickness, linear between the slices' middles, falls to `least`.
double contour(const std::vector<double>& thickness, double dx, double least) {
  std::size_t last = thickness.size();
  while (last > 0 && thickness[last - 1] <= least) --last;
  if (last == 0) return 0;
  const double inner = thickness[last - 1], outer = last < thickness.size() ? thickness[last] : 0;
  return (last - 0.5 + (inner - least) / (inner - outer)) * dx;
}

}  // namespace

DepositEdge deposit_edge(const std::vector<double>& thickness, double dx) {
  const double least = std::max(0.5 * dx, 0.05);
  const double edge = contour(thickness, dx, least);
  return {edge, 2 * edge - contour(thickness, dx, 2 * least)};
}

void add_to_slice(std::vector<double>& thickness, std::size_t k, double share) {
  if (k >= thickness.size()) thickness.resize(k + 1, 0);
  thickness[k] += share;
}

}  // namespace sturz::test
