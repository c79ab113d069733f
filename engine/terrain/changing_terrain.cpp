// SPDX-License-Identifier: Apache-2.0
// Ground that changes under a member: the patch is edited in place.
#include "engine/core/error.hpp"
#include "engine/terrain/terrain.hpp"

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

/// Bounds of a block see nodes so many rows and columns away (surface_bounds).
constexpr int bound_stencil = 3;

/// Room is added with this margin, so that a spreading change seldom moves the patch [nodes].
int margin(int n) { return 8 + n / 4; }

}  // namespace

/// Makes the patch hold nodes row0..row1, col0..col1 and every block whose bounds they change.
void Terrain::cover(int row0, int col0, int row1, int col1) {
  const Grid& g = grid();
  const int top = std::max(0, row0 - bound_stencil), left = std::max(0, col0 - bound_stencil);
  const int bottom = std::min(g.n_rows, row1 + 1 + bound_stencil);
  const int right = std::min(g.n_cols, col1 + 1 + bound_stencil);
  if (top >= patch_row_ && bottom <= patch_row_ + patch_rows_ && left >= patch_col_ &&
      right <= patch_col_ + patch_cols_)
    return;
  const int dr = margin(bottom - top), dc = margin(right - left);
  const int first_row = std::max(0, top - dr), first_col = std::max(0, left - dc);
  const int n_rows = std::min(g.n_rows, bottom + dr) - first_row;
  const int n_cols = std::min(g.n_cols, right + dc) - first_col;
  const std::size_t changes = n_changes_;
  *this = with_patch(first_row, first_col, n_rows, n_cols,
                     std::vector<double>(static_cast<std::size_t>(n_rows) * n_cols, nan_d));
  n_changes_ = changes;
}

void Terrain::refresh_bounds(int row0, int col0, int row1, int col1) {
  const Grid& g = grid();
  const int top = std::max(0, row0 - 2 * bound_stencil),
            left = std::max(0, col0 - 2 * bound_stencil);
  const int bottom = std::min(g.n_rows, row1 + 1 + 2 * bound_stencil);
  const int right = std::min(g.n_cols, col1 + 1 + 2 * bound_stencil);
  const int n_cols = right - left;
  std::vector<double> nodes;
  nodes.reserve(static_cast<std::size_t>(bottom - top) * n_cols);
  for (int r = top; r < bottom; ++r)
    for (int c = left; c < right; ++c) nodes.push_back(node(r, c));
  const auto bounds = surface_bounds(nodes, bottom - top, n_cols, cell_m_);
  const int last_row = std::min({row1 + bound_stencil, bottom - 1, patch_row_ + patch_rows_ - 1});
  const int last_col = std::min({col1 + bound_stencil, right - 1, patch_col_ + patch_cols_ - 1});
  for (int r = std::max({row0 - bound_stencil, top, patch_row_}); r <= last_row; ++r)
    for (int c = std::max({col0 - bound_stencil, left, patch_col_}); c <= last_col; ++c) {
      const SurfaceBound b = bounds[static_cast<std::size_t>(r - top) * n_cols + (c - left)];
      patch_bounds_[static_cast<std::size_t>(r - patch_row_) * patch_cols_ + (c - patch_col_)] = b;
      patch_roughest_ = rougher(patch_roughest_, b);
    }
}

void Terrain::change(std::span<const NodeChange> nodes) {
  if (nodes.empty()) return;
  const Grid& g = grid();
  int row0 = g.n_rows, row1 = -1, col0 = g.n_cols, col1 = -1;
  for (const NodeChange& n : nodes) {
    expect(n.row >= 0 && n.row < g.n_rows && n.col >= 0 && n.col < g.n_cols && std::isfinite(n.z),
           "a changed node lies on the grid and is finite");
    row0 = std::min(row0, n.row), row1 = std::max(row1, n.row);
    col0 = std::min(col0, n.col), col1 = std::max(col1, n.col);
  }
  cover(row0, col0, row1, col1);
  for (const NodeChange& n : nodes) {
    patch_[static_cast<std::size_t>(n.row - patch_row_) * patch_cols_ + (n.col - patch_col_)] = n.z;
    lowest_m_ = std::min(lowest_m_, n.z);
  }
  refresh_bounds(row0, col0, row1, col1);
  ++n_changes_;
}

}  // namespace sturz
