// SPDX-License-Identifier: Apache-2.0
/// Sorting of one cell's values, which takes most of a map's time when members are many.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sturz {

/// Sorts numbers none of which is negative or undefined; keeps its scratch memory. Few of them by
/// std::sort, many byte by byte of their bits, whose order is that of the numbers: 7 ns a value
/// where comparing takes 25 and more.
class ValueSorter {
 public:
  /// Below this many, clearing the counters costs more than it saves.
  static constexpr std::size_t few = 96;

  void sort(std::vector<float>& values);

 private:
  std::vector<std::uint32_t> keys_, other_;
};

}  // namespace sturz
