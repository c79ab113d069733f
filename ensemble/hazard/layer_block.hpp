// SPDX-License-Identifier: Apache-2.0
/// The values of all layers in one block of cells, on their way to the sink.
#pragma once

#include "ensemble/hazard/hazard_layers.hpp"
#include "ensemble/hazard/known_ground.hpp"
#include "ensemble/hazard/member_cells.hpp"
#include "scenarios/layers/layer_stream.hpp"

#include <span>
#include <utility>
#include <vector>

namespace sturz {

class LayerBlock {
 public:
  /// \param extent the map's place in the members' grid
  LayerBlock(const HazardLayers& layers, const Window& extent, KnownGround ground, LayerSink& to)
      : layers_(layers),
        extent_(extent),
        ground_(std::move(ground)),
        to_(to),
        values_(layers.stack.layers.size()) {}

  /// Takes the rows of a block one after the other. \param begin (block) before its first ones
  /// \param fill (cell of the rows, cell of the block) for each cell that a member touched; after
  /// the last ones the block is handed over
  template <class Begin, class Fill>
  void add(const CellRows& rows, const Begin& begin, const Fill& fill) {
    if (rows.window.row0 == rows.block.row0) begin(rows.block);
    const auto skipped = static_cast<std::size_t>(rows.window.row0 - rows.block.row0) *
                         static_cast<std::size_t>(rows.block.n_cols);
    for (std::size_t i = 0; i < rows.window.n_cells(); ++i) {
      if (rows.members_of(i).empty()) continue;
      touched_[skipped + i] = true;  // known ground: a member came
      fill(i, skipped + i);
    }
    if (rows.completes_block()) finish(rows.block);
  }
  template <class Fill>
  void add(const CellRows& rows, const Fill& fill) {
    add(
        rows, [this](const Window& block) { begin(block); }, fill);
  }
  /// Every cell as if no member came.
  void begin(const Window& block) {
    n_cells_ = block.n_cells();
    touched_.assign(n_cells_, false);
    for (std::size_t l = 0; l < values_.size(); ++l)
      values_[l].assign(layers_.stack.layers[l].n_planes() * n_cells_, layers_.untouched[l]);
  }
  void put(std::size_t layer, std::size_t plane, std::size_t cell, double value) {
    values_[layer][plane * n_cells_ + cell] = static_cast<float>(value);
  }

 private:
  /// Takes out what lies on no known ground, and hands the block over.
  void finish(const Window& block) {
    for (std::size_t cell = 0; cell < n_cells_; ++cell) {
      const auto n_cols = static_cast<std::size_t>(block.n_cols);
      const int row = block.row0 + static_cast<int>(cell / n_cols);
      const int col = block.col0 + static_cast<int>(cell % n_cols);
      if (touched_[cell] || ground_.at(row, col)) continue;
      for (std::size_t l = 0; l < values_.size(); ++l)
        for (std::size_t i = cell; i < values_[l].size(); i += n_cells_)
          if (!layers_.stack.layers[l].is_count()) values_[l][i] = nan_f;
    }
    const Window window{block.row0 - extent_.row0, block.col0 - extent_.col0, block.n_rows,
                        block.n_cols};
    for (std::size_t l = 0; l < values_.size(); ++l)
      for (std::size_t plane = 0; plane < layers_.stack.layers[l].n_planes(); ++plane)
        to_.put(l, plane, window, std::span(values_[l]).subspan(plane * n_cells_, n_cells_));
  }

  const HazardLayers& layers_;
  Window extent_;
  KnownGround ground_;
  LayerSink& to_;
  std::size_t n_cells_ = 0;                 // of the block
  std::vector<std::vector<float>> values_;  // [layer][plane][cell of the block]
  std::vector<bool> touched_;               // [cell of the block]
};

}  // namespace sturz
