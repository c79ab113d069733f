// SPDX-License-Identifier: Apache-2.0
/// Maps that pass by window by window, because all planes together may be more than memory holds.
#pragma once

#include "engine/core/error.hpp"
#include "scenarios/layers/layer_stack.hpp"

#include <algorithm>
#include <span>

namespace sturz {

/// Takes in maps. Windows may come in any order, each cell of each plane once.
class LayerSink {
 public:
  virtual ~LayerSink() = default;
  /// \param about all layers and attributes, without values; lives as long as the sink is used
  virtual void begin(const LayerStack& about) = 0;
  /// \param layer,plane places in about.layers and on the layer's axis
  /// \param values [window.n_rows][window.n_cols]
  virtual void put(std::size_t layer, std::size_t plane, const Window& window,
                   std::span<const float> values) = 0;
};

/// Hands out maps.
class LayerSource {
 public:
  virtual ~LayerSource() = default;
  /// All layers and attributes; values may be absent.
  virtual const LayerStack& about() const = 0;
  /// \param out [window.n_rows][window.n_cols]
  virtual void read(std::size_t layer, std::size_t plane, const Window& window,
                    std::span<float> out) const = 0;
};

/// Maps into memory.
class StackSink final : public LayerSink {
 public:
  void begin(const LayerStack& about) override {
    stack = about;
    for (Layer& layer : stack.layers)
      layer.values.assign(layer.n_planes() * stack.grid.n_cells(), nan_f);
  }
  void put(std::size_t layer, std::size_t plane, const Window& w,
           std::span<const float> values) override {
    float* to = stack.layers[layer].values.data() + plane * stack.grid.n_cells();
    for (int row = 0; row < w.n_rows; ++row)
      std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(row) * w.n_cols, w.n_cols,
                  to + stack.grid.index(w.row0 + row, w.col0));
  }

  LayerStack stack;
};

/// Maps out of memory; the stack must outlive it.
class StackSource final : public LayerSource {
 public:
  /// \throws SetupError when a layer does not fill its planes
  explicit StackSource(const LayerStack& stack) : stack_(stack) {
    for (const Layer& layer : stack.layers)
      require(layer.values.size() == layer.n_planes() * stack.grid.n_cells(),
              "layer '" + layer.name + "' has " + std::to_string(layer.values.size()) +
                  " values, not " + std::to_string(layer.n_planes()) + " planes of " +
                  std::to_string(stack.grid.n_cells()) + " cells. Fill every plane.");
  }
  const LayerStack& about() const override { return stack_; }
  void read(std::size_t layer, std::size_t plane, const Window& w,
            std::span<float> out) const override {
    const float* from = stack_.layers[layer].values.data() + plane * stack_.grid.n_cells();
    for (int row = 0; row < w.n_rows; ++row)
      std::copy_n(from + stack_.grid.index(w.row0 + row, w.col0), w.n_cols,
                  out.begin() + static_cast<std::ptrdiff_t>(row) * w.n_cols);
  }

 private:
  const LayerStack& stack_;
};

}  // namespace sturz
