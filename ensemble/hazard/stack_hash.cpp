// SPDX-License-Identifier: Apache-2.0
#include "ensemble/hazard/stack_hash.hpp"

#include <cstring>
#include <span>
#include <string>
#include <vector>

namespace sturz {
namespace {

class Fnv1a {
 public:
  void add(const void* data, std::size_t n_bytes) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < n_bytes; ++i) hash_ = (hash_ ^ bytes[i]) * 0x100000001b3ULL;
  }
  template <class T>
  void add_number(T value) {
    add(&value, sizeof value);
  }
  /// The length goes first, so that neighbours cannot trade their bytes.
  void add_text(const std::string& text) {
    add_number(static_cast<std::uint64_t>(text.size()));
    add(text.data(), text.size());
  }
  template <class T>
  void add_numbers(const std::vector<T>& values) {
    add_number(static_cast<std::uint64_t>(values.size()));
    add(values.data(), values.size() * sizeof(T));
  }
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325ULL;
};

}  // namespace

std::uint64_t hash_of(const LayerStack& stack) {
  Fnv1a hash;
  hash.add_number(static_cast<std::int64_t>(stack.grid.n_rows));
  hash.add_number(static_cast<std::int64_t>(stack.grid.n_cols));
  hash.add_number(stack.grid.west_m);
  hash.add_number(stack.grid.north_m);
  hash.add_number(stack.grid.cell_m);
  for (const Layer& layer : stack.layers) {
    hash.add_text(layer.name);
    hash.add_text(layer.units);
    hash.add_text(layer.axis.name);
    hash.add_text(layer.axis.units);
    hash.add_numbers(layer.axis.values);
    hash.add_numbers(layer.values);
  }
  return hash.value();
}

}  // namespace sturz
