// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/reference/reference_list.hpp"

#include "tests/bench/reference/reference_pass.hpp"

#include <algorithm>
#include <numeric>

namespace sturz::bench {

ReferenceNeighbors::Place ReferenceNeighbors::place_of(float x, float y, float z) const {
  return {static_cast<int>((x - low_[0]) / edge_), static_cast<int>((y - low_[1]) / edge_),
          static_cast<int>((z - low_[2]) / edge_)};
}

/// Cells of half a search radius, numbered so that those above each other follow each other; two
/// empty ones all around, so that no bound of the table need be checked.
const std::vector<int>& ReferenceNeighbors::sort(const std::vector<float>& x,
                                                 const std::vector<float>& y,
                                                 const std::vector<float>& z) {
  edge_ = 0.5f * search_radius_;
  int* const counts[3] = {&n_cols_, &n_rows_, &n_levels_};
  const std::vector<float>* const axes[3] = {&x, &y, &z};
  for (int k = 0; k < 3; ++k) {
    const auto [lo, hi] = std::minmax_element(axes[k]->begin(), axes[k]->end());
    low_[k] = *lo - 2.5f * edge_;
    *counts[k] = static_cast<int>((*hi - low_[k]) / edge_) + 4;
  }
  cell_begin_.assign(cell(0, n_rows_, 0) + 1, 0);
  std::vector<std::size_t> cells(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Place p = place_of(x[i], y[i], z[i]);
    cells[i] = cell(p.col, p.row, p.level);
    ++cell_begin_[cells[i] + 1];
  }
  std::partial_sum(cell_begin_.begin(), cell_begin_.end(), cell_begin_.begin());
  std::vector<int> next(cell_begin_.begin(), cell_begin_.end() - 1);
  order_.resize(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) order_[next[cells[i]]++] = static_cast<int>(i);
  return order_;
}

void ReferenceNeighbors::list(const std::vector<float>& x, const std::vector<float>& y,
                              const std::vector<float>& z) {
  const float radius2 = search_radius_ * search_radius_;
  begin_.assign(x.size() + 1, 0);
  std::size_t found = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Place p = place_of(x[i], y[i], z[i]);
    for (int row = p.row - 2; row <= p.row + 2; ++row)
      for (int col = p.col - 2; col <= p.col + 2; ++col) {
        const int first = cell_begin_[cell(col, row, p.level - 2)];
        const int last = cell_begin_[cell(col, row, p.level + 3)];
        if (offsets_.size() < found + (last - first))
          offsets_.resize(std::max(2 * offsets_.size(), found + (last - first)));
        int* out = offsets_.data();
        for (int j = first; j < last; ++j) {
          const float rx = x[i] - x[j], ry = y[i] - y[j], rz = z[i] - z[j];
          out[found] = record_floats * j;
          found += (rx * rx + ry * ry + rz * rz < radius2) & (static_cast<std::size_t>(j) != i);
        }
      }
    begin_[i + 1] = static_cast<int>(found);
  }
}

}  // namespace sturz::bench
