// SPDX-License-Identifier: Apache-2.0
/// Grids of square cells with a place on the map, and values on them.
#pragma once

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
