// SPDX-License-Identifier: Apache-2.0
#include "ensemble/hazard/convergence.hpp"

#include "ensemble/hazard/wilson.hpp"

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

constexpr double likely = 0.5, possible = 0.05;

std::vector<std::int64_t> sizes_up_to(std::int64_t n, int max_points) {
  const std::int64_t n_points = std::min<std::int64_t>(n, std::max(max_points, 1));
  std::vector<std::int64_t> sizes;
  for (std::int64_t i = 1; i <= n_points; ++i) sizes.push_back((n * i + n_points - 1) / n_points);
  return sizes;
}

ConvergencePoint summary(const std::vector<std::int64_t>& cells, std::int64_t n,
                         double cell_area_m2) {
  ConvergencePoint point;
  point.n_members = n;
  std::int64_t n_cells = 0, n_likely = 0, n_possible = 0, hits_in_all = 0;
  std::int64_t n_lower = 0, n_upper = 0;
  double half_widths = 0;
  for (std::int64_t hits = 0; hits <= n; ++hits) {
    const std::int64_t count = cells[static_cast<std::size_t>(hits)];
    const ProbabilityBounds bounds = wilson_interval(hits, n);
    const double probability = static_cast<double>(hits) / static_cast<double>(n);
    n_cells += count;
    hits_in_all += count * hits;
    n_likely += probability >= likely ? count : 0;
    n_lower += bounds.lower >= likely ? count : 0;
    n_upper += hits > 0 && bounds.upper >= likely ? count : 0;
    n_possible += probability >= possible ? count : 0;
    half_widths += static_cast<double>(count) * (bounds.upper - bounds.lower) / 2;
  }
  if (n_cells == 0) return point;
  const auto all = static_cast<double>(n_cells);
  point.mean_probability_reached =
      static_cast<double>(hits_in_all) / (all * static_cast<double>(n));
  point.area_likely_m2 = static_cast<double>(n_likely) * cell_area_m2;
  point.area_likely_lower_m2 = static_cast<double>(n_lower) * cell_area_m2;
  point.area_likely_upper_m2 = static_cast<double>(n_upper) * cell_area_m2;
  point.area_possible_m2 = static_cast<double>(n_possible) * cell_area_m2;
  point.mean_half_width = half_widths / all;
  return point;
}

}  // namespace

ConvergenceCount::ConvergenceCount(std::size_t n_members, int max_points)
    : sizes_(sizes_up_to(static_cast<std::int64_t>(n_members), max_points)) {
  for (const std::int64_t n : sizes_) histograms_.emplace_back(n + 1, 0);
}

void ConvergenceCount::add(const CellRows& rows) {
  for (std::size_t cell = 0; cell < rows.window.n_cells(); ++cell) {
    const std::span<const std::uint32_t> members = rows.members_of(cell);
    const std::span<const float> times = rows.of(PeakLayer::arrival, cell);
    if (std::all_of(times.begin(), times.end(), [](float t) { return std::isnan(t); })) continue;
    std::size_t hits = 0, touch = 0;
    for (std::size_t point = 0; point < sizes_.size(); ++point) {
      for (; touch < times.size() && static_cast<std::int64_t>(members[touch]) < sizes_[point];
           ++touch)
        hits += !std::isnan(times[touch]);
      ++histograms_[point][hits];
    }
  }
}

std::vector<ConvergencePoint> ConvergenceCount::points(double cell_area_m2) const {
  std::vector<ConvergencePoint> points;
  for (std::size_t i = 0; i < sizes_.size(); ++i)
    points.push_back(summary(histograms_[i], sizes_[i], cell_area_m2));
  return points;
}

std::vector<ConvergencePoint> probability_convergence(const MemberParts& source,
                                                      std::size_t memory_bytes, int max_points,
                                                      CancelFlag cancel) {
  const MemberCells members(source);
  ConvergenceCount count(members.n_members(), max_points);
  members.visit(members.touched(), {PeakLayer::arrival}, memory_bytes, cancel,
                [&](const CellRows& rows) { count.add(rows); });
  if (members.n_members() == 0) return {};
  return count.points(source.grid().cell_m * source.grid().cell_m);
}

}  // namespace sturz
