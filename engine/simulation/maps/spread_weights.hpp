// SPDX-License-Identifier: Apache-2.0
/// How one particle is shared out among cells: a quadratic B-spline in each direction.
#pragma once

#include "engine/core/vec.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace sturz {

/// Weights of one particle along one direction.
class SpreadWeights {
 public:
  /// Quadratic B-spline, support 1.5 widths each side; the sum over cells on and off the grid is 1.
  /// \param place   in cells from the centre of cell 0
  void set(double place, double width_cells) {
    const double reach = 1.5 * width_cells, per_width = 1 / width_cells;
    const double first = std::floor(place - reach) + 1;
    first_ = static_cast<int>(first);
    n_ = static_cast<int>(std::ceil(place + reach) - first);
    const auto n_blocks = static_cast<std::size_t>((n_ + block - 1) / block);
    if (exact_.size() < n_blocks) exact_.resize(n_blocks), weights_.resize(n_blocks * block);
    const Block steps = Block(0, 1, 2, 3) * per_width;
    Block sum = Block::Zero();
    double at = (first - place) * per_width;
    for (std::size_t k = 0; k < n_blocks; ++k, at += block * per_width) {
      const Block t = (steps + at).abs();
      const Block outer = (1.5 - t).max(0.0), inner = (0.5 - t).max(0.0);
      exact_[k] = 0.5 * outer * outer - 1.5 * inner * inner;
      sum += exact_[k];
    }
    const double scale = 1 / sum.sum();
    for (std::size_t k = 0; k < n_blocks; ++k)
      for (std::size_t j = 0; j < block; ++j)
        weights_[k * block + j] =
            static_cast<float>(exact_[k][static_cast<Eigen::Index>(j)] * scale);
  }
  int first() const { return first_; }                      ///< cell
  int n() const { return n_; }                              ///< cells
  const float* weights() const { return weights_.data(); }  ///< [n]

 private:
  static constexpr int block = 4;
  using Block = Eigen::Array<double, block, 1>;

  int first_ = 0, n_ = 0;
  std::vector<Block> exact_;    ///< before they are scaled to the sum of one
  std::vector<float> weights_;  ///< [n] and what fills the last block
};

}  // namespace sturz
