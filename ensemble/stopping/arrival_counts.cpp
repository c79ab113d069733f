// SPDX-License-Identifier: Apache-2.0
#include "ensemble/stopping/arrival_counts.hpp"

#include "engine/core/error.hpp"
#include "ensemble/hazard/wilson.hpp"

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

double half_width(std::int64_t hits, std::int64_t n) {
  const ProbabilityBounds bounds = wilson_interval(hits, n);
  return (bounds.upper - bounds.lower) / 2;
}

/// 0.05 < hits / n < 0.95, without rounding.
bool is_uncertain(std::int64_t hits, std::int64_t n) { return 20 * hits > n && 20 * hits < 19 * n; }

}  // namespace

void ArrivalCounts::add(const Window& window, std::span<const float> arrival) {
  expect(arrival.size() == window.n_cells(), "an arrival for each cell of the window");
  ++n_valid_;
  n_cells_.push_back(0);
  const auto n_cols = static_cast<std::size_t>(window.n_cols);
  for (std::size_t i = 0; i < arrival.size(); ++i) {
    if (std::isnan(arrival[i])) continue;
    const int row = window.row0 + static_cast<int>(i / n_cols);
    const int col = window.col0 + static_cast<int>(i % n_cols);
    const auto tile =
        static_cast<std::uint64_t>(row / edge) << 32 | static_cast<std::uint64_t>(col / edge);
    std::vector<std::uint32_t>& hits = hits_[tile];
    if (hits.empty()) hits.assign(std::size_t{edge} * edge, 0);
    std::uint32_t& here =
        hits[static_cast<std::size_t>(row % edge) * edge + static_cast<std::size_t>(col % edge)];
    if (here > 0) --n_cells_[here];
    ++n_cells_[++here];
  }
}

void ArrivalCounts::add(const MemberResult& member) {
  if (is_valid(member.outcome)) add(member.window, member.layer(PeakLayer::arrival));
}

LargestHalfWidth ArrivalCounts::largest_half_width() const {
  LargestHalfWidth found;
  found.n_valid = n_valid_;
  LargestHalfWidth all = found;
  for (std::int64_t hits = 1; hits <= n_valid_; ++hits) {
    const std::int64_t cells = n_cells_[static_cast<std::size_t>(hits)];
    if (cells == 0) continue;
    const double half = half_width(hits, n_valid_);
    for (LargestHalfWidth* of : {&all, &found}) {
      if (of == &found && !is_uncertain(hits, n_valid_)) continue;
      of->half_width = std::max(of->half_width, half);
      of->n_cells += cells;
    }
  }
  found.at = LookedAt::uncertain_cells;
  if (found.n_cells > 0) return found;
  all.at = LookedAt::reached_cells;
  if (all.n_cells > 0) return all;
  all.at = LookedAt::no_cell;
  all.half_width = half_width(0, n_valid_);
  return all;
}

}  // namespace sturz
