// SPDX-License-Identifier: Apache-2.0
/// Grids of square cells with a place on the map, and values on them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace sturz {

/// Where a raster lies: north-up square cells in a projected, metric coordinate system.
/// Row 0 is the northernmost row, column 0 the westernmost column.
struct Grid {
  int n_cols = 0;
  int n_rows = 0;
  double west_m = 0;    ///< western edge of column 0 [m]
  double north_m = 0;   ///< northern edge of row 0 [m]
  double cell_m = 1;    ///< edge of a cell [m]
  std::string crs_wkt;  ///< WKT2 text of the coordinate system; empty for a bare synthetic scene

  double x_center(int col) const { return west_m + (col + 0.5) * cell_m; }
  double y_center(int row) const { return north_m - (row + 0.5) * cell_m; }
  double east_m() const { return west_m + n_cols * cell_m; }
  double south_m() const { return north_m - n_rows * cell_m; }
  std::size_t n_cells() const { return static_cast<std::size_t>(n_cols) * n_rows; }
  std::size_t index(int row, int col) const { return static_cast<std::size_t>(row) * n_cols + col; }
  /// Column of the cell that holds x (may lie outside 0..n_cols-1).
  int col_of(double x) const { return static_cast<int>(std::floor((x - west_m) / cell_m)); }
  /// Row of the cell that holds y (may lie outside 0..n_rows-1).
  int row_of(double y) const { return static_cast<int>(std::floor((north_m - y) / cell_m)); }
  bool contains(int row, int col) const {
    return row >= 0 && row < n_rows && col >= 0 && col < n_cols;
  }
  bool same_place(const Grid& o) const {
    return n_cols == o.n_cols && n_rows == o.n_rows && west_m == o.west_m && north_m == o.north_m &&
           cell_m == o.cell_m;
  }
};

/// A rectangle of cells inside a grid.
struct Window {
  int row0 = 0, col0 = 0, n_rows = 0, n_cols = 0;
  std::size_t n_cells() const { return static_cast<std::size_t>(n_rows) * n_cols; }
  int end_row() const { return row0 + n_rows; }
  int end_col() const { return col0 + n_cols; }
  bool contains(int row, int col) const {
    return row >= row0 && row < end_row() && col >= col0 && col < end_col();
  }
  bool contains(const Window& o) const {
    return o.row0 >= row0 && o.col0 >= col0 && o.end_row() <= end_row() && o.end_col() <= end_col();
  }
  bool operator==(const Window&) const = default;
};

/// All of a grid.
inline Window whole_of(const Grid& g) { return {0, 0, g.n_rows, g.n_cols}; }
/// Rows row0 up to, not including, row1, and columns alike, as far as they lie on the grid.
inline Window window_between(int row0, int row1, int col0, int col1, const Grid& g) {
  row0 = std::max(row0, 0), row1 = std::min(row1, g.n_rows);
  col0 = std::max(col0, 0), col1 = std::min(col1, g.n_cols);
  if (row0 >= row1 || col0 >= col1) return {};
  return {row0, col0, row1 - row0, col1 - col0};
}
/// So many cells more on every side, as far as they lie on the grid.
inline Window widened(const Window& w, int cells, const Grid& g) {
  return window_between(w.row0 - cells, w.end_row() + cells, w.col0 - cells, w.end_col() + cells,
                        g);
}
/// The smallest window that holds both; an empty one counts for nothing.
inline Window joined(const Window& a, const Window& b) {
  if (a.n_cells() == 0) return b;
  if (b.n_cells() == 0) return a;
  const int row0 = std::min(a.row0, b.row0), col0 = std::min(a.col0, b.col0);
  return {row0, col0, std::max(a.end_row(), b.end_row()) - row0,
          std::max(a.end_col(), b.end_col()) - col0};
}
/// The grid of a window's cells alone.
inline Grid grid_of(const Window& w, const Grid& whole) {
  return {w.n_cols,
          w.n_rows,
          whole.west_m + w.col0 * whole.cell_m,
          whole.north_m - w.row0 * whole.cell_m,
          whole.cell_m,
          whole.crs_wkt};
}
/// Inverse of grid_of: where the cells of `part` lie in `whole`. \pre cells of the same size
inline Window window_of(const Grid& part, const Grid& whole) {
  return {static_cast<int>(std::lround((whole.north_m - part.north_m) / whole.cell_m)),
          static_cast<int>(std::lround((part.west_m - whole.west_m) / whole.cell_m)), part.n_rows,
          part.n_cols};
}

/// Values on a grid, row-major from the north-west corner. Floating-point nodata is NaN.
template <class T>
struct Raster {
  Grid grid;
  std::vector<T> values;

  Raster() = default;
  explicit Raster(Grid g, T fill = T{}) : grid(std::move(g)), values(grid.n_cells(), fill) {}
  T& at(int row, int col) { return values[grid.index(row, col)]; }
  const T& at(int row, int col) const { return values[grid.index(row, col)]; }
};

inline constexpr float nan_f = std::numeric_limits<float>::quiet_NaN();
inline constexpr double nan_d = std::numeric_limits<double>::quiet_NaN();

}  // namespace sturz
