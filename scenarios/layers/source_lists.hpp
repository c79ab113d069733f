// SPDX-License-Identifier: Apache-2.0
/// Which sources of a region reach which cell: compressed rows, touched cells only.
#pragma once

#include "engine/terrain/raster.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace sturz {

/// The map of the largest probability of any one source: what a page of a region shows first.
inline constexpr const char* likeliest_source_layer = "highest_probability_of_a_hit";

/// A source that reaches a cell, and how often.
struct SourceHit {
  std::uint32_t source = 0;  ///< place in SourceLists::sources
  float probability = 0;     ///< share of its valid members that reach the cell
  bool operator==(const SourceHit&) const = default;
};

struct SourceLists {
  Grid grid;                         ///< whose cells these are
  std::vector<std::string> sources;  ///< names, in the order of the features
  /// Cells that some source reaches, row * n_cols + col, rising.
  std::vector<std::int64_t> cells;
  /// Hits of cells[i] are [begin[i], begin[i + 1]), by ascending source; one more than cells.
  std::vector<std::size_t> begin{0};
  std::vector<SourceHit> hits;

  /// Empty where no source comes.
  std::span<const SourceHit> at(std::int64_t cell) const {
    const auto found = std::lower_bound(cells.begin(), cells.end(), cell);
    if (found == cells.end() || *found != cell) return {};
    const auto i = static_cast<std::size_t>(found - cells.begin());
    return {hits.data() + begin[i], begin[i + 1] - begin[i]};
  }
};

/// The source with the largest probability of a cell's hits, the first of several; `none` for no
/// hits.
inline std::uint32_t likeliest(std::span<const SourceHit> hits, std::uint32_t none) {
  const auto best = std::max_element(
      hits.begin(), hits.end(),
      [](const SourceHit& a, const SourceHit& b) { return a.probability < b.probability; });
  return best == hits.end() ? none : best->source;
}

}  // namespace sturz
