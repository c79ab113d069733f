// SPDX-License-Identifier: Apache-2.0
#include "ensemble/hazard/sample_quantile.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace sturz {
namespace {

TEST(SampleQuantile, LiesOnLinesBetweenOrderStatistics) {
  const std::vector<float> x{1, 2, 4, 8};
  EXPECT_DOUBLE_EQ(sample_quantile(x, 0, 0), 1);
  EXPECT_DOUBLE_EQ(sample_quantile(x, 0, 1), 8);
  EXPECT_DOUBLE_EQ(sample_quantile(x, 0, 0.5), 3);    // numpy.quantile([1, 2, 4, 8], .5)
  EXPECT_DOUBLE_EQ(sample_quantile(x, 0, 0.9), 6.8);  // numpy.quantile([1, 2, 4, 8], .9)
}

TEST(SampleQuantile, CountsZerosAsSmallestValues) {
  const std::vector<float> x{1, 2, 4, 8}, with_zeros{0, 0, 0, 1, 2, 4, 8};
  for (const double q : {0.0, 0.05, 0.3, 0.45, 0.5, 0.77, 0.95, 1.0})
    EXPECT_DOUBLE_EQ(sample_quantile(x, 3, q), sample_quantile(with_zeros, 0, q));
}

TEST(SampleQuantile, OfOneValueIsThatValueAndOfNoneIsUndefined) {
  EXPECT_EQ(sample_quantile(std::vector<float>{5}, 0, 0.05), 5);
  EXPECT_EQ(sample_quantile({}, 1, 0.95), 0);
  EXPECT_TRUE(std::isnan(sample_quantile({}, 0, 0.5)));
}

}  // namespace
}  // namespace sturz
