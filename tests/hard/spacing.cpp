// SPDX-License-Identifier: Apache-2.0
#include "tests/hard/spacing.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <tuple>

namespace sturz::test {
namespace {

double nearest_image(double d, const Period& p) {
  return p.active ? d - p.length() * std::round(d / p.length()) : d;
}

}  // namespace

std::vector<std::vector<Neighbor>> neighbors_within(const SimulationParts& parts, double radius) {
  const ParticleSet& p = parts.state.grains();
  const Domain& domain = parts.state.domain;
  const double most2 = radius * radius * parts.facts.spacing_m * parts.facts.spacing_m;
  std::vector<std::vector<Neighbor>> all(p.size());
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      // None of these scenes has a slope across a period: images are not lifted.
      const double dx = nearest_image(p.x[j] - p.x[i], domain.x);
      const double dy = nearest_image(p.y[j] - p.y[i], domain.y), dz = p.z[j] - p.z[i];
      if (dx * dx + dy * dy + dz * dz >= most2) continue;
      all[i].push_back({j, dx, dy, dz});
      all[j].push_back({i, -dx, -dy, -dz});
    }
  return all;
}

double closest_pair(const SimulationParts& parts) {
  double least2 = 1e300;
  for (const auto& around : neighbors_within(parts, 2))
    for (const Neighbor& n : around)
      least2 = std::min(least2, n.dx * n.dx + n.dy * n.dy + n.dz * n.dz);
  return std::sqrt(least2) / parts.facts.spacing_m;
}

std::vector<std::size_t> pieces(const SimulationParts& parts, double link) {
  const auto around = neighbors_within(parts, link);
  std::vector<bool> seen(around.size());
  std::vector<std::size_t> sizes;
  for (std::size_t first = 0; first < around.size(); ++first) {
    if (seen[first]) continue;
    std::vector<std::size_t> open{first};
    seen[first] = true;
    std::size_t size = 0;
    for (; !open.empty(); ++size) {
      const std::size_t i = open.back();
      open.pop_back();
      for (const Neighbor& n : around[i])
        if (!seen[n.index]) seen[n.index] = true, open.push_back(n.index);
    }
    sizes.push_back(size);
  }
  std::sort(sizes.begin(), sizes.end(), std::greater<>());
  return sizes;
}

}  // namespace sturz::test
