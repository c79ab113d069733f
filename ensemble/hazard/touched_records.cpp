// SPDX-License-Identifier: Apache-2.0
#include "ensemble/hazard/touched_records.hpp"

#include "engine/core/error.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <span>
#include <utility>

namespace sturz {
namespace {

constexpr int edge = MemberCells::block_edge;
static_assert(edge * edge <= 65536, "cells of a block are numbered in 16 bits");

std::size_t blocks_along(int n_cells) {
  return static_cast<std::size_t>((n_cells + edge - 1) / edge);
}

/// Bytes of one touch of one cell among many.
double bytes_per_touch(std::size_t n_layers) {
  return static_cast<double>(sizeof(float) * n_layers) + 1;
}

/// Large enough that few pieces begin a new chunk, small enough that unfilled ones do not count.
std::size_t chunk_floats(std::size_t memory_bytes) {
  return std::clamp<std::size_t>(memory_bytes / 4096 / sizeof(float), 64, 16384);
}

/// Each value to where its cell's column goes on. Sums of neighbours do not wait for each other, as
/// those of one cell's members would.
void put_in_columns(std::span<const float> values, std::uint32_t* next, float* columns,
                    double* sums) {
  for (std::size_t k = 0; k < values.size(); ++k) columns[next[k]++] = values[k];
  for (std::size_t k = 0; k < values.size(); ++k) sums[k] += double{values[k]};
}

}  // namespace

TouchedRecords::TouchedRecords(const Window& extent, std::vector<PeakLayer> layers,
                               std::size_t memory_bytes, std::span<const Window> windows)
    : extent_(extent),
      layers_(std::move(layers)),
      memory_bytes_(memory_bytes),
      chunk_(std::max<std::size_t>(edge * layers_.size(), chunk_floats(memory_bytes))),
      n_block_cols_(blocks_along(extent.n_cols)),
      n_blocks_(n_block_cols_ * blocks_along(extent.n_rows)),
      bounds_(n_blocks_, 0) {
  for (const Window& w : windows) {
    const Window mine = overlap(w, extent_);
    if (mine.n_cells() == 0) continue;
    const int last_row = (end_row(mine) - 1 - extent_.row0) / edge;
    const int last_col = (end_col(mine) - 1 - extent_.col0) / edge;
    for (int row = (mine.row0 - extent_.row0) / edge; row <= last_row; ++row)
      for (int col = (mine.col0 - extent_.col0) / edge; col <= last_col; ++col) {
        const std::size_t block = static_cast<std::size_t>(row) * n_block_cols_ + col;
        bounds_[block] += static_cast<double>(overlap(mine, block_window(block)).n_cells());
      }
  }
}

/// As far as it will fit, if members fill their windows as they did in the pass before, one row at
/// least: whole rows of blocks, or blocks of one row. Of others, columns would be read for nothing.
TouchedRecords::RowCount TouchedRecords::planned_end() const {
  constexpr double share = 0.8;  // of the bound: a pass that does not fit is read for nothing
  double left = share * static_cast<double>(memory_bytes_) / bytes_per_touch(layers_.size());
  const RowCount row_of_blocks = static_cast<RowCount>(n_block_cols_) * edge;
  const RowCount end_of_row = (first_ / row_of_blocks + 1) * row_of_blocks;
  RowCount at = first_;
  while (at < static_cast<RowCount>(n_blocks_) * edge) {
    const RowCount block = at / edge;
    const double per_row = filled_ * bounds_[static_cast<std::size_t>(block)] / edge;
    const auto rows = static_cast<double>((block + 1) * edge - at);
    if (per_row * rows > left) {
      at += static_cast<RowCount>(left / per_row);
      break;
    }
    left -= per_row * rows;
    at = (block + 1) * edge;
  }
  if (at >= end_of_row)
    at = first_ % row_of_blocks == 0 ? at / row_of_blocks * row_of_blocks : end_of_row;
  return std::max(at, first_ + 1);
}

bool TouchedRecords::next_pass() {
  first_ = end_;
  const RowCount all = static_cast<RowCount>(n_blocks_) * edge;
  if (first_ >= all) return false;
  end_ = planned_end();
  first_block_ = static_cast<std::size_t>(first_ / edge);
  blocks_.clear();
  blocks_.resize(static_cast<std::size_t>((end_ + edge - 1) / edge) - first_block_);
  bytes_ = 0;
  return true;
}

Window TouchedRecords::cells_ahead() const {
  const Window first = block_window(first_block_);
  const std::size_t last = first_block_ + blocks_.size() - 1;
  Window all = joined(first, block_window(last));
  if (last == first_block_) {
    const RowCount begin = static_cast<RowCount>(first_block_) * edge;
    const auto from = static_cast<int>(first_ - begin);
    const auto end = static_cast<int>(std::min<RowCount>(end_ - begin, first.n_rows));
    return {first.row0 + from, first.col0, std::max(end - from, 0), first.n_cols};
  }
  if (last / n_block_cols_ == first_block_ / n_block_cols_) return all;
  all.col0 = extent_.col0;
  all.n_cols = extent_.n_cols;
  return all;
}

Window TouchedRecords::block_window(std::size_t block) const {
  const int row = static_cast<int>(block / n_block_cols_) * edge;
  const int col = static_cast<int>(block % n_block_cols_) * edge;
  return {extent_.row0 + row, extent_.col0 + col, std::min(edge, extent_.n_rows - row),
          std::min(edge, extent_.n_cols - col)};
}

std::size_t TouchedRecords::bytes_of(const Block& block) const {
  return block.pieces.capacity() * sizeof(Piece) + block.chunks.size() * chunk_ * sizeof(float);
}

float* TouchedRecords::room_for(Block& block, std::size_t n) {
  if (block.left < n) {
    block.chunks.push_back(std::make_unique_for_overwrite<float[]>(chunk_));
    block.left = chunk_;
  }
  float* const room = block.chunks.back().get() + (chunk_ - block.left);
  block.left -= n;
  return room;
}

template <class Use>
void TouchedRecords::each_piece(const Block& block, const Use& use) const {
  std::size_t chunk = 0, at = 0;
  for (const Piece& piece : block.pieces) {
    const std::size_t n = piece.n * layers_.size();
    if (chunk_ - at < n) ++chunk, at = 0;
    use(piece, block.chunks[chunk].get() + at);
    at += n;
  }
}

/// \param first of the piece's cells among all of `from`
void TouchedRecords::put(Block& to, const Piece& piece, const TouchedCells& from,
                         std::size_t first) {
  const std::size_t before = bytes_of(to), n = piece.n;
  to.pieces.push_back(piece);
  float* const room = room_for(to, n * layers_.size());
  for (std::size_t l = 0; l < layers_.size(); ++l)
    std::memcpy(room + l * n, &from.values[l][first], n * sizeof(float));
  to.touches += n;
  bytes_ += bytes_of(to) - before;
}

void TouchedRecords::add(std::uint32_t member, const TouchedCells& cells) {
  std::size_t first = 0;
  for (const TouchedCells::Run& run : cells.runs) {
    const int y = run.row - extent_.row0;
    int x = run.col - extent_.col0;
    for (int left = run.n; left > 0;) {
      const int n = std::min(left, edge - x % edge);
      const std::size_t block = static_cast<std::size_t>(y / edge) * n_block_cols_ + x / edge;
      const RowCount place = static_cast<RowCount>(block) * edge + y % edge;
      if (place >= first_ && place < end_)
        put(blocks_[block - first_block_],
            {member, static_cast<std::uint16_t>(y % edge * edge + x % edge),
             static_cast<std::uint16_t>(n)},
            cells, first);
      first += static_cast<std::size_t>(n);
      left -= n;
      x += n;
    }
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
}

void TouchedRecords::keep_rows_below(Block& block, int row) {
  Block kept;
  each_piece(block, [&](const Piece& piece, const float* values) {
    if (piece.cell >= row * edge) return;
    const std::size_t n = piece.n * layers_.size();
    kept.pieces.push_back(piece);
    std::memcpy(room_for(kept, n), values, n * sizeof(float));
    kept.touches += piece.n;
  });
  block = std::move(kept);
}

/// Pieces by row, into by_row_; the order of members within a row stays.
void TouchedRecords::order_by_row(const Block& from) {
  row_begin_.fill(0);
  for (const Piece& piece : from.pieces) ++row_begin_[piece.cell / edge + 1];
  for (std::size_t row = 1; row < row_begin_.size(); ++row) row_begin_[row] += row_begin_[row - 1];
  by_row_.resize(from.pieces.size());
  auto next = row_begin_;
  each_piece(from, [&](const Piece& piece, const float* values) {
    by_row_[next[piece.cell / edge]++] = {piece, values};
  });
}

/// By cell, into rows_; the order of members within a cell stays.
void TouchedRecords::sort(const Window& block, int first_row, int end_row) {
  CellRows& rows = rows_;
  rows.block = block;
  rows.window = {block.row0 + first_row, block.col0, end_row - first_row, block.n_cols};
  const auto pieces = std::span(by_row_).subspan(row_begin_[first_row],
                                                 row_begin_[end_row] - row_begin_[first_row]);
  const auto cell_of = [&](const Piece& piece) {
    return static_cast<std::size_t>(piece.cell / edge - first_row) *
               static_cast<std::size_t>(block.n_cols) +
           piece.cell % edge;
  };
  rows.begin.assign(rows.window.n_cells() + 1, 0);
  for (const auto& [piece, values] : pieces)
    for (std::size_t k = 0, cell = cell_of(piece); k < piece.n; ++k) ++rows.begin[cell + k + 1];
  for (std::size_t cell = 1; cell < rows.begin.size(); ++cell)
    rows.begin[cell] += rows.begin[cell - 1];
  next_.assign(rows.begin.begin(), rows.begin.end() - 1);
  rows.members.resize(rows.begin.back());
  // Values of one row lie far from each other, where their members were put: asked for in time.
  constexpr std::size_t ahead = 6;
  const auto fetch_values = [](const Placed& of, std::size_t layer) {
    constexpr std::size_t line = 16;  // floats
    const float* const from = of.values + layer * of.piece.n;
    for (std::size_t k = 0; k < of.piece.n + line; k += line) __builtin_prefetch(from + k);
  };
  // Layer by layer: the ends of one layer's cells stay in the processor's nearest cache.
  for (const auto& [piece, values] : pieces) {
    std::uint32_t* const next = &next_[cell_of(piece)];
    for (std::size_t k = 0; k < piece.n; ++k) rows.members[next[k]++] = piece.member;
  }
  for (std::size_t l = 0; l < layers_.size(); ++l) {
    next_.assign(rows.begin.begin(), rows.begin.end() - 1);
    std::vector<float>& column = rows.values[static_cast<std::size_t>(layers_[l])];
    column.resize(rows.begin.back());
    std::vector<double>& sums = rows.sums[static_cast<std::size_t>(layers_[l])];
    sums.assign(rows.window.n_cells(), 0);
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const auto& [piece, values] = pieces[i];
      if (i + ahead < pieces.size()) fetch_values(pieces[i + ahead], l);
      const std::size_t cell = cell_of(piece);
      put_in_columns({values + l * piece.n, piece.n}, &next_[cell], column.data(), &sums[cell]);
    }
  }
}

/// In groups of rows whose touches fit the processor's cache.
void TouchedRecords::hand_out(std::size_t block, int first_row, int end_row,
                              const std::function<void(const CellRows&)>& visitor) {
  constexpr std::size_t in_cache = 16384;  // touches
  order_by_row(blocks_[block - first_block_]);
  const auto touches = [&](int row) {
    std::size_t n = 0;
    for (std::size_t i = row_begin_[row]; i < row_begin_[row + 1]; ++i) n += by_row_[i].piece.n;
    return n;
  };
  int first = first_row;
  std::size_t n_next = touches(first);
  while (first < end_row) {
    int end = first + 1;
    std::size_t n = n_next;
    for (; end < end_row; ++end) {
      n_next = touches(end);
      if (n + n_next > in_cache) break;
      n += n_next;
    }
    sort(block_window(block), first, end);
    visitor(rows_);
    first = end;
  }
}

void TouchedRecords::hand_out(const std::function<void(const CellRows&)>& visitor) {
  double bound = 0, held = 0;
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const std::size_t number = first_block_ + b;
    const RowCount block_first = static_cast<RowCount>(number) * edge;
    const int n_rows = block_window(number).n_rows;
    const auto first = static_cast<int>(std::max<RowCount>(first_ - block_first, 0));
    const auto end = static_cast<int>(std::min<RowCount>(end_ - block_first, n_rows));
    if (first < end) hand_out(number, first, end, visitor);
    bound += bounds_[number] * std::max(end - first, 0) / edge;
    held += static_cast<double>(blocks_[b].touches);
    blocks_[b] = Block{};
  }
  if (bound > 0 && held > 0) filled_ = std::min(1.0, held / bound);
}

}  // namespace sturz
