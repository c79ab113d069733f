// SPDX-License-Identifier: Apache-2.0
#include "ensemble/hazard/sorting/rank_finder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

namespace sturz {
namespace {

TEST(RankFinder, FindsWhatSortingWouldPutThere) {
  std::mt19937 random(4);
  RankFinder finder;
  for (const std::size_t n : {std::size_t{1}, RankFinder::few - 1, RankFinder::few,
                              std::size_t{1000}, std::size_t{70000}})
    for (const float scale : {1e-42F, 1e-3F, 1.0F, 3e4F, 1e38F})
      for (const int kinds : {1, 3, 1000000}) {
        std::vector<float> values(n);
        for (float& v : values) {
          const float u = std::uniform_real_distribution<float>(0, 1)(random);
          v = kinds > 3 ? scale * u * u * u : scale * static_cast<float>(random() % kinds);
        }
        if (n > 10 && kinds > 3) values[7] = std::numeric_limits<float>::infinity();
        std::vector<std::size_t> ranks{0, n / 20, n / 20, n / 2, n - 1};
        for (int i = 0; i < 5; ++i) ranks.push_back(random() % n);
        std::sort(ranks.begin(), ranks.end());
        std::vector<float> found(ranks.size());
        finder.find(values, ranks, found);
        std::sort(values.begin(), values.end());
        for (std::size_t r = 0; r < ranks.size(); ++r)
          EXPECT_EQ(found[r], values[ranks[r]]) << n << " " << scale << " " << ranks[r];
      }
}

TEST(RankFinder, TakesMinusZeroForZero) {
  std::vector<float> values(200, -0.0F);
  values[5] = 1, values[199] = 2;
  const std::vector<std::size_t> ranks{0, 197, 198, 199};
  std::vector<float> found(4);
  RankFinder().find(values, ranks, found);
  EXPECT_EQ(found, (std::vector<float>{0, 0, 1, 2}));
}

TEST(RankFinder, IsAskedForNothing) {
  const std::vector<float> values(200, 1.0F);
  RankFinder().find(values, {}, {});
}

}  // namespace
}  // namespace sturz
