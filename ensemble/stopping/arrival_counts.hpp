// SPDX-License-Identifier: Apache-2.0
/// How many of the members so far reached each cell, kept while they come.
#pragma once

#include "engine/simulation/member_result.hpp"
#include "engine/terrain/raster.hpp"

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

namespace sturz {

/// Where the largest half width was sought.
enum class LookedAt {
  uncertain_cells,  ///< those with 0.05 < P(reached) < 0.95
  reached_cells,    ///< no cell lies there: all that some member reached
  no_cell,          ///< none was reached: what a probability of 0 is known to
  asset             ///< one asset, see asset_count.hpp
};

/// How sure the probabilities are.
struct LargestHalfWidth {
  double half_width = 0;  ///< of the 95 % interval of P(reached); NaN without valid members
  LookedAt at = LookedAt::no_cell;
  std::int64_t n_cells = 0;      ///< that it is the largest of
  std::int64_t n_valid = 0;      ///< members that count
  std::int64_t n_not_known = 0;  ///< of an asset: of these, cut off before they hit it
};

/// Counts of the cells that members reached, and of the cells by that count: a look costs as many
/// steps as there are members, however large the ground. Whole numbers, so no order of the members
/// leaves a trace.
class ArrivalCounts {
 public:
  /// A member whose end is valid. \param arrival [window.n_cells()], NaN where it did not come
  void add(const Window& window, std::span<const float> arrival);
  /// The same of a member in memory; one that is not valid does not count.
  void add(const MemberResult& member);

  std::int64_t n_valid() const { return n_valid_; }
  LargestHalfWidth largest_half_width() const;

 private:
  static constexpr int edge = 64;                                       // of a tile [cells]
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> hits_;  // of each touched tile
  std::vector<std::int64_t> n_cells_{0};  // by number of hits; [0] is not kept
  std::int64_t n_valid_ = 0;
};

}  // namespace sturz
