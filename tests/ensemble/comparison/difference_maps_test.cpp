// SPDX-License-Identifier: Apache-2.0
// Two small ensembles compared cell by cell, against counts made by hand.
#include "ensemble/comparison/difference_maps.hpp"

#include "ensemble/comparison/asset_differences.hpp"
#include "ensemble/hazard/wilson.hpp"
#include "tests/support/memory_members.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace sturz::test {
namespace {

using ::testing::HasSubstr;

struct Cell {
  std::size_t cell;
  float thickness;
};

MemberResult member(std::int64_t number, const std::vector<Cell>& cells) {
  MemberResult r;
  r.member = number;
  r.outcome = Outcome::settled;
  r.grid = small_grid(4, 4);
  r.window = whole_of(r.grid);
  for (int k = 0; k < n_peak_layers; ++k)
    r.layers[k].assign(16, info(static_cast<PeakLayer>(k)).untouched);
  for (const Cell& c : cells) {
    r.layer(PeakLayer::arrival)[c.cell] = 3;
    r.layer(PeakLayer::thickness)[c.cell] = c.thickness;
  }
  return r;
}

/// Without a dam: cell 5 by members 0, 1, 2; member 4 failed.
MemoryMembers without_dam() {
  MemoryMembers m(small_grid(4, 4));
  m.add(member(0, {{5, 2}}));
  m.add(member(1, {{5, 2}}));
  m.add(member(2, {{5, 0.5F}}));
  m.add(member(3, {}));
  MemberResult failed = member(4, {{5, 9}});
  failed.outcome = Outcome::failed;
  m.add(failed);
  m.add(member(5, {}));
  return m;
}

/// With it: cell 5 by members 0 and 5 alone, thinner; member 4 is valid here.
MemoryMembers with_dam() {
  MemoryMembers m(small_grid(4, 4));
  m.add(member(0, {{5, 0.5F}}));
  m.add(member(1, {{6, 1}}));
  m.add(member(2, {{6, 1}}));
  m.add(member(3, {}));
  m.add(member(4, {{5, 3}}));
  m.add(member(5, {{5, 3}}));
  return m;
}

class DifferenceMaps : public ::testing::Test {
 protected:
  LayerStack maps(const MemberPairs& pairs) {
    DifferenceContext context;
    context.thickness_m = {1};
    StackSink sink;
    summary = make_difference_maps(joined, pairs, context, sink);
    return std::move(sink.stack);
  }
  static float at(const LayerStack& maps, const std::string& name, std::size_t cell) {
    const Layer* layer = maps.find(name);
    return layer == nullptr ? -99 : layer->values[cell];
  }
  const MemoryMembers a = without_dam(), b = with_dam();
  const JoinedMembers joined{{&a, &b}};
  DifferenceSummary summary;
};

TEST_F(DifferenceMaps, CountPairsByHand) {
  const MemberPairs pairs = find_pairs(a, b);
  EXPECT_EQ(pairs.n, 5U);  // 0, 1, 2, 3 and 5
  EXPECT_EQ(pairs.n_a, 5U);
  EXPECT_EQ(pairs.n_b, 6U);
  const LayerStack m = maps(pairs);
  // Cell 5: both 1 (member 0), only A 2 (1, 2), only B 1 (5), neither 1 (3).
  const DifferenceBounds d = paired_difference({1, 2, 1, 1});
  EXPECT_FLOAT_EQ(at(m, "probability_difference", 5), -0.2F);
  EXPECT_FLOAT_EQ(at(m, "probability_difference_lower", 5), static_cast<float>(d.lower));
  EXPECT_FLOAT_EQ(at(m, "probability_difference_upper", 5), static_cast<float>(d.upper));
  // The same five of each as if they were no pairs: 3 and 2 of 5, and without B's member 4.
  const DifferenceBounds heaps = unpaired_difference(3, 5, 2, 5);
  EXPECT_FLOAT_EQ(at(m, "probability_difference_unpaired_lower", 5),
                  static_cast<float>(heaps.lower));
  EXPECT_FLOAT_EQ(at(m, "probability_smallest", 5), 0.5F);
  EXPECT_FLOAT_EQ(at(m, "probability_largest", 5), 0.6F);
  EXPECT_FLOAT_EQ(at(m, "probability_band_lower", 5),
                  static_cast<float>(wilson_interval(3, 6).lower));
  EXPECT_FLOAT_EQ(at(m, "probability_band_upper", 5),
                  static_cast<float>(wilson_interval(3, 5).upper));
  // Thicker than 1 m: members 0 and 1 without, 5 with the dam.
  EXPECT_FLOAT_EQ(at(m, "thickness_exceedance_difference", 5), -0.2F);
  // Cell 6: only B, members 1 and 2.
  EXPECT_FLOAT_EQ(at(m, "probability_difference", 6), 0.4F);
  EXPECT_FLOAT_EQ(static_cast<float>(summary.least), -0.2F);
  EXPECT_FLOAT_EQ(static_cast<float>(summary.most), 0.4F);
  EXPECT_EQ(summary.n_cells, 2U);
}

TEST_F(DifferenceMaps, AreDrawnAsDifferencesAndProbabilities) {
  const LayerStack m = maps(find_pairs(a, b));
  for (const char* end : {"", "_lower", "_upper", "_unpaired_lower"})
    EXPECT_EQ(m.find(std::string("probability_difference") + end)->meaning,
              (LayerMeaning{Quantity::reached, Statistic::difference}));
  EXPECT_EQ(m.find("thickness_exceedance_largest")->meaning,
            (LayerMeaning{Quantity::thickness, Statistic::probability}));
  EXPECT_TRUE(m.find("probability_band_lower")->meaning.is_bound());
}

TEST_F(DifferenceMaps, UntouchedCellsHoldTheIntervalsOfZero) {
  const LayerStack m = maps(find_pairs(a, b));
  EXPECT_EQ(at(m, "probability_difference", 0), 0);
  EXPECT_FLOAT_EQ(at(m, "probability_difference_upper", 0),
                  static_cast<float>(wilson_interval(0, 5).upper));
  EXPECT_EQ(at(m, "probability_largest", 0), 0);
}

TEST_F(DifferenceMaps, WithoutPairsAllMembersCount) {
  const LayerStack m = maps(without_pairs(a, b));
  EXPECT_FLOAT_EQ(at(m, "probability_difference", 5), -0.1F);
  EXPECT_FLOAT_EQ(at(m, "probability_difference_lower", 5),
                  at(m, "probability_difference_unpaired_lower", 5));
  EXPECT_TRUE(std::isnan(summary.median_gain));
}

TEST_F(DifferenceMaps, OfOneEnsembleWithItselfAreZeroAndNarrow) {
  const JoinedMembers twice({&a, &a});
  StackSink sink;
  const DifferenceSummary same = make_difference_maps(twice, find_pairs(a, a), {}, sink);
  EXPECT_EQ(same.least, 0);
  EXPECT_EQ(same.most, 0);
  EXPECT_EQ(same.n_less + same.n_more, 0U);
  EXPECT_GE(same.median_gain, 1);
}

TEST_F(DifferenceMaps, AssetsByHand) {
  Assets assets;
  assets.curves = {{"timber", PeakLayer::thickness, {{0, 0}, {4, 1}}}};
  assets.has_classes = assets.has_values = true;
  assets.value_unit = "CHF";
  Asset house;
  house.name = "house";
  house.curve = 0;
  house.value = 1000;
  house.cells = {5};
  house.on_known_ground = true;
  assets.list = {house};
  const auto rows =
      asset_differences(assets, find_pairs(a, b), find_hits(a, assets), find_hits(b, assets));
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_DOUBLE_EQ(rows[0].probability_a, 0.6);
  EXPECT_DOUBLE_EQ(rows[0].probability_b, 0.5);
  EXPECT_DOUBLE_EQ(rows[0].paired.difference, -0.2);
  EXPECT_DOUBLE_EQ(rows[0].unpaired.difference, -0.2);  // of the same five of each
  // Losses 500, 500, 125, 0, 0 without and 125, 0, 0, 0, 750 with the dam: -375, -500, -125, 0,
  // 750.
  EXPECT_NEAR(rows[0].loss.mean, -50, 1e-9);
  const double squares = 325.0 * 325 + 450 * 450 + 75 * 75 + 50 * 50 + 800 * 800;
  EXPECT_NEAR(rows[0].loss.standard_error, std::sqrt(squares / 4 / 5), 1e-9);
  EXPECT_THAT(to_csv(difference_features(assets, rows, "")),
              HasSubstr("name,place,probability_a,probability_b,difference_paired,"));
}

DesignTable design(std::vector<std::string> keys, std::vector<std::vector<double>> values) {
  DesignTable table;
  table.keys = std::move(keys);
  table.units.assign(table.keys.size(), "1");
  table.values = std::move(values);
  table.seed = 1;
  return table;
}

TEST(MemberPairs, NeedTheSameDraws) {
  const DesignTable a = design({"basal.friction_coefficient"}, {{0.3}, {0.4}});
  EXPECT_EQ(why_no_pairs(a, a), "");
  // A key that only one of them draws, say a dam's height, does not matter.
  const DesignTable dam = design({"terrain.dams[0].height_m", "basal.friction_coefficient"},
                                 {{5, 0.3}, {6, 0.4}, {7, 0.5}});
  EXPECT_EQ(why_no_pairs(a, dam), "");
  const DesignTable other = design({"basal.friction_coefficient"}, {{0.3}, {0.45}});
  EXPECT_EQ(why_no_pairs(a, other), "basal.friction_coefficient of member 1 is 0.4 and 0.45");
  DesignTable seed = a;
  seed.seed = 2;
  EXPECT_EQ(why_no_pairs(a, seed), "ensemble.seed is 1 and 2");
  EXPECT_EQ(why_no_pairs(a, design({"grains.diameter_m"}, {{0.1}, {0.2}})),
            "they share no uncertain value");
}

}  // namespace
}  // namespace sturz::test
