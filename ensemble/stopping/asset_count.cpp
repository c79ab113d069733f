// SPDX-License-Identifier: Apache-2.0
#include "ensemble/stopping/asset_count.hpp"

#include "engine/core/error.hpp"
#include "ensemble/hazard/wilson.hpp"

#include <algorithm>
#include <cmath>

namespace sturz {

void AssetCount::add(const Grid& grid, const Window& window, std::span<const float> arrival,
                     Censoring censoring) {
  expect(arrival.size() == window.n_cells(), "an arrival for each cell of the window");
  const auto width = static_cast<std::size_t>(grid.n_cols);
  const bool hit = std::any_of(asset_.cells.begin(), asset_.cells.end(), [&](std::size_t cell) {
    const auto row = static_cast<int>(cell / width), col = static_cast<int>(cell % width);
    if (!window.contains(row, col)) return false;
    const auto place =
        static_cast<std::size_t>(row - window.row0) * static_cast<std::size_t>(window.n_cols) +
        static_cast<std::size_t>(col - window.col0);
    return !std::isnan(arrival[place]);
  });
  ++n_valid_;
  n_hit_ += hit;
  n_not_known_ += !hit && is_censored(censoring);
}

void AssetCount::add(const MemberResult& member) {
  if (is_valid(member.outcome))
    add(member.grid, member.window, member.layer(PeakLayer::arrival), member.censoring);
}

LargestHalfWidth AssetCount::half_width() const {
  LargestHalfWidth found;
  found.at = LookedAt::asset;
  found.n_cells = static_cast<std::int64_t>(asset_.cells.size());
  found.n_valid = n_valid_;
  found.n_not_known = n_not_known_;
  found.half_width = (wilson_interval(n_hit_ + n_not_known_, n_valid_).upper -
                      wilson_interval(n_hit_, n_valid_).lower) /
                     2;
  return found;
}

}  // namespace sturz
