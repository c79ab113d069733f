// SPDX-License-Identifier: Apache-2.0
#include "ensemble/hazard/stack_hash.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace sturz {
namespace {

LayerStack stack() {
  LayerStack s;
  s.grid.n_rows = 1;
  s.grid.n_cols = 2;
  Layer layer;
  layer.name = "peak_speed";
  layer.units = "m s-1";
  layer.values = {1, nan_f};
  s.layers.push_back(layer);
  return s;
}

TEST(StackHash, OfNothingFollowsTheDefinitionOfFnv) {
  // Five numbers of 8 bytes: 0, 0, 0.0, 0.0 and 1.0, fed through the published recurrence.
  std::uint64_t expected = 14695981039346656037ULL;
  const unsigned char one[8] = {0, 0, 0, 0, 0, 0, 0xF0, 0x3F};
  for (int i = 0; i < 40; ++i)
    expected = (expected ^ (i < 32 ? 0 : one[i - 32])) * 1099511628211ULL;
  EXPECT_EQ(hash_of(LayerStack{}), expected);
}

TEST(StackHash, SeesEveryValueNameAndPlace) {
  const std::uint64_t hash = hash_of(stack());
  EXPECT_EQ(hash_of(stack()), hash);
  LayerStack other = stack();
  other.layers[0].values[0] = std::nextafter(1.0F, 2.0F);
  EXPECT_NE(hash_of(other), hash);
  other = stack();
  other.layers[0].name = "mean_speed";
  EXPECT_NE(hash_of(other), hash);
  other = stack();
  other.grid.west_m = 1;
  EXPECT_NE(hash_of(other), hash);
  other = stack();
  std::swap(other.layers[0].values[0], other.layers[0].values[1]);
  EXPECT_NE(hash_of(other), hash);
}

TEST(StackHash, DoesNotSeeInWhichWindowsValuesCome) {
  LayerStack s = stack();
  s.grid.n_rows = 3;
  s.layers[0].values = {1, 2, 3, nan_f, 0, 4};
  StackHash parts(s);
  const std::vector<float> right{2, nan_f, 4}, left{1, 3, 0};
  parts.add(0, 0, {0, 1, 3, 1}, right);
  parts.add(0, 0, {0, 0, 3, 1}, left);
  EXPECT_EQ(parts.value(), hash_of(s));
}

TEST(StackHash, IgnoresDatesAndComments) {
  LayerStack other = stack();
  other.attributes.emplace_back("history", "today");
  other.layers[0].comment = "text";
  EXPECT_EQ(hash_of(other), hash_of(stack()));
}

}  // namespace
}  // namespace sturz
