// SPDX-License-Identifier: Apache-2.0
#include "io/doubts/dem_doubts.hpp"

#include "io/doubts/contour_spots.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace sturz {
namespace {

constexpr double metres_per_degree = 111'320;

/// The values as a grid, and what the sentences need.
struct Survey {
  const RasterSource& s;
  CellOrigin origin;
  double cell_m = 0;

  double at(int row, int col) const {
    return s.values[static_cast<std::size_t>(row) * s.n_cols + col];
  }
  bool holds(int row, int col) const {
    return row >= 0 && row < s.n_rows && col >= 0 && col < s.n_cols;
  }
  std::string place(int row, int col) const {
    return fmt::format(
        "row {}, column {} (x {:.10g}, y {:.10g}; counted from the north-west, from "
        "0)",
        row + origin.row, col + origin.col, s.x_of(col + 0.5, row + 0.5),
        s.y_of(col + 0.5, row + 0.5));
  }
};

double cell_width_m(const RasterSource& s) {
  const double step = std::max(s.col_step(), s.row_step());
  if (s.crs.IsEmpty()) return step;
  return s.crs.IsGeographic() ? step * metres_per_degree : step * s.crs.GetLinearUnits();
}

/// The outline of a block of zeros, and where it is worst.
struct ZeroBlock {
  std::size_t cells = 0, sides = 0;
  double rise = 0, worst = 0;
  int row = 0, col = 0;  ///< of the worst side's zero
};

/// Takes the connected zeros at a place; `seen` marks them.
ZeroBlock block_at(const Survey& v, int row, int col, std::vector<bool>& seen) {
  ZeroBlock block;
  std::vector<std::pair<int, int>> open{{row, col}};
  const auto index = [&](int r, int c) { return static_cast<std::size_t>(r) * v.s.n_cols + c; };
  seen[index(row, col)] = true;
  while (!open.empty()) {
    const auto [r, c] = open.back();
    open.pop_back();
    ++block.cells;
    for (const auto& [dr, dc] : {std::pair{0, 1}, {0, -1}, {1, 0}, {-1, 0}}) {
      const int nr = r + dr, nc = c + dc;
      if (!v.holds(nr, nc) || std::isnan(v.at(nr, nc))) continue;
      const double height = std::abs(v.at(nr, nc));
      if (height == 0) {
        if (!seen[index(nr, nc)]) open.emplace_back(nr, nc);
        seen[index(nr, nc)] = true;
        continue;
      }
      ++block.sides;
      block.rise += height;
      if (height > block.worst) block.worst = height, block.row = r, block.col = c;
    }
  }
  return block;
}

/// \return cells of doubtful blocks, by index; the sentence goes to `doubts`
std::vector<bool> zero_blocks(const Survey& v, std::vector<std::string>& doubts) {
  std::vector<bool> doubtful, seen;
  const auto& values = v.s.values;
  if (std::find(values.begin(), values.end(), 0.0) == values.end()) return doubtful;
  seen.resize(values.size());
  const double steep = std::max(50.0, 6 * v.cell_m);
  std::size_t cells = 0, blocks = 0;
  ZeroBlock worst;
  for (int row = 0; row < v.s.n_rows; ++row)
    for (int col = 0; col < v.s.n_cols; ++col) {
      const std::size_t i = static_cast<std::size_t>(row) * v.s.n_cols + col;
      if (values[i] != 0 || seen[i]) continue;
      const ZeroBlock block = block_at(v, row, col, seen);
      if (block.sides == 0 || block.rise / static_cast<double>(block.sides) <= steep) continue;
      ++blocks;
      cells += block.cells;
      if (block.worst > worst.worst) worst = block;
    }
  if (blocks == 0) return doubtful;
  doubts.push_back(fmt::format(
      "{}: {} cells hold 0 m right beside high ground, in {} block{} (a fill value?); the highest "
      "step is {:.6g} m at {}. Declare it as nodata (gdal_edit.py -a_nodata 0) or fill it",
      v.s.label, cells, blocks, blocks == 1 ? "" : "s", worst.worst,
      v.place(worst.row, worst.col)));
  doubtful.resize(values.size());
  std::transform(values.begin(), values.end(), doubtful.begin(), [](double z) { return z == 0; });
  return doubtful;
}

/// Neighbours a cliff apart.
void jumps(const Survey& v, const std::vector<bool>& known, std::vector<std::string>& doubts) {
  const double limit = std::max(200.0, 6 * v.cell_m);
  std::size_t count = 0;
  double largest = 0, from = 0, to = 0;
  int at_row = 0, at_col = 0;
  const auto is_known = [&](int row, int col) {
    return !known.empty() && known[static_cast<std::size_t>(row) * v.s.n_cols + col];
  };
  const auto look = [&](int row, int col, int row2, int col2) {
    const double a = v.at(row, col), b = v.at(row2, col2), jump = std::abs(a - b);
    if (!(jump > limit) || is_known(row, col) || is_known(row2, col2)) return;
    ++count;
    if (jump > largest) largest = jump, from = a, to = b, at_row = row, at_col = col;
  };
  for (int row = 0; row < v.s.n_rows; ++row)
    for (int col = 0; col < v.s.n_cols; ++col) {
      if (col + 1 < v.s.n_cols) look(row, col, row, col + 1);
      if (row + 1 < v.s.n_rows) look(row, col, row + 1, col);
    }
  if (count == 0) return;
  doubts.push_back(fmt::format(
      "{}: {} pairs of neighbouring cells lie more than {:g} m apart in height; the largest jump "
      "is "
      "{:.6g} m, from {:.6g} to {:.6g} m, at {}. Fill values, or tiles that do not fit?",
      v.s.label, count, limit, largest, from, to, v.place(at_row, at_col)));
}

/// How far a cell stands out of its eight neighbours: above the highest or below the lowest, less
/// what these differ; not positive where it does not.
double standing_out(const Survey& v, int row, int col) {
  const double z = v.at(row, col);
  double low = INFINITY, high = -INFINITY;
  for (int dr = -1; dr <= 1; ++dr)
    for (int dc = -1; dc <= 1; ++dc) {
      if (dr == 0 && dc == 0) continue;
      const double n = v.at(row + dr, col + dc);
      if (std::isnan(n)) return 0;
      low = std::min(low, n);
      high = std::max(high, n);
    }
  const double out = std::max(z - high, low - z);
  return out > high - low ? out : 0;
}

void spikes(const Survey& v, std::vector<std::string>& doubts) {
  const double limit = std::max(5.0, v.cell_m);
  std::size_t count = 0;
  double worst = 0;
  int at_row = 0, at_col = 0;
  for (int row = 1; row + 1 < v.s.n_rows; ++row)
    for (int col = 1; col + 1 < v.s.n_cols; ++col) {
      const double z = v.at(row, col), west = z - v.at(row, col - 1), east = z - v.at(row, col + 1);
      // Two neighbours tell nearly all cells apart; the others need not be looked at.
      if (!(std::min(std::abs(west), std::abs(east)) > limit) || west * east < 0) continue;
      const double out = standing_out(v, row, col);
      if (!(out > limit)) continue;
      ++count;
      if (out > worst) worst = out, at_row = row, at_col = col;
    }
  if (count == 0) return;
  doubts.push_back(fmt::format(
      "{}: {} single cell{} out of all eight neighbours by more than {:g} m, the worst by {:.6g} m "
      "at {}. A spike turns flowing mass into spray: replace it by its neighbours' mean",
      v.s.label, count, count == 1 ? " stands" : "s stand", limit, worst, v.place(at_row, at_col)));
}

/// Steps of whole numbers where the ground is gentler than a step per cell.
void terraces(const Survey& v, std::vector<std::string>& doubts) {
  const double step = v.s.quantum_m;
  if (!(step >= 0.02 * v.cell_m)) return;
  std::size_t pairs = 0, equal = 0, single = 0;
  std::optional<std::pair<int, int>> first;
  for (int row = 0; row < v.s.n_rows; ++row) {
    int run = 0;
    for (int col = 0; col + 1 < v.s.n_cols; ++col) {
      const double rise = std::abs(v.at(row, col + 1) - v.at(row, col));
      if (std::isnan(rise)) continue;
      ++pairs;
      const bool is_equal = rise < 0.5 * step, is_single = !is_equal && rise < 1.5 * step;
      equal += is_equal;
      single += is_single;
      if (is_single && run >= 3 && !first) first = {row, col};
      run = is_equal ? run + 1 : 0;
    }
  }
  if (!first || equal < pairs / 10 || single < pairs / 10) return;
  doubts.push_back(fmt::format(
      "{}: its heights are whole multiples of {:.4g} m, so gentle ground is terraced: {:.0f} % of "
      "neighbouring cells are equal and {:.0f} % are one step of {:.1f} degrees apart, the first "
      "such edge at {}. Smooth it, or take a raster with decimals",
      v.s.label, step, 100.0 * static_cast<double>(equal) / static_cast<double>(pairs),
      100.0 * static_cast<double>(single) / static_cast<double>(pairs),
      std::atan(step / v.cell_m) * 180 / 3.14159265358979, v.place(first->first, first->second)));
}

void contours(const Survey& v, std::vector<std::string>& doubts) {
  const auto found = contour_spots(v.s.values, v.s.n_rows, v.s.n_cols);
  if (!found) return;
  const int row = static_cast<int>(found->first_cell / static_cast<std::size_t>(v.s.n_cols));
  const int col = static_cast<int>(found->first_cell % static_cast<std::size_t>(v.s.n_cols));
  doubts.push_back(fmt::format(
      "{}: {} cells are flat at levels of contour lines every {:g} m and hardly any elsewhere, at "
      "{} levels, the first ({:.6g} m) at {}. It was interpolated from contours, which leaves "
      "steps "
      "and flat ridges: expect mass to stop on them",
      v.s.label, found->cells, found->interval_m, found->levels, v.at(row, col),
      v.place(row, col)));
}

}  // namespace

std::vector<std::string> dem_doubts(const RasterSource& source, CellOrigin origin) {
  std::vector<std::string> doubts;
  if (!source.is_axis_aligned()) return doubts;
  const Survey survey{source, origin, cell_width_m(source)};
  const std::vector<bool> known = zero_blocks(survey, doubts);
  jumps(survey, known, doubts);
  spikes(survey, doubts);
  terraces(survey, doubts);
  contours(survey, doubts);
  return doubts;
}

}  // namespace sturz
