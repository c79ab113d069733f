// SPDX-License-Identifier: Apache-2.0
#include "io/doubts/contour_spots.hpp"

#include <array>
#include <cmath>
#include <map>
#include <vector>

namespace sturz {
namespace {

constexpr double flat_m = 0.01;
constexpr double on_line = 0.02;  // of the interval
constexpr std::size_t most_flat_cells = 2'000'000, fewest_at_level = 10;
constexpr std::array intervals_m{100.0, 60.96, 50.0, 30.48, 25.0, 20.0, 12.192, 10.0, 6.096, 5.0};

std::vector<std::size_t> flat_cells(std::span<const double> z, int n_rows, int n_cols) {
  std::vector<std::size_t> flat;
  const auto width = static_cast<std::size_t>(n_cols);
  for (int row = 0; row + 1 < n_rows && flat.size() < most_flat_cells; ++row)
    for (int col = 0; col + 1 < n_cols; ++col) {
      const std::size_t i = static_cast<std::size_t>(row) * width + static_cast<std::size_t>(col);
      if (std::abs(z[i] - z[i + 1]) < flat_m && std::abs(z[i] - z[i + width]) < flat_m &&
          std::abs(z[i] - z[i + width + 1]) < flat_m)
        flat.push_back(i);
    }
  return flat;
}

struct Level {
  std::size_t on = 0, off = 0;
};

std::optional<ContourSpots> spots_at(double interval, std::span<const double> z,
                                     std::span<const std::size_t> flat) {
  std::map<long, Level> levels;
  ContourSpots found{interval, 0, 0, 0};
  for (const std::size_t i : flat) {
    const double level = z[i] / interval, nearest = std::nearbyint(level);
    Level& at = levels[static_cast<long>(nearest)];
    if (std::abs(level - nearest) > on_line) {
      ++at.off;
      continue;
    }
    ++at.on;
    if (found.cells++ == 0) found.first_cell = i;
  }
  int all = 0;
  for (const auto& [number, level] : levels) {
    all += level.on + level.off >= fewest_at_level;
    found.levels += level.on >= fewest_at_level && level.on > 4 * level.off;
  }
  if (found.levels < 5 || found.levels < 0.6 * all) return std::nullopt;
  return found;
}

}  // namespace

std::optional<ContourSpots> contour_spots(std::span<const double> values, int n_rows, int n_cols) {
  const std::vector<std::size_t> flat = flat_cells(values, n_rows, n_cols);
  for (const double interval : intervals_m)
    if (const auto found = spots_at(interval, values, flat)) return found;
  return std::nullopt;
}

}  // namespace sturz
