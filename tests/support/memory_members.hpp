// SPDX-License-Identifier: Apache-2.0
/// An ensemble's members kept in memory, and random ones to fill it.
#pragma once

#include "engine/simulation/member_parts.hpp"

#include <random>
#include <string>
#include <vector>

namespace sturz::test {

/// A MemberParts over results in memory, in the order in which they were added.
class MemoryMembers : public MemberParts {
 public:
  explicit MemoryMembers(Grid grid) : grid_(std::move(grid)) {}

  void add(const MemberResult& result) {
    MemberSummary summary;
    summary.member = result.member;
    summary.outcome = result.outcome;
    summary.censoring = result.censoring;
    summary.reason = result.reason;
    summary.formulation = result.formulation;
    summary.state_hash = result.state_hash;
    summary.scalars = result.scalars;
    summary.window = result.window;
    summaries_.push_back(summary);
    results_.push_back(result);
  }

  const std::vector<MemberSummary>& members() const override { return summaries_; }
  const Grid& grid() const override { return grid_; }

  void read_part(std::size_t index, PeakLayer layer, const Window& part,
                 std::span<float> out) const override {
    if (index != last_) ++turns_;
    last_ = index;
    const MemberResult& r = results_.at(index);
    for (int row = 0; row < part.n_rows; ++row)
      for (int col = 0; col < part.n_cols; ++col)
        out[static_cast<std::size_t>(row) * part.n_cols + col] =
            value(r, layer, part.row0 + row, part.col0 + col);
  }

  float value(std::size_t index, PeakLayer layer, int row, int col) const {
    return value(results_.at(index), layer, row, col);
  }
  /// How often the reader came to another member than the last.
  int turns() const { return turns_; }

  /// One cell of one member, seen through its window.
  static float value(const MemberResult& r, PeakLayer layer, int row, int col) {
    const int y = row - r.window.row0, x = col - r.window.col0;
    if (y < 0 || y >= r.window.n_rows || x < 0 || x >= r.window.n_cols)
      return info(layer).untouched;
    if (r.layer(layer).empty()) return info(layer).untouched;
    return r.layer(layer)[static_cast<std::size_t>(y) * r.window.n_cols + x];
  }

 private:
  Grid grid_;
  std::vector<MemberSummary> summaries_;
  std::vector<MemberResult> results_;
  mutable std::size_t last_ = static_cast<std::size_t>(-1);
  mutable int turns_ = 0;
};

inline Grid small_grid(int n_rows, int n_cols, double cell_m = 10) {
  Grid grid;
  grid.n_rows = n_rows;
  grid.n_cols = n_cols;
  grid.west_m = 500000;
  grid.north_m = 4.5e6;
  grid.cell_m = cell_m;
  return grid;
}

/// A member with a random window; inside it about a third of the cells stay dry, and values are
/// rounded so that ties and exact hits of thresholds happen.
inline MemberResult random_member(std::int64_t member, const Grid& grid, std::mt19937& random) {
  const auto whole = [&](int low, int high) {
    return std::uniform_int_distribution<int>(low, high)(random);
  };
  MemberResult r;
  r.member = member;
  r.outcome = Outcome::settled;
  r.grid = grid;
  r.window.row0 = whole(0, grid.n_rows - 1);
  r.window.col0 = whole(0, grid.n_cols - 1);
  r.window.n_rows = whole(0, grid.n_rows - r.window.row0);
  r.window.n_cols = whole(0, grid.n_cols - r.window.col0);
  constexpr int n_drawn = 10;  // of the flow, and the thickness of each of its materials
  const float scale[n_drawn] = {0.25F, 0.5F, 5000, 2000, 1, 0.25F, 100, 0.25F, 0.25F, 0.25F};
  for (int layer = 0; layer < n_peak_layers; ++layer)
    r.layers[layer].assign(r.window.n_cells(), info(static_cast<PeakLayer>(layer)).untouched);
  for (std::size_t cell = 0; cell < r.window.n_cells(); ++cell) {
    if (whole(0, 2) == 0) continue;
    for (int layer = 0; layer < n_drawn; ++layer)
      r.layers[layer][cell] = scale[layer] * static_cast<float>(whole(0, 12));
  }
  return r;
}

}  // namespace sturz::test
