// SPDX-License-Identifier: Apache-2.0
/// How one particle is shared out among cells: a quadratic B-spline in each direction.
#pragma once

#include "engine/core/vec.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
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
    const int n_blocks = (n_ + block - 1) / block;
    const double at = (first - place) * per_width;
    switch (n_blocks) {  // the usual numbers, without a loop
      case 1:
        return fill<1>(at, per_width);
      case 2:
        return fill<2>(at, per_width);
      case 3:
        return fill<3>(at, per_width);
      default:
        fill_many(static_cast<std::size_t>(n_blocks), at, per_width);
    }
  }
  int first() const { return first_; }                      ///< cell
  int n() const { return n_; }                              ///< cells
  const float* weights() const { return weights_.data(); }  ///< [n]

 private:
  static constexpr int block = 4;
  using Block = Eigen::Array<double, block, 1>;

  /// \param at  of the first cell from the particle, in widths
  static Block spline(double at, double per_width) {
    const Block t = (Block(0, 1, 2, 3) * per_width + at).abs();
    const Block outer = (1.5 - t).max(0.0), inner = (0.5 - t).max(0.0);
    return 0.5 * outer * outer - 1.5 * inner * inner;
  }
  void put(std::size_t k, const Block& exact, double scale) {
    const Eigen::Array<float, block, 1> w = (exact * scale).cast<float>();
    std::copy_n(w.data(), block, weights_.data() + k * block);
  }
  template <std::size_t n_blocks>
  void fill(double at, double per_width) {
    std::array<Block, n_blocks> exact;
    Block sum = Block::Zero();
    for (std::size_t k = 0; k < n_blocks; ++k, at += block * per_width)
      sum += exact[k] = spline(at, per_width);
    const double scale = 1 / sum.sum();
    for (std::size_t k = 0; k < n_blocks; ++k) put(k, exact[k], scale);
  }
  void fill_many(std::size_t n_blocks, double at, double per_width) {
    if (exact_.size() < n_blocks) exact_.resize(n_blocks);
    if (weights_.size() < n_blocks * block) weights_.resize(n_blocks * block);
    Block sum = Block::Zero();
    for (std::size_t k = 0; k < n_blocks; ++k, at += block * per_width)
      sum += exact_[k] = spline(at, per_width);
    const double scale = 1 / sum.sum();
    for (std::size_t k = 0; k < n_blocks; ++k) put(k, exact_[k], scale);
  }

  int first_ = 0, n_ = 0;
  std::vector<Block> exact_;  ///< before they are scaled to the sum of one, of many blocks
  std::vector<float> weights_ = std::vector<float>(std::size_t{3} * block);  ///< [n], rest of the
                                                                             ///< last block
};

}  // namespace sturz
