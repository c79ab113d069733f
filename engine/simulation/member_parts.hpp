// SPDX-License-Identifier: Apache-2.0
/// Finished members that can be read in any part of their windows: what touched little costs
/// little.
#pragma once

#include "engine/simulation/member_result.hpp"
#include "engine/simulation/touched_cells.hpp"

#include <algorithm>
#include <vector>

namespace sturz {

inline int end_row(const Window& w) { return w.row0 + w.n_rows; }
inline int end_col(const Window& w) { return w.col0 + w.n_cols; }

/// The cells that lie in both; empty when none does.
inline Window overlap(const Window& a, const Window& b) {
  Window both;
  both.row0 = std::max(a.row0, b.row0);
  both.col0 = std::max(a.col0, b.col0);
  both.n_rows = std::min(end_row(a), end_row(b)) - both.row0;
  both.n_cols = std::min(end_col(a), end_col(b)) - both.col0;
  return both.n_rows > 0 && both.n_cols > 0 ? both : Window{};
}

class MemberParts : public MemberSource {
 public:
  /// One layer of member members()[index] in the cells of `part`, which lies inside the member's
  /// own window. Layer after layer of one member comes cheapest. \param out
  /// [part.n_rows][part.n_cols]
  virtual void read_part(std::size_t index, PeakLayer layer, const Window& part,
                         std::span<float> out) const = 0;

  /// The cells of `part` that differ from untouched ones in one of these layers. Here from
  /// read_part(); a source that keeps nothing else is faster.
  virtual void read_touched(std::size_t index, const Window& part,
                            std::span<const PeakLayer> layers, TouchedCells& out) const {
    std::vector<std::vector<float>> dense(layers.size(), std::vector<float>(part.n_cells()));
    for (std::size_t l = 0; l < layers.size(); ++l) read_part(index, layers[l], part, dense[l]);
    out.take_touched(part, layers, dense);
  }

  void read_rows(std::size_t index, PeakLayer layer, int row0, int n_rows,
                 std::span<float> out) const override {
    const int width = grid().n_cols;
    std::fill(out.begin(), out.end(), info(layer).untouched);
    const Window part = overlap(members()[index].window, {row0, 0, n_rows, width});
    std::vector<float> values(part.n_cells());
    if (!values.empty()) read_part(index, layer, part, values);
    for (int row = 0; row < part.n_rows; ++row)
      std::copy_n(
          values.begin() + static_cast<std::ptrdiff_t>(row) * part.n_cols, part.n_cols,
          out.begin() + static_cast<std::ptrdiff_t>(part.row0 + row - row0) * width + part.col0);
  }
};

}  // namespace sturz
