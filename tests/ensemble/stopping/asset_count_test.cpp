// SPDX-License-Identifier: Apache-2.0
#include "ensemble/stopping/asset_count.hpp"

#include "ensemble/assets/asset_risk.hpp"
#include "ensemble/hazard/wilson.hpp"
#include "tests/support/memory_members.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

namespace sturz {
namespace {

using test::MemoryMembers;
using test::small_grid;

Asset house() {
  Asset asset;
  asset.name = "house";
  asset.cells = {5, 6};  // of 4 x 4
  asset.on_known_ground = true;
  return asset;
}

/// On the window of the two middle rows; reached in one cell of the whole grid, or in none.
MemberResult member(std::int64_t number, std::optional<std::size_t> cell, Censoring censoring) {
  MemberResult r;
  r.member = number;
  r.outcome = Outcome::settled;
  r.censoring = censoring;
  r.grid = small_grid(4, 4);
  r.window = {1, 0, 2, 4};
  for (int k = 0; k < n_peak_layers; ++k)
    r.layers[k].assign(8, info(static_cast<PeakLayer>(k)).untouched);
  if (cell) r.layer(PeakLayer::arrival)[*cell - 4] = 3;
  return r;
}

TEST(AssetCount, HasTheIntervalOfTheTableOfAssets) {
  MemoryMembers members(small_grid(4, 4));
  AssetCount count(house());
  std::int64_t number = 0;
  const auto come = [&](std::optional<std::size_t> cell, Censoring censoring) {
    const MemberResult m = member(number++, cell, censoring);
    members.add(m);
    count.add(m);
  };
  come(6, Censoring::none);
  come(5, Censoring::still_moving);  // cut off after it hit: a hit
  come(7, Censoring::none);          // beside it
  come({}, Censoring::none);
  come(8, Censoring::still_moving);  // might still have come
  Assets assets;
  assets.list = {house()};
  const AssetRisk row = assess_assets(assets, find_hits(members, assets)).rows[0];
  const LargestHalfWidth found = count.half_width();
  EXPECT_EQ(found.at, LookedAt::asset);
  EXPECT_EQ(found.n_valid, 5);
  EXPECT_EQ(found.n_not_known, 1);
  EXPECT_DOUBLE_EQ(found.half_width, (row.bounds_95.upper - row.bounds_95.lower) / 2);
  EXPECT_DOUBLE_EQ(found.half_width,
                   (wilson_interval(3, 5).upper - wilson_interval(2, 5).lower) / 2);
}

TEST(AssetCount, FailedMembersDoNotCountAndWithoutAnyNothingIsKnown) {
  AssetCount count(house());
  MemberResult failed = member(0, 5, Censoring::none);
  failed.outcome = Outcome::diverged;
  count.add(failed);
  EXPECT_EQ(count.half_width().n_valid, 0);
  EXPECT_TRUE(std::isnan(count.half_width().half_width));
  count.add(small_grid(4, 4), Window{}, {}, Censoring::none);  // one that touched no cell
  EXPECT_EQ(count.half_width().half_width, wilson_interval(0, 1).upper / 2);
}

}  // namespace
}  // namespace sturz
