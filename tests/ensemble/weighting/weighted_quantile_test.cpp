// SPDX-License-Identifier: Apache-2.0
#include "ensemble/hazard/weighting/weighted_quantile.hpp"

#include "ensemble/hazard/sample_quantile.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace sturz {
namespace {

TEST(WeightedMapQuantile, ByHand) {
  // Half of 10 with 0.4 and 20 with 0.6: n = 1 / (0.16 + 0.36) = 1.9231, window 0.24 .. 0.76, of
  // which 0.16 lie on 10 and 0.36 on 20: (1.6 + 7.2) / 0.52.
  const std::vector<WeighedValue> two{{10, 0.4}, {20, 0.6}};
  EXPECT_NEAR(weighted_map_quantile(two, 0, 1 / 0.52, 0.5), 16.923076923, 1e-8);
  // A single effective member: the weighted mean, whatever the fraction.
  EXPECT_NEAR(weighted_map_quantile(two, 0, 1, 0.1), 16, 1e-12);
}

TEST(WeightedMapQuantile, ZerosComeFirst) {
  const std::vector<WeighedValue> some{{1, 0.2}, {2, 0.5}};
  const double n = 1 / 0.38;
  // Window 0.31 .. 0.69: 0.19 on 1 and 0.19 on 2.
  EXPECT_NEAR(weighted_map_quantile(some, 0.3, n, 0.5), 1.5, 1e-9);
  // 0.62 .. 1 lies on 2 alone, 0 .. 0.38 on 0 (0.3) and 1 (0.08).
  EXPECT_NEAR(weighted_map_quantile(some, 0.3, n, 1), 2, 1e-9);
  EXPECT_NEAR(weighted_map_quantile(some, 0.3, n, 0), 0.08 / 0.38, 1e-9);
  EXPECT_EQ(weighted_map_quantile({}, 1, 3, 0.9), 0);
  EXPECT_TRUE(std::isnan(weighted_map_quantile({}, 0, 3, 0.5)));
}

TEST(WeightedMapQuantile, OfEqualWeightsIsTheUnweightedOne) {
  std::mt19937 random(4);
  std::uniform_real_distribution<float> any(0.1F, 9);
  for (std::size_t n = 1; n <= 40; ++n) {
    const std::size_t n_zeros = n / 3;
    std::vector<float> values(n - n_zeros);
    for (float& v : values) v = any(random);
    std::sort(values.begin(), values.end());
    std::vector<WeighedValue> weighed;
    const double w = 1.0 / static_cast<double>(n);
    for (const float v : values) weighed.push_back({v, w});
    for (const double f : {0.0, 0.05, 0.31, 0.5, 0.95, 1.0})
      EXPECT_NEAR(weighted_map_quantile(weighed, w * static_cast<double>(n_zeros),
                                        static_cast<double>(n), f),
                  sample_quantile(values, n_zeros, f), 1e-6)
          << n << " values, " << f;
  }
}

TEST(WeightedMapQuantile, NeitherTiesNorWeightlessValuesMatter) {
  const std::vector<WeighedValue> whole{{1, 0.3}, {3, 0.7}};
  const std::vector<WeighedValue> split{{1, 0.1}, {1, 0.2}, {2, 0}, {3, 0.5}, {3, 0.2}};
  for (const double f : {0.05, 0.3, 0.6, 0.95})
    EXPECT_NEAR(weighted_map_quantile(whole, 0, 4, f), weighted_map_quantile(split, 0, 4, f), 1e-9);
}

}  // namespace
}  // namespace sturz
