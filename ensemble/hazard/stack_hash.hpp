// SPDX-License-Identifier: Apache-2.0
/// One number that tells whether two maps hold the same bits.
#pragma once

#include "engine/core/cancel.hpp"
#include "scenarios/layers/layer_stream.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace sturz {

/// Hash of the grid's numbers, of each layer's name, units and axis (FNV-1a, 64 bits), and of every
/// value in its place. Values are mixed one by one and summed, so the order in which windows come
/// leaves no trace. Left out: the text of the coordinate system (it depends on the PROJ release),
/// comments and global attributes (they may hold a date).
class StackHash {
 public:
  explicit StackHash(const LayerStack& about);
  void add(std::size_t layer, std::size_t plane, const Window& window,
           std::span<const float> values);
  std::uint64_t value() const { return header_ ^ sum_; }

 private:
  std::uint64_t header_ = 0, sum_ = 0;
  Grid grid_;
};

/// Of a stack in memory.
std::uint64_t hash_of(const LayerStack&);

/// Hands maps on from another source and hashes them on the way. Each layer is to be read either
/// whole, every cell once, or not at all.
class HashingSource final : public LayerSource {
 public:
  /// \param from outlives it
  explicit HashingSource(const LayerSource& from)
      : from_(from), hash_(from.about()), is_read_(from.about().layers.size(), false) {}
  const LayerStack& about() const override { return from_.about(); }
  void read(std::size_t layer, std::size_t plane, const Window& window,
            std::span<float> out) const override;
  /// Of all maps: reads what was not read. \throws Cancelled
  std::uint64_t value(CancelFlag cancel = {}) const;

 private:
  const LayerSource& from_;
  mutable StackHash hash_;
  mutable std::vector<bool> is_read_;
};

/// Hands maps on to another sink and hashes them on the way.
class HashingSink final : public LayerSink {
 public:
  explicit HashingSink(LayerSink& next) : next_(next) {}
  void begin(const LayerStack& about) override {
    hash_ = StackHash(about);
    next_.begin(about);
  }
  void put(std::size_t layer, std::size_t plane, const Window& window,
           std::span<const float> values) override {
    hash_.add(layer, plane, window, values);
    next_.put(layer, plane, window, values);
  }
  std::uint64_t value() const { return hash_.value(); }

 private:
  LayerSink& next_;
  StackHash hash_{LayerStack{}};
};

}  // namespace sturz
