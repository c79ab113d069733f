// SPDX-License-Identifier: Apache-2.0
/// Loops over particles by threads, and sums whose bits do not depend on how many there are.
#pragma once

#include <omp.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace sturz {

/// Items per block of an ordered reduction; fixed, so that the order of additions is fixed.
inline constexpr std::size_t reduction_block = 1024;

/// Calls body(begin, end) for consecutive ranges of `grain` items.
template <class Body>
void parallel_ranges(std::size_t n, std::size_t grain, int threads, Body&& body) {
  const std::size_t n_ranges = (n + grain - 1) / grain;
  if (threads <= 1 || n_ranges <= 1) {
    for (std::size_t r = 0; r < n_ranges; ++r) body(r * grain, std::min(n, (r + 1) * grain));
    return;
  }
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
  for (std::ptrdiff_t r = 0; r < static_cast<std::ptrdiff_t>(n_ranges); ++r) {
    const std::size_t begin = static_cast<std::size_t>(r) * grain;
    body(begin, std::min(n, begin + grain));
  }
}

/// Combines body(begin, end, identity) over fixed blocks in index order: the same bits at any
/// thread count. `combine(Value& total, const Value& block)`.
template <class Value, class Body, class Combine>
Value ordered_reduce(std::size_t n, int threads, const Value& identity, Body&& body,
                     Combine&& combine) {
  const std::size_t n_blocks = (n + reduction_block - 1) / reduction_block;
  Value total = identity;
  if (threads <= 1 || n_blocks <= 1) {
    for (std::size_t b = 0; b < n_blocks; ++b) {
      Value block = identity;
      body(b * reduction_block, std::min(n, (b + 1) * reduction_block), block);
      combine(total, block);
    }
    return total;
  }
  std::vector<Value> blocks(n_blocks, identity);
  parallel_ranges(n, reduction_block, threads, [&](std::size_t begin, std::size_t end) {
    body(begin, end, blocks[begin / reduction_block]);
  });
  for (const Value& block : blocks) combine(total, block);
  return total;
}

}  // namespace sturz
