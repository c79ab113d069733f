// SPDX-License-Identifier: Apache-2.0
#include "ensemble/hazard/stack_hash.hpp"

#include "engine/core/hash.hpp"

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

}  // namespace

std::uint64_t hash_of(const LayerStack& stack) {
  Hash64 hash;
  hash.add(static_cast<std::int64_t>(stack.grid.n_rows));
  hash.add(static_cast<std::int64_t>(stack.grid.n_cols));
  hash.add(stack.grid.west_m);
  hash.add(stack.grid.north_m);
  hash.add(stack.grid.cell_m);
  for (const Layer& layer : stack.layers) {
    add_all(hash, layer.name);
    add_all(hash, layer.units);
    add_all(hash, layer.axis.name);
    add_all(hash, layer.axis.units);
    add_all(hash, layer.axis.values);
    add_all(hash, layer.values);
  }
  return hash.value();
}

}  // namespace sturz
