// SPDX-License-Identifier: Apache-2.0
#include "tests/physics/collapse/deposit_edge.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

namespace sturz::test {
namespace {

constexpr double link_dx = 1.5;

/// Mean of the sectors' largest; sectors without one do not count.
double mean_of(const std::vector<double>& farthest) {
  double sum = 0, n = 0;
  for (double reach : farthest)
    if (reach > 0) sum += reach, n += 1;
  return n > 0 ? sum / n : 0;
}

}  // namespace

std::vector<char> heap_of(const ParticleSet& p, double link) {
  using Cell = std::tuple<int, int, int>;
  const auto cell_of = [&](std::size_t i) {
    return Cell(static_cast<int>(std::floor(p.x[i] / link)),
                static_cast<int>(std::floor(p.y[i] / link)),
                static_cast<int>(std::floor(p.z[i] / link)));
  };
  std::map<Cell, std::vector<std::size_t>> cells;
  for (std::size_t i = 0; i < p.size(); ++i) cells[cell_of(i)].push_back(i);
  std::vector<char> reached(p.size(), 0);
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < p.size(); ++i)
    if (std::hypot(p.x[i], p.y[i]) < link) reached[i] = 1, open.push_back(i);
  while (!open.empty()) {
    const std::size_t i = open.back();
    open.pop_back();
    const auto [a, b, c] = cell_of(i);
    for (int k = 0; k < 27; ++k) {
      const auto cell = cells.find(Cell(a + k % 3 - 1, b + k / 3 % 3 - 1, c + k / 9 - 1));
      if (cell == cells.end()) continue;
      for (const std::size_t j : cell->second) {
        if (reached[j]) continue;
        if (std::hypot(p.x[i] - p.x[j], p.y[i] - p.y[j], p.z[i] - p.z[j]) >= link) continue;
        reached[j] = 1, open.push_back(j);
      }
    }
  }
  return reached;
}

double reach_along_x(const ParticleSet& p, double dx) {
  const auto heap = heap_of(p, link_dx * dx);
  std::map<long, double> farthest;
  for (std::size_t i = 0; i < p.size(); ++i)
    if (heap[i]) {
      double& x = farthest[std::lround(std::floor(p.y[i] / dx))];
      x = std::max(x, p.x[i] + 0.5 * dx);
    }
  std::vector<double> strips;
  for (const auto& [strip, x] : farthest) strips.push_back(x);
  return mean_of(strips);
}

double reach_along_r(const ParticleSet& p, double dx, int n_sectors) {
  const auto heap = heap_of(p, link_dx * dx);
  std::vector<double> farthest(static_cast<std::size_t>(n_sectors));
  const double whole = 2 * std::numbers::pi;
  for (std::size_t i = 0; i < p.size(); ++i)
    if (heap[i]) {
      const double turn = std::atan2(p.y[i], p.x[i]) / whole;
      const auto at = static_cast<std::size_t>((turn < 0 ? turn + 1 : turn) * n_sectors);
      double& r = farthest[std::min(at, farthest.size() - 1)];
      r = std::max(r, std::hypot(p.x[i], p.y[i]) + 0.5 * dx);
    }
  return mean_of(farthest);
}

double contour(const std::vector<double>& thickness, double dx) {
  const double least = std::max(0.5 * dx, 0.05);
  std::size_t last = thickness.size();
  while (last > 0 && thickness[last - 1] <= least) --last;
  if (last == 0) return 0;
  const double inner = thickness[last - 1], outer = last < thickness.size() ? thickness[last] : 0;
  return (last - 0.5 + (inner - least) / (inner - outer)) * dx;
}

void add_to_slice(std::vector<double>& thickness, std::size_t k, double share) {
  if (k >= thickness.size()) thickness.resize(k + 1, 0);
  thickness[k] += share;
}

}  // namespace sturz::test
