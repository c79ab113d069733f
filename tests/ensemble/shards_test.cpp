// SPDX-License-Identifier: Apache-2.0
#include "ensemble/members/shards.hpp"

#include "engine/core/error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace sturz {
namespace {

using testing::ElementsAre;

TEST(Shards, TogetherHoldEveryMemberOnce) {
  for (const int n : {1, 2, 3, 7, 40}) {
    std::multiset<std::int64_t> all;
    for (int k = 1; k <= n; ++k) {
      const auto shard = shard_members(20, k, n);
      EXPECT_TRUE(std::is_sorted(shard.begin(), shard.end()));
      all.insert(shard.begin(), shard.end());
    }
    EXPECT_EQ(all.size(), 20U);
    EXPECT_EQ(std::set(all.begin(), all.end()).size(), 20U);
  }
}

TEST(Shards, TakeEveryNthMember) {
  EXPECT_THAT(shard_members(8, 2, 3), ElementsAre(1, 4, 7));
  EXPECT_TRUE(shard_members(2, 3, 3).empty());
}

TEST(Shards, CountFromOne) {
  EXPECT_THROW(shard_members(8, 0, 3), SetupError);
  EXPECT_THROW(shard_members(8, 4, 3), SetupError);
  EXPECT_THROW(shard_members(8, 1, 0), SetupError);
}

TEST(LongestFirst, SortsByCostAndKeepsTheOrderOfEquals) {
  const std::vector<double> seconds{1, 5, 5, 9};
  EXPECT_THAT(longest_first({10, 11, 12, 13}, seconds), ElementsAre(13, 11, 12, 10));
  EXPECT_THAT(longest_first({3, 1, 2}, {}), ElementsAre(3, 1, 2));
}

}  // namespace
}  // namespace sturz
