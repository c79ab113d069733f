// SPDX-License-Identifier: Apache-2.0
/// Neighbour lists of the reference step: one list per particle, with a skin, from sorted cells.
#pragma once

#include <cstddef>
#include <vector>

namespace sturz::bench {

class ReferenceNeighbors {
 public:
  explicit ReferenceNeighbors(float search_radius) : search_radius_(search_radius) {}

  /// Order of the particles by cell: new particle k is old particle order[k].
  const std::vector<int>& sort(const std::vector<float>& x, const std::vector<float>& y,
                               const std::vector<float>& z);
  /// Lists for positions that stand in that order. Offsets are multiples of `record_floats`.
  void list(const std::vector<float>& x, const std::vector<float>& y, const std::vector<float>& z);

  const std::vector<int>& begin() const { return begin_; }
  const std::vector<int>& offsets() const { return offsets_; }

 private:
  struct Place {
    int col, row, level;
  };
  Place place_of(float x, float y, float z) const;
  std::size_t cell(int col, int row, int level) const {
    return (static_cast<std::size_t>(row) * n_cols_ + col) * n_levels_ + level;
  }

  float search_radius_, edge_ = 1, low_[3] = {0, 0, 0};
  int n_cols_ = 1, n_rows_ = 1, n_levels_ = 1;
  std::vector<int> cell_begin_, order_, begin_, offsets_;
};

}  // namespace sturz::bench
