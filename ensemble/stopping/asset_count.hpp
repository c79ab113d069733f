// SPDX-License-Identifier: Apache-2.0
/// How many of the members so far hit one asset, kept while they come.
#pragma once

#include "engine/simulation/member_result.hpp"
#include "ensemble/stopping/arrival_counts.hpp"
#include "scenarios/assets/assets.hpp"

#include <cstdint>
#include <span>
#include <utility>

namespace sturz {

class AssetCount {
 public:
  /// \param asset of the maps that the members are on, not outside
  explicit AssetCount(Asset asset) : asset_(std::move(asset)) {}

  /// A member whose end is valid. \param grid of the whole maps, \param arrival [window.n_cells()],
  /// NaN where it did not come
  void add(const Grid& grid, const Window& window, std::span<const float> arrival, Censoring);
  /// The same of a member in memory; one that is not valid does not count.
  void add(const MemberResult& member);

  /// Half of the 95 % interval of the probability of a hit as the table of assets has it: members
  /// that were cut off before they hit count as no hit at its lower end, as a hit at its upper one.
  LargestHalfWidth half_width() const;

 private:
  Asset asset_;
  std::int64_t n_hit_ = 0, n_not_known_ = 0, n_valid_ = 0;
};

}  // namespace sturz
