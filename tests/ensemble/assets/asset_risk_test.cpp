// SPDX-License-Identifier: Apache-2.0
// Risk at assets against numbers made by hand: three members, two assets.
#include "ensemble/assets/asset_risk.hpp"

#include "tests/support/memory_members.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace sturz::test {
namespace {

using ::testing::HasSubstr;

/// What a member leaves in one cell, SI.
struct Cell {
  std::size_t cell;
  float arrival, thickness, speed, energy, pressure;
};

MemberResult member(std::int64_t number, const Grid& grid, const std::vector<Cell>& cells,
                    Censoring censoring = Censoring::none) {
  MemberResult r;
  r.member = number;
  r.outcome = Outcome::settled;
  r.censoring = censoring;
  r.grid = grid;
  r.window = whole_of(grid);
  for (int k = 0; k < n_peak_layers; ++k)
    r.layers[k].assign(grid.n_cells(), info(static_cast<PeakLayer>(k)).untouched);
  for (const Cell& c : cells) {
    r.layer(PeakLayer::arrival)[c.cell] = c.arrival;
    r.layer(PeakLayer::thickness)[c.cell] = c.thickness;
    r.layer(PeakLayer::speed)[c.cell] = c.speed;
    r.layer(PeakLayer::energy)[c.cell] = c.energy;
    r.layer(PeakLayer::pressure)[c.cell] = c.pressure;
  }
  return r;
}

Asset asset(const std::string& name, std::vector<std::size_t> cells, std::size_t curve,
            double value) {
  Asset a;
  a.name = name;
  a.vulnerability_class = curve == 0 ? "timber" : "road";
  a.value = value;
  a.curve = curve;
  a.wkb = "geometry";
  a.cells = std::move(cells);
  a.on_known_ground = true;
  return a;
}

Assets two_assets() {
  Assets assets;
  assets.curves = {{"timber", PeakLayer::pressure, {{1000, 0.2}, {3000, 1}}},
                   {"road", PeakLayer::thickness, {{0, 0}, {2, 0.5}}}};
  assets.list = {asset("house", {5, 6}, 0, 1000), asset("bridge", {15}, 1, 500)};
  assets.has_classes = assets.has_values = true;
  assets.value_unit = "CHF";
  return assets;
}

/// Member 4 passes the house, member 7 both and leaves the terrain, member 9 still moves; the cell
/// beside that of member 4 is the smoothing's tail: thick, never reached.
MemoryMembers three_members(bool censored) {
  const Grid grid = small_grid(4, 4);
  MemoryMembers members(grid);
  members.add(member(9, grid, {}, censored ? Censoring::still_moving : Censoring::none));
  members.add(member(4, grid, {{5, 12, 1, 4, 10, 2000}, {6, nan_f, 0.3F, 9, 9, 9000}}));
  members.add(member(7, grid,
                     {{5, 20, 0.5F, 6, 1, 500}, {6, 10, 2, 3, 2, 3500}, {15, 30, 1, 2, 5, 800}},
                     censored ? Censoring::left_terrain : Censoring::none));
  MemberResult failed = member(11, grid, {{5, 1, 99, 99, 99, 99}});
  failed.outcome = Outcome::diverged;
  members.add(failed);
  return members;
}

TEST(AssetRisk, ThreeMembersAndTwoAssetsByHand) {
  const Assets assets = two_assets();
  const RiskTable table = assess_assets(assets, find_hits(three_members(false), assets));
  ASSERT_EQ(table.rows.size(), 2U);
  const AssetRisk& house = table.rows[0];
  EXPECT_EQ(house.valid, 3);
  EXPECT_EQ(house.hit, 2);
  EXPECT_EQ(house.not_known, 0);
  EXPECT_DOUBLE_EQ(house.probability, 2.0 / 3);
  EXPECT_NEAR(house.bounds_95.lower, 0.207660, 1e-6);
  EXPECT_NEAR(house.bounds_95.upper, 0.938508, 1e-6);
  EXPECT_NEAR(house.bounds_90.lower, 0.253533, 1e-6);
  EXPECT_NEAR(house.bounds_90.upper, 0.921735, 1e-6);
  // Largest over both cells of each member: thickness 1 and 2, speed 4 and 6, pressure 2 and 3.5.
  EXPECT_NEAR(house.thickness_m[0], 1.05, 1e-6);
  EXPECT_NEAR(house.thickness_m[1], 1.5, 1e-6);
  EXPECT_NEAR(house.thickness_m[2], 1.95, 1e-6);
  EXPECT_NEAR(house.speed_m_s[1], 5, 1e-6);
  EXPECT_NEAR(house.pressure_kpa[1], 2.75, 1e-6);
  EXPECT_NEAR(house.arrival_s[1], 11, 1e-6);  // of 12 and 10
  // Damage 0.6, 1 and 0: mean 1.6/3, variance 0.76/3.
  EXPECT_NEAR(house.damage.mean, 1.6 / 3, 1e-12);
  EXPECT_NEAR(house.damage.standard_error, std::sqrt(0.76 / 3 / 3), 1e-12);
  EXPECT_NEAR(house.loss.mean, 1600.0 / 3, 1e-9);
  EXPECT_TRUE(house.cut_off.empty());

  const AssetRisk& bridge = table.rows[1];
  EXPECT_EQ(bridge.hit, 1);
  EXPECT_EQ(bridge.thickness_m, (HitQuantiles{1, 1, 1}));
  EXPECT_NEAR(bridge.damage.mean, 0.25 / 3, 1e-12);
  EXPECT_NEAR(bridge.damage.standard_error, 0.25 / 3, 1e-12);
  // Losses by member 600, 1125 and 0.
  EXPECT_NEAR(table.total_loss.mean, 575, 1e-9);
  EXPECT_NEAR(table.total_loss.standard_error, 325, 1e-9);
  EXPECT_EQ(table.n_without_loss, 0U);
}

TEST(AssetRisk, MembersThatWereCutOffLeaveLowerBounds) {
  const Assets assets = two_assets();
  const RiskTable table = assess_assets(assets, find_hits(three_members(true), assets));
  const AssetRisk& house = table.rows[0];
  EXPECT_EQ(house.hit, 2);
  EXPECT_EQ(house.hit_cut_off, 1);
  EXPECT_EQ(house.not_known, 1);  // the one that still moves
  EXPECT_DOUBLE_EQ(house.probability, 2.0 / 3);
  EXPECT_NEAR(house.bounds_95.lower, 0.207660, 1e-6);
  EXPECT_EQ(house.bounds_95.upper, 1);  // as if it had come
  EXPECT_EQ(house.cut_off,
            "1 cut off before they hit: probability, damage, loss at least, quantiles of the "
            "others; 1 cut off after they hit: thickness, speed, pressure, damage, loss at least");
  const AssetRisk& bridge = table.rows[1];
  EXPECT_EQ(bridge.hit_cut_off, 1);
  EXPECT_EQ(bridge.not_known, 1);
  EXPECT_EQ(bridge.bounds_90.upper, wilson_interval(2, 3, z_90).upper);
}

TEST(AssetRisk, NothingIsSaidOfWhatLiesBeyondTheKnownGround) {
  Assets assets = two_assets();
  assets.list[1].cells.clear();
  const RiskTable table = assess_assets(assets, find_hits(three_members(false), assets));
  const AssetRisk& bridge = table.rows[1];
  EXPECT_EQ(bridge.place, AssetPlace::outside);
  EXPECT_EQ(bridge.not_known, 3);
  EXPECT_TRUE(std::isnan(bridge.probability));
  EXPECT_TRUE(std::isnan(bridge.bounds_95.upper));
  EXPECT_TRUE(std::isnan(bridge.damage.mean));
  EXPECT_NEAR(table.total_loss.mean, 1600.0 / 3, 1e-9);
  EXPECT_EQ(table.n_without_loss, 1U);
  const std::string csv = to_csv(risk_features(assets, table, ""));
  EXPECT_THAT(csv, HasSubstr("bridge,outside,road,500,3,0,3,0,,,,,,"));
}

TEST(AssetRisk, AnUntouchedAssetOnKnownGroundHasProbabilityZero) {
  Assets assets = two_assets();
  assets.list[1].cells = {0};
  const AssetRisk r = assess_assets(assets, find_hits(three_members(false), assets)).rows[1];
  EXPECT_EQ(r.place, AssetPlace::inside);
  EXPECT_EQ(r.probability, 0);
  EXPECT_EQ(r.bounds_95.lower, 0);
  EXPECT_GT(r.bounds_95.upper, 0.5);
  EXPECT_TRUE(std::isnan(r.arrival_s[1]));
  EXPECT_EQ(r.damage.mean, 0);
}

TEST(AssetRisk, ColumnsNameTheirUnits) {
  const Assets assets = two_assets();
  const RiskTable table = assess_assets(assets, find_hits(three_members(false), assets));
  const FeatureTable features = risk_features(assets, table, "");
  const std::string csv = to_csv(features);
  EXPECT_EQ(csv.substr(0, csv.find('\n')),
            "name,place,class,value_CHF,valid_members,hit_members,not_known_members,"
            "hit_cut_off_members,probability,probability_lower_90,probability_upper_90,"
            "probability_lower_95,probability_upper_95,thickness_q05_m,thickness_q50_m,"
            "thickness_q95_m,speed_q05_m_s,speed_q50_m_s,speed_q95_m_s,pressure_q05_kpa,"
            "pressure_q50_kpa,pressure_q95_kpa,arrival_q05_s,arrival_q50_s,arrival_q95_s,"
            "expected_damage,expected_damage_standard_error,expected_loss_CHF,"
            "expected_loss_standard_error_CHF,cut_off");
  EXPECT_EQ(features.size(), 2U);
  EXPECT_EQ(features.wkb[0], "geometry");
}

TEST(AssetHits, DependOnNoOrderAndNoWindow) {
  std::mt19937 random(5);
  const Grid grid = small_grid(300, 40);
  std::vector<MemberResult> results;
  for (int k = 0; k < 12; ++k) results.push_back(random_member(k, grid, random));
  MemoryMembers forward(grid), backward(grid);
  for (const MemberResult& r : results) forward.add(r);
  std::for_each(results.rbegin(), results.rend(), [&](const auto& r) { backward.add(r); });
  Assets assets = two_assets();
  assets.list[0].cells = {7, 4000, 5119, 5120, 11999};  // also on both sides of a band's edge
  assets.list[1].cells = {6000, 6001, 6040};
  const AssetHits hits = find_hits(forward, assets), again = find_hits(backward, assets);
  for (std::size_t a = 0; a < 2; ++a) {
    std::vector<AssetHit> plain;
    for (std::size_t m = 0; m < results.size(); ++m) {
      AssetHit hit{m, 0, 0, 0, 0, 0};
      bool reached = false;
      for (const std::size_t cell : assets.list[a].cells) {
        const int row = static_cast<int>(cell / 40), col = static_cast<int>(cell % 40);
        const auto at = [&](PeakLayer p) { return MemoryMembers::value(results[m], p, row, col); };
        if (std::isnan(at(PeakLayer::arrival))) continue;
        hit.arrival_s =
            reached ? std::min(hit.arrival_s, at(PeakLayer::arrival)) : at(PeakLayer::arrival);
        hit.thickness_m = std::max(hit.thickness_m, at(PeakLayer::thickness));
        hit.pressure_pa = std::max(hit.pressure_pa, at(PeakLayer::pressure));
        reached = true;
      }
      if (reached) plain.push_back(hit);
    }
    ASSERT_EQ(hits.of[a].size(), plain.size());
    ASSERT_EQ(again.of[a].size(), plain.size());
    for (std::size_t i = 0; i < plain.size(); ++i)
      for (const AssetHit& hit : {hits.of[a][i], again.of[a][i]}) {
        EXPECT_EQ(hit.member, plain[i].member);
        EXPECT_EQ(hit.arrival_s, plain[i].arrival_s);
        EXPECT_EQ(hit.thickness_m, plain[i].thickness_m);
        EXPECT_EQ(hit.pressure_pa, plain[i].pressure_pa);
      }
  }
}

TEST(AssetHits, WithoutAValidMemberThereIsNoProbability) {
  MemoryMembers none(small_grid(4, 4));
  const Assets assets = two_assets();
  const AssetRisk r = assess_assets(assets, find_hits(none, assets)).rows[0];
  EXPECT_EQ(r.valid, 0);
  EXPECT_TRUE(std::isnan(r.probability));
}

}  // namespace
}  // namespace sturz::test
