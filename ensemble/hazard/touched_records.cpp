// SPDX-License-Identifier: Apache-2.0
#include "ensemble/hazard/touched_records.hpp"

#include "engine/core/error.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sturz {
namespace {

constexpr int edge = MemberCells::block_edge;
static_assert(edge * edge <= 65536, "cells of a block are numbered in 16 bits");

std::size_t blocks_along(int n_cells) {
  return static_cast<std::size_t>((n_cells + edge - 1) / edge);
}

bool is_untouched(float value, float untouched) {
  return value == untouched || (std::isnan(value) && std::isnan(untouched));
}

}  // namespace

TouchedRecords::TouchedRecords(const Window& extent, std::vector<PeakLayer> layers,
                               std::size_t memory_bytes)
    : extent_(extent),
      layers_(std::move(layers)),
      memory_bytes_(memory_bytes),
      n_block_cols_(blocks_along(extent.n_cols)),
      n_blocks_(n_block_cols_ * blocks_along(extent.n_rows)) {
  next_length_ = static_cast<RowCount>(n_blocks_) * edge;
}

bool TouchedRecords::next_pass() {
  first_ = end_;
  const RowCount all = static_cast<RowCount>(n_blocks_) * edge;
  if (first_ >= all) return false;
  end_ = std::min(all, first_ + next_length_);
  first_block_ = static_cast<std::size_t>(first_ / edge);
  blocks_.clear();
  blocks_.resize(static_cast<std::size_t>((end_ + edge - 1) / edge) - first_block_);
  bytes_ = 0;
  return true;
}

Window TouchedRecords::rows_ahead() const {
  const auto first_row = static_cast<int>(first_block_ / n_block_cols_) * edge;
  const auto end_row =
      (static_cast<int>((first_block_ + blocks_.size() - 1) / n_block_cols_) + 1) * edge;
  return {extent_.row0 + first_row, extent_.col0, std::min(end_row, extent_.n_rows) - first_row,
          extent_.n_cols};
}

Window TouchedRecords::block_window(std::size_t block) const {
  const int row = static_cast<int>(block / n_block_cols_) * edge;
  const int col = static_cast<int>(block % n_block_cols_) * edge;
  return {extent_.row0 + row, extent_.col0 + col, std::min(edge, extent_.n_rows - row),
          std::min(edge, extent_.n_cols - col)};
}

std::size_t TouchedRecords::bytes_of(const Block& block) const {
  return block.cells.size() *
         (sizeof(std::uint32_t) + sizeof(std::uint16_t) + layers_.size() * sizeof(float));
}

void TouchedRecords::add(std::uint32_t member, const Window& band,
                         const std::vector<std::vector<float>>& values) {
  const std::size_t n_layers = layers_.size();
  for (int row = 0; row < band.n_rows; ++row)
    for (int col = 0; col < band.n_cols; ++col) {
      const std::size_t i = static_cast<std::size_t>(row) * band.n_cols + col;
      bool untouched = true;
      for (std::size_t l = 0; l < n_layers; ++l)
        untouched = untouched && is_untouched(values[l][i], info(layers_[l]).untouched);
      if (untouched) continue;
      const int y = band.row0 + row - extent_.row0, x = band.col0 + col - extent_.col0;
      const std::size_t block = static_cast<std::size_t>(y / edge) * n_block_cols_ + x / edge;
      const RowCount place = static_cast<RowCount>(block) * edge + y % edge;
      if (place < first_ || place >= end_) continue;
      Block& to = blocks_[block - first_block_];
      to.members.push_back(member);
      to.cells.push_back(static_cast<std::uint16_t>(y % edge * edge + x % edge));
      for (std::size_t l = 0; l < n_layers; ++l) to.values.push_back(values[l][i]);
      bytes_ += sizeof(std::uint32_t) + sizeof(std::uint16_t) + n_layers * sizeof(float);
    }
  make_room();
}

/// Down to half of the bound, so that it does not happen at every member.
void TouchedRecords::make_room() {
  if (bytes_ <= memory_bytes_) return;
  const std::size_t wanted = memory_bytes_ / 2;
  while (bytes_ > wanted && blocks_.size() > 1) {
    bytes_ -= bytes_of(blocks_.back());
    blocks_.pop_back();
    end_ = static_cast<RowCount>(first_block_ + blocks_.size()) * edge;
  }
  while (bytes_ > wanted && end_ - first_ > 1) {
    end_ = first_ + (end_ - first_) / 2;
    keep_rows_below(blocks_.front(),
                    static_cast<int>(end_ - static_cast<RowCount>(first_block_) * edge));
    bytes_ = bytes_of(blocks_.front());
  }
  // The next pass looks a little farther than this one came, not over everything again.
  next_length_ = std::max<RowCount>(2 * (end_ - first_), 1);
}

void TouchedRecords::keep_rows_below(Block& block, int row) const {
  const std::size_t n_layers = layers_.size();
  std::size_t kept = 0;
  for (std::size_t i = 0; i < block.cells.size(); ++i) {
    if (block.cells[i] >= row * edge) continue;
    block.cells[kept] = block.cells[i];
    block.members[kept] = block.members[i];
    std::copy_n(&block.values[i * n_layers], n_layers, &block.values[kept * n_layers]);
    ++kept;
  }
  block.cells.resize(kept);
  block.members.resize(kept);
  block.values.resize(kept * n_layers);
  block.cells.shrink_to_fit();
  block.members.shrink_to_fit();
  block.values.shrink_to_fit();
}

/// By cell; the order of members within a cell stays.
CellRows TouchedRecords::sorted(std::size_t number, int first_row, int end_row) const {
  const Block& from = blocks_[number - first_block_];
  CellRows rows;
  rows.block = block_window(number);
  rows.window = {rows.block.row0 + first_row, rows.block.col0, end_row - first_row,
                 rows.block.n_cols};
  const auto cell_of = [&](std::size_t i) {
    const int row = from.cells[i] / edge - first_row, col = from.cells[i] % edge;
    return static_cast<std::size_t>(row) * rows.window.n_cols + col;
  };
  rows.begin.assign(rows.window.n_cells() + 1, 0);
  for (std::size_t i = 0; i < from.cells.size(); ++i) ++rows.begin[cell_of(i) + 1];
  for (std::size_t cell = 1; cell < rows.begin.size(); ++cell)
    rows.begin[cell] += rows.begin[cell - 1];
  std::vector<std::uint32_t> next(rows.begin.begin(), rows.begin.end() - 1);
  rows.members.resize(from.cells.size());
  for (const PeakLayer layer : layers_)
    rows.values[static_cast<std::size_t>(layer)].resize(from.cells.size());
  for (std::size_t i = 0; i < from.cells.size(); ++i) {
    const std::uint32_t to = next[cell_of(i)]++;
    rows.members[to] = from.members[i];
    for (std::size_t l = 0; l < layers_.size(); ++l)
      rows.values[static_cast<std::size_t>(layers_[l])][to] = from.values[i * layers_.size() + l];
  }
  return rows;
}

void TouchedRecords::hand_out(const std::function<void(const CellRows&)>& visitor) {
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const std::size_t number = first_block_ + b;
    const RowCount block_first = static_cast<RowCount>(number) * edge;
    const int n_rows = block_window(number).n_rows;
    const auto first = static_cast<int>(std::max<RowCount>(first_ - block_first, 0));
    const auto end = static_cast<int>(std::min<RowCount>(end_ - block_first, n_rows));
    if (first < end) visitor(sorted(number, first, end));
    blocks_[b] = Block{};  // sorted() doubles what a block takes: let go one by one
  }
}

}  // namespace sturz
