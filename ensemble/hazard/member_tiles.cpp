// SPDX-License-Identifier: Apache-2.0
#include "ensemble/hazard/member_tiles.hpp"

#include "engine/core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

std::vector<std::size_t> valid_in_order(const std::vector<MemberSummary>& members) {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < members.size(); ++i)
    if (is_valid(members[i].outcome)) indices.push_back(i);
  const auto number = [&](std::size_t i) { return members[i].member; };
  std::sort(indices.begin(), indices.end(),
            [&](std::size_t a, std::size_t b) { return number(a) < number(b); });
  for (std::size_t i = 1; i < indices.size(); ++i)
    require(number(indices[i]) != number(indices[i - 1]),
            fmt::format("member {} occurs twice (two shards computed it?). Keep one of its files.",
                        number(indices[i])));
  return indices;
}

Window hull(const Window& a, const Window& b) {
  if (a.n_cells() == 0) return b;
  if (b.n_cells() == 0) return a;
  Window both;
  both.row0 = std::min(a.row0, b.row0);
  both.col0 = std::min(a.col0, b.col0);
  both.n_rows = std::max(a.row0 + a.n_rows, b.row0 + b.n_rows) - both.row0;
  both.n_cols = std::max(a.col0 + a.n_cols, b.col0 + b.n_cols) - both.col0;
  return both;
}

std::vector<Window> tiles_of(const Window& whole, std::size_t max_cells) {
  if (whole.n_cells() == 0) return {};
  const auto fits = [&](int least, int most, std::size_t cells) {
    return static_cast<int>(std::clamp<std::size_t>(cells, static_cast<std::size_t>(least),
                                                    static_cast<std::size_t>(most)));
  };
  const int n_cols = fits(1, whole.n_cols, max_cells);
  const int n_rows = fits(1, whole.n_rows, max_cells / static_cast<std::size_t>(n_cols));
  std::vector<Window> tiles;
  for (int row = 0; row < whole.n_rows; row += n_rows)
    for (int col = 0; col < whole.n_cols; col += n_cols)
      tiles.push_back({whole.row0 + row, whole.col0 + col, std::min(n_rows, whole.n_rows - row),
                       std::min(n_cols, whole.n_cols - col)});
  return tiles;
}

bool overlap_in_rows(const Window& a, const Window& b) {
  return a.n_cells() > 0 && a.row0 < b.row0 + b.n_rows && b.row0 < a.row0 + a.n_rows;
}

/// Peaks are never negative and never undefined, an arrival time may be undefined.
void check_values(std::span<const float> values, PeakLayer layer, std::int64_t member) {
  const bool may_be_nan = layer == PeakLayer::arrival;
  bool good = true;
  for (const float v : values) good &= may_be_nan ? !(v < 0) : v >= 0;
  require(good, fmt::format("member {}: {} holds a value that is negative{} (it cannot be). Delete "
                            "the member's file and compute it again.",
                            member, info(layer).name, may_be_nan ? "" : " or undefined"));
}

}  // namespace

void CellBlock::reset(const Window& tile, std::size_t n_members, float fill) {
  tile_ = tile;
  n_cells_ = tile.n_cells();
  n_members_ = n_members;
  values_.assign(n_cells_ * n_members_, fill);
  group_.resize(group_size * n_members_);
  group_begin_ = group_end_ = 0;
}

std::span<const float> CellBlock::cell(std::size_t i) {
  if (i < group_begin_ || i >= group_end_) {
    group_begin_ = i / group_size * group_size;
    group_end_ = std::min(group_begin_ + group_size, n_cells_);
    for (std::size_t m = 0; m < n_members_; ++m)
      for (std::size_t c = group_begin_; c < group_end_; ++c)
        group_[(c - group_begin_) * n_members_ + m] = values_[m * n_cells_ + c];
  }
  return {&group_[(i - group_begin_) * n_members_], n_members_};
}

MemberTiles::MemberTiles(const MemberSource& source, std::size_t memory_limit_bytes,
                         int blocks_at_once)
    : source_(source), indices_(valid_in_order(source.members())) {
  for (const std::size_t i : indices_) touched_ = hull(touched_, source.members()[i].window);
  const std::size_t bytes_per_cell = sizeof(float) * static_cast<std::size_t>(blocks_at_once) *
                                     std::max<std::size_t>(indices_.size(), 1);
  tiles_ = tiles_of(touched_, std::max<std::size_t>(memory_limit_bytes / bytes_per_cell, 1));
}

void MemberTiles::read(PeakLayer layer, const Window& tile, CellBlock& block) const {
  const auto width = static_cast<std::size_t>(source_.grid().n_cols);
  const auto n_cols = static_cast<std::size_t>(tile.n_cols);
  block.reset(tile, indices_.size(), info(layer).untouched);
  rows_.resize(static_cast<std::size_t>(tile.n_rows) * width);
  for (std::size_t m = 0; m < indices_.size(); ++m) {
    const MemberSummary& member = source_.members()[indices_[m]];
    if (!overlap_in_rows(member.window, tile)) continue;
    source_.read_rows(indices_[m], layer, tile.row0, tile.n_rows, rows_);
    const std::span<float> to = block.member(m);
    for (std::size_t row = 0; row < static_cast<std::size_t>(tile.n_rows); ++row)
      std::copy_n(&rows_[row * width + static_cast<std::size_t>(tile.col0)], n_cols,
                  &to[row * n_cols]);
    check_values(to, layer, member.member);
  }
}

}  // namespace sturz
