// SPDX-License-Identifier: Apache-2.0
#include "ensemble/hazard/stack_hash.hpp"

#include "engine/core/hash.hpp"

#include <algorithm>
#include <bit>
#include <span>
#include <string>
#include <vector>

namespace sturz {
namespace {

/// The length goes first, so that neighbours cannot trade their bytes.
template <class List>
void add_all(Hash64& hash, const List& list) {
  hash.add(static_cast<std::uint64_t>(list.size()));
  hash.add(std::span(list.data(), list.size()));
}

/// The finalizer of SplitMix64 (Steele, Lea and Flood 2014): every bit of the input moves half of
/// the output's.
std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31);
}

}  // namespace

StackHash::StackHash(const LayerStack& about) : grid_(about.grid) {
  Hash64 hash;
  hash.add(static_cast<std::int64_t>(grid_.n_rows));
  hash.add(static_cast<std::int64_t>(grid_.n_cols));
  hash.add(grid_.west_m);
  hash.add(grid_.north_m);
  hash.add(grid_.cell_m);
  for (const Layer& layer : about.layers) {
    add_all(hash, layer.name);
    add_all(hash, layer.units);
    add_all(hash, layer.axis.name);
    add_all(hash, layer.axis.units);
    add_all(hash, layer.axis.values);
  }
  header_ = hash.value();
}

void StackHash::add(std::size_t layer, std::size_t plane, const Window& w,
                    std::span<const float> values) {
  const std::uint64_t place_of_plane = mixed((layer + 1) << 32 | plane);
  std::size_t i = 0;
  for (int row = 0; row < w.n_rows; ++row) {
    const std::size_t first = grid_.index(w.row0 + row, w.col0);
    for (int col = 0; col < w.n_cols; ++col, ++i)
      sum_ += mixed(mixed(place_of_plane + first + static_cast<std::size_t>(col)) +
                    std::bit_cast<std::uint32_t>(values[i]));
  }
}

void HashingSource::read(std::size_t layer, std::size_t plane, const Window& window,
                         std::span<float> out) const {
  from_.read(layer, plane, window, out);
  hash_.add(layer, plane, window, out);
  is_read_[layer] = true;
}

std::uint64_t HashingSource::value(CancelFlag cancel) const {
  constexpr int band = 128;  // rows
  const Grid& grid = about().grid;
  std::vector<float> rows;
  const std::vector<bool> is_read = is_read_;
  for (std::size_t l = 0; l < about().layers.size(); ++l) {
    if (is_read[l]) continue;
    for (std::size_t plane = 0; plane < about().layers[l].n_planes(); ++plane)
      for (int row0 = 0; row0 < grid.n_rows; row0 += band) {
        cancel.check();
        const Window w{row0, 0, std::min(band, grid.n_rows - row0), grid.n_cols};
        rows.resize(w.n_cells());
        read(l, plane, w, rows);
      }
  }
  return hash_.value();
}

std::uint64_t hash_of(const LayerStack& stack) {
  StackHash hash(stack);
  const std::size_t n = stack.grid.n_cells();
  for (std::size_t l = 0; l < stack.layers.size(); ++l)
    for (std::size_t plane = 0; plane < stack.layers[l].n_planes(); ++plane)
      hash.add(l, plane, {0, 0, stack.grid.n_rows, stack.grid.n_cols},
               std::span(stack.layers[l].values).subspan(plane * n, n));
  return hash.value();
}

}  // namespace sturz
