// SPDX-License-Identifier: Apache-2.0
#include "ensemble/hazard/sorting/sorted_values.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

namespace sturz {
namespace {

TEST(ValueSorter, GivesTheOrderOfComparing) {
  std::mt19937 random(4);
  ValueSorter sorter;
  for (const std::size_t n : {std::size_t{0}, std::size_t{1}, ValueSorter::few - 1,
                              ValueSorter::few, std::size_t{1000}, std::size_t{70000}})
    for (const float scale : {1e-42F, 1e-3F, 1.0F, 3e4F, 1e38F}) {
      std::vector<float> values(n), expected;
      for (float& v : values)
        v = random() % 9 == 0 ? static_cast<float>(random() % 3)  // equal ones, and zeros
                              : scale * std::uniform_real_distribution<float>(0, 1)(random);
      if (n > 10) values[7] = std::numeric_limits<float>::infinity();
      expected = values;
      std::sort(expected.begin(), expected.end());
      sorter.sort(values);
      EXPECT_EQ(values, expected) << n << " " << scale;
    }
}

TEST(ValueSorter, TakesMinusZeroForZero) {
  std::vector<float> values(200, -0.0F);
  values[5] = 1, values[199] = 2;
  ValueSorter().sort(values);
  EXPECT_EQ(values[197], 0);
  EXPECT_EQ(values[198], 1);
  EXPECT_EQ(values[199], 2);
}

}  // namespace
}  // namespace sturz
