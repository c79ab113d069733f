// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/results/gis/flow_lines.hpp"

#include "engine/core/vec.hpp"
#include "io/features/shapes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <queue>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace sturz::workflow {
namespace {

constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
/// What a metre costs in seconds of arrival: it decides between ways of equal times only.
constexpr double second_per_metre = 1e-4;

/// Planes that the lines rest on; null: there is none.
struct Planes {
  const float *arrival = nullptr, *reached = nullptr;
};

Planes planes_of(const LayerStack& maps) {
  Planes found;
  for (const Layer& layer : maps.layers) {
    const auto [quantity, statistic, intensity] = layer.meaning;
    if (quantity == Quantity::reached && statistic == Statistic::probability)
      found.reached = layer.values.data();
    if (quantity != Quantity::arrival) continue;
    if (statistic == Statistic::peak) found.arrival = layer.values.data();
    if (statistic != Statistic::quantile) continue;
    const auto& levels = layer.axis.values;
    const auto median = std::find(levels.begin(), levels.end(), 0.5);
    if (median != levels.end())
      found.arrival = layer.values.data() +
                      static_cast<std::size_t>(median - levels.begin()) * maps.grid.n_cells();
  }
  return found;
}

Vec2 centre(const Grid& grid, std::size_t cell) {
  const auto cols = static_cast<std::size_t>(grid.n_cols);
  return {grid.west_m + (static_cast<double>(cell % cols) + 0.5) * grid.cell_m,
          grid.north_m - (static_cast<double>(cell / cols) + 0.5) * grid.cell_m};
}

/// Middle of the cells that the release covers.
std::optional<Vec2> middle_of(const Raster<std::uint8_t>& release) {
  Vec2 sum(0, 0);
  double n = 0;
  for (std::size_t i = 0; i < release.values.size(); ++i)
    if (release.values[i] != 0) sum += centre(release.grid, i), ++n;
  if (n == 0) return {};
  return Vec2(sum / n);
}

/// The cell with a time of arrival that lies nearest to a place; `none` without any.
std::size_t nearest_reached(const Grid& grid, const float* arrival, Vec2 place) {
  std::size_t best = none;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < grid.n_cells(); ++i) {
    if (!std::isfinite(arrival[i])) continue;
    const double away = (centre(grid, i) - place).squaredNorm();
    if (away < least) least = away, best = i;
  }
  return best;
}

/// Ways from one cell to all that can be reached over cells with a time of arrival.
class Ways {
 public:
  Ways(const Grid& grid, const float* arrival, std::size_t from)
      : grid_(grid),
        arrival_(arrival),
        cost_(grid.n_cells(), std::numeric_limits<double>::infinity()),
        before_(grid.n_cells(), none) {
    cost_[from] = 0;
    open_.emplace(0, from);
    while (!open_.empty()) {
      const auto [cost, cell] = open_.top();
      open_.pop();
      if (cost <= cost_[cell]) look_around(cell);
    }
  }

  bool reaches(std::size_t cell) const { return std::isfinite(cost_[cell]); }

  std::vector<Vec2> to(std::size_t cell) const {
    std::vector<Vec2> corners;
    for (; cell != none; cell = before_[cell]) corners.push_back(centre(grid_, cell));
    std::reverse(corners.begin(), corners.end());
    return corners;
  }

 private:
  void look_around(std::size_t cell) {
    const auto cols = static_cast<std::size_t>(grid_.n_cols);
    const int row = static_cast<int>(cell / cols), col = static_cast<int>(cell % cols);
    for (int r = std::max(0, row - 1); r <= std::min(grid_.n_rows - 1, row + 1); ++r)
      for (int c = std::max(0, col - 1); c <= std::min(grid_.n_cols - 1, col + 1); ++c) {
        const std::size_t next = grid_.index(r, c);
        if (!std::isfinite(arrival_[next])) continue;
        const double length = grid_.cell_m * (r != row && c != col ? std::sqrt(2.0) : 1);
        const double cost =
            cost_[cell] + std::abs(arrival_[next] - arrival_[cell]) + second_per_metre * length;
        if (!(cost < cost_[next])) continue;
        cost_[next] = cost;
        before_[next] = cell;
        open_.emplace(cost, next);
      }
  }

  using Entry = std::pair<double, std::size_t>;  // cost, cell: ties go to the smaller number
  const Grid& grid_;
  const float* arrival_;
  std::vector<double> cost_;
  std::vector<std::size_t> before_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open_;
};

/// The farthest cell from `place` that `ways` reach, of those with P >= level; `none` without any.
std::size_t farthest(const Grid& grid, const Ways& ways, const float* reached, double level,
                     Vec2 place) {
  std::size_t best = none;
  double most = -1;
  for (std::size_t i = 0; i < grid.n_cells(); ++i) {
    if (!ways.reaches(i) || (reached != nullptr && !(reached[i] >= static_cast<float>(level))))
      continue;
    const double away = (centre(grid, i) - place).squaredNorm();
    if (away > most) most = away, best = i;
  }
  return best;
}

double length_of(const std::vector<Vec2>& corners) {
  double length = 0;
  for (std::size_t i = 1; i < corners.size(); ++i) length += (corners[i] - corners[i - 1]).norm();
  return length;
}

}  // namespace

FeatureTable flow_lines(const LayerStack& maps, const Raster<std::uint8_t>& release) {
  const Grid& grid = maps.grid;
  FeatureTable table{"flow_lines", grid.crs_wkt, {}, {}};
  const Planes planes = planes_of(maps);
  const std::optional<Vec2> place = middle_of(release);
  if (planes.arrival == nullptr || !place) return table;
  const std::size_t from = nearest_reached(grid, planes.arrival, *place);
  if (from == none) return table;
  const Ways ways(grid, planes.arrival, from);
  constexpr double levels[] = {0.9, 0.5, 0.05}, any[] = {0};
  std::vector<std::string> names;
  std::vector<double> probabilities, lengths, arrivals, cells;
  for (const double level :
       planes.reached != nullptr ? std::span<const double>(levels) : std::span<const double>(any)) {
    const std::size_t end = farthest(grid, ways, planes.reached, level, *place);
    if (end == none || end == from) continue;
    const std::vector<Vec2> corners = ways.to(end);
    table.wkb.push_back(line_as_wkb(corners));
    names.push_back(level > 0 ? fmt::format("P \u2265 {:.0f} %", 100 * level) : "front");
    probabilities.push_back(level > 0 ? level : nan_d);
    lengths.push_back(length_of(corners));
    arrivals.push_back(planes.arrival[end]);
    cells.push_back(grid.cell_m);
  }
  table.columns = {{"name", std::move(names)},
                   {"probability", std::move(probabilities)},
                   {"length_m", std::move(lengths)},
                   {"arrival_s", std::move(arrivals)},
                   {"cell_m", std::move(cells)}};
  return table;
}

}  // namespace sturz::workflow
