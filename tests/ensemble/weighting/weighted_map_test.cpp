// SPDX-License-Identifier: Apache-2.0
#include "ensemble/hazard/hazard_layers.hpp"
#include "ensemble/hazard/hazard_map.hpp"
#include "ensemble/hazard/weighting/weighted_sample.hpp"
#include "tests/support/memory_members.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace sturz {
namespace {

using test::MemoryMembers;
using test::random_member;
using test::small_grid;
using ::testing::HasSubstr;

MemberResult member_of(std::int64_t number, const Grid& grid, float thickness, float arrival) {
  MemberResult m;
  m.member = number;
  m.outcome = Outcome::settled;
  m.grid = grid;
  m.window = {0, 0, 1, 1};
  for (int k = 0; k < n_peak_layers; ++k)
    m.layers[k].assign(1, info(static_cast<PeakLayer>(k)).untouched);
  m.layer(PeakLayer::thickness) = {thickness};
  m.layer(PeakLayer::arrival) = {arrival};
  return m;
}

/// Three members of weights 0.5, 0.3 and 0.2: 2.63 effective ones.
class WeightedMap : public testing::Test {
 protected:
  WeightedMap() : source_(small_grid(1, 2)) {
    source_.add(member_of(0, source_.grid(), 2, 4));
    MemberResult failed;
    failed.member = 1;
    failed.outcome = Outcome::failed;
    source_.add(failed);
    source_.add(member_of(2, source_.grid(), 0, nan_f));
    source_.add(member_of(3, source_.grid(), 1, 9));
    spec_.thickness_m = {0.5, 1};
    spec_.quantiles = {0.5};
    HazardContext context;
    context.weights = weights_;
    map_ = make_hazard_map(source_, spec_, context);
  }
  float at(const std::string& name, std::size_t plane = 0, std::size_t cell = 0) const {
    const Layer* layer = map_.find(name);
    return layer == nullptr ? nan_f : layer->values[plane * map_.grid.n_cells() + cell];
  }
  std::vector<double> weights_{0.5, 0.3, 0.2};
  MemoryMembers source_;
  HazardSpec spec_;
  LayerStack map_;
};

TEST_F(WeightedMap, SharesAreOfWeight) {
  EXPECT_FLOAT_EQ(at("probability_of_reach"), 0.7F);
  EXPECT_FLOAT_EQ(at("thickness_exceedance", 0), 0.7F);  // above 0.5 m
  EXPECT_FLOAT_EQ(at("thickness_exceedance", 1), 0.5F);  // strictly above 1 m
  EXPECT_FLOAT_EQ(at("probability_of_medium_intensity"), 0.7F);
  EXPECT_FLOAT_EQ(at("thickness_mean"), 0.5F * 2 + 0.2F * 1);
  EXPECT_FLOAT_EQ(at("probability_of_reach", 0, 1), 0);
  EXPECT_FLOAT_EQ(at("number_of_members"), 3);
}

TEST_F(WeightedMap, BoundsAreThoseOfTheEffectiveMembers) {
  const double n = 1 / (0.25 + 0.09 + 0.04);
  const ProbabilityBounds bounds = wilson_interval_of_share(0.7, n);
  EXPECT_FLOAT_EQ(at("probability_of_reach_lower"), static_cast<float>(bounds.lower));
  EXPECT_FLOAT_EQ(at("probability_of_reach_upper"), static_cast<float>(bounds.upper));
  const ProbabilityBounds none = wilson_interval_of_share(0, n);
  EXPECT_FLOAT_EQ(at("probability_of_reach_upper", 0, 1), static_cast<float>(none.upper));
  EXPECT_EQ(at("probability_of_reach_lower", 0, 1), 0);
}

TEST_F(WeightedMap, QuantilesAreWeighted) {
  // 0 with 0.3, 1 with 0.2, 2 with 0.5 in the window 0.31 .. 0.69.
  EXPECT_NEAR(at("thickness_quantile"), 1.5, 1e-6);
  // Of the two that came: 4 with 5/7, 9 with 2/7, 1.6897 effective, window 0.2041 .. 0.7959.
  EXPECT_NEAR(at("arrival_quantile"), 4.689655, 1e-5);
}

TEST_F(WeightedMap, SaysThatItIsWeighted) {
  const std::string text = "weighted by posterior, effective members = 2.6";
  EXPECT_THAT(map_.find("probability_of_reach")->comment, HasSubstr(text));
  EXPECT_THAT(map_.find("thickness_exceedance_upper")->comment, HasSubstr(text));
  EXPECT_THAT(map_.find("thickness_quantile")->comment, HasSubstr(text));
  EXPECT_THAT(map_.attributes, testing::Contains(testing::Pair("weighting", text)));
}

TEST(WeightedMaps, OfEqualWeightsAreTheUnweightedMap) {
  std::mt19937 random(12);
  MemoryMembers source(small_grid(20, 30));
  for (int m = 0; m < 25; ++m) source.add(random_member(m, source.grid(), random));
  const std::vector<double> weights(25, 1.0 / 25);
  HazardContext context;
  const LayerStack plain = make_hazard_map(source, {}, context);
  context.weights = weights;
  const LayerStack weighted = make_hazard_map(source, {}, context);
  ASSERT_EQ(plain.layers.size(), weighted.layers.size());
  for (std::size_t l = 0; l < plain.layers.size(); ++l) {
    ASSERT_EQ(plain.layers[l].values.size(), weighted.layers[l].values.size());
    for (std::size_t i = 0; i < plain.layers[l].values.size(); ++i) {
      const float a = plain.layers[l].values[i], b = weighted.layers[l].values[i];
      if (std::isnan(a) && std::isnan(b)) continue;
      EXPECT_NEAR(a, b, 1e-5F * (1 + std::abs(a))) << plain.layers[l].name;
    }
  }
}

TEST(WeightedMaps, OfOneMemberWithAllTheWeightAreItsOwn) {
  std::mt19937 random(2);
  MemoryMembers source(small_grid(6, 6));
  for (int m = 0; m < 5; ++m) source.add(random_member(m, source.grid(), random));
  const std::vector<double> weights{0, 0, 1, 0, 0};
  HazardContext context;
  context.weights = weights;
  const LayerStack map = make_hazard_map(source, {}, context);
  const Layer& reach = *map.find("probability_of_reach");
  for (int row = 0; row < map.grid.n_rows; ++row)
    for (int col = 0; col < map.grid.n_cols; ++col)
      EXPECT_EQ(reach.values[map.grid.index(row, col)],
                std::isnan(source.value(2, PeakLayer::arrival, row, col)) ? 0 : 1);
}

}  // namespace
}  // namespace sturz
