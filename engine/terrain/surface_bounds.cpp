// SPDX-License-Identifier: Apache-2.0
#include "engine/terrain/surface_bounds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace sturz {
namespace {

/// max that keeps `a` when b is NaN, which is how missing nodes are ignored.
double larger(double a, double b) { return b > a ? b : a; }

/// Greatest absolute differences of the nodes that the blocks of one row see, per block column.
struct RowTerms {
  std::vector<double> step_x;        ///< first differences along the row
  std::vector<double> step_y;        ///< first differences to the next row
  std::vector<double> curvature_at;  ///< second differences centred on the row, both ways
  std::vector<double> twist;         ///< mixed differences between the row and the next one

  explicit RowTerms(std::size_t n) : step_x(n), step_y(n), curvature_at(n), twist(n) {}
};

/// Node rows above, at, below and two columns of NaN beside them; missing rows are NaN.
class PaddedRows {
 public:
  PaddedRows(std::span<const double> nodes, int n_rows, int n_cols)
      : nodes_(nodes), n_rows_(n_rows), n_cols_(n_cols) {
    rows_.fill(std::vector<double>(n_cols + 4, std::numeric_limits<double>::quiet_NaN()));
  }
  void load(int slot, int row) {
    auto inner = rows_[slot].begin() + 2;
    if (row < 0 || row >= n_rows_)
      std::fill_n(inner, n_cols_, std::numeric_limits<double>::quiet_NaN());
    else
      std::copy_n(nodes_.begin() + static_cast<std::ptrdiff_t>(row) * n_cols_, n_cols_, inner);
  }
  /// Points at column 0; columns -2 .. n_cols + 1 may be read.
  const double* row(int slot) const { return rows_[slot].data() + 2; }

 private:
  std::span<const double> nodes_;
  int n_rows_, n_cols_;
  std::array<std::vector<double>, 3> rows_;
};

void fill_terms(const double* north, const double* here, const double* south, int n_blocks,
                RowTerms& out) {
  for (int c = 0; c < n_blocks; ++c) {
    double step_x = 0, step_y = 0, curvature = 0, twist = 0;
    for (int k = c - 1; k <= c + 1; ++k) {
      step_x = larger(step_x, std::abs(here[k + 1] - here[k]));
      twist = larger(twist, std::abs((here[k + 1] - here[k]) - (south[k + 1] - south[k])));
    }
    for (int k = c; k <= c + 1; ++k)
      curvature = larger(curvature, std::abs(here[k - 1] - 2 * here[k] + here[k + 1]));
    for (int k = c - 1; k <= c + 2; ++k) {
      step_y = larger(step_y, std::abs(south[k] - here[k]));
      curvature = larger(curvature, std::abs(north[k] - 2 * here[k] + south[k]));
    }
    out.step_x[c] = step_x;
    out.step_y[c] = step_y;
    out.curvature_at[c] = curvature;
    out.twist[c] = twist;
  }
}

SurfaceBound bound_of(double step_x, double step_y, double curvature, double cell_m) {
  const double slope2 = (step_x * step_x + step_y * step_y) / (cell_m * cell_m);
  SurfaceBound b;
  b.curvature_per_m = slope2 > 1 ? std::numeric_limits<float>::infinity()
                                 : static_cast<float>(curvature / (cell_m * cell_m));
  // The margin keeps it a lower bound after rounding to float.
  b.min_normal_z = static_cast<float>((1 - 1e-6) / std::sqrt(1 + slope2));
  return b;
}

}  // namespace

SurfaceBound rougher(SurfaceBound a, SurfaceBound b) {
  return {std::max(a.curvature_per_m, b.curvature_per_m), std::min(a.min_normal_z, b.min_normal_z)};
}

std::vector<SurfaceBound> surface_bounds(std::span<const double> nodes, int n_rows, int n_cols,
                                         double cell_m) {
  std::vector<SurfaceBound> bounds(nodes.size());
  const int n_blocks = n_cols - 1;
  PaddedRows rows(nodes, n_rows, n_cols);
  // A block at row b sees node rows b-1 .. b+2: a ring of four rows of terms is enough. Row -1 is
  // the slot that still holds its first zeros.
  std::array<RowTerms, 4> ring{RowTerms(n_cols), RowTerms(n_cols), RowTerms(n_cols),
                               RowTerms(n_cols)};
  rows.load(2, 0);
  rows.load(1, -1);
  for (int r = 0; r <= n_rows; ++r) {
    // Slots rotate: 0 north, 1 here, 2 south of row r, by r modulo 3.
    const int north = (r + 1) % 3, here = (r + 2) % 3, south = r % 3;
    rows.load(south, r + 1);
    fill_terms(rows.row(north), rows.row(here), rows.row(south), n_blocks, ring[r % 4]);
    const int b = r - 2;
    if (b < 0 || b >= n_rows - 1) continue;
    const RowTerms &t0 = ring[(b + 3) % 4], &t1 = ring[b % 4], &t2 = ring[(b + 1) % 4],
                   &t3 = ring[(b + 2) % 4];
    for (int c = 0; c < n_blocks; ++c) {
      const double step_x = std::max({t0.step_x[c], t1.step_x[c], t2.step_x[c], t3.step_x[c]});
      const double step_y = std::max({t0.step_y[c], t1.step_y[c], t2.step_y[c]});
      const double curvature =
          std::max({t0.curvature_at[c], t0.twist[c], t1.curvature_at[c], t1.twist[c],
                    t2.curvature_at[c], t2.twist[c], t3.curvature_at[c]});
      bounds[static_cast<std::size_t>(b) * n_cols + c] =
          bound_of(step_x, step_y, curvature, cell_m);
    }
  }
  return bounds;
}

}  // namespace sturz
