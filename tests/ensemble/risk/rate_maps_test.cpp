// SPDX-License-Identifier: Apache-2.0
// Maps by year of two scenarios, cell by cell by hand.
#include "ensemble/risk/rate_maps.hpp"

#include "ensemble/risk/asset_rates.hpp"
#include "tests/support/memory_members.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace sturz::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

struct Cell {
  std::size_t cell;
  float thickness, speed;
  bool reached = true;
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
    if (c.reached) r.layer(PeakLayer::arrival)[c.cell] = 3;
    r.layer(PeakLayer::thickness)[c.cell] = c.thickness;
    r.layer(PeakLayer::speed)[c.cell] = c.speed;
    r.layer(PeakLayer::pressure)[c.cell] = 1000 * c.thickness;
  }
  return r;
}

/// Once in 100 years: four valid members, and one that failed.
MemoryMembers small_events() {
  MemoryMembers m(small_grid(4, 4));
  m.add(member(0, {{5, 1, 2}, {9, 0.5F, 3}}));
  m.add(member(1, {{5, 2, 0.5F}, {9, 0.5F, 3}, {7, 0.4F, 1, false}}));
  m.add(member(2, {{5, 3, 2}, {9, 0.5F, 3}}));
  MemberResult failed = member(3, {{5, 99, 99}});
  failed.outcome = Outcome::diverged;
  m.add(failed);
  m.add(member(4, {{9, 0.5F, 3}}));
  return m;
}

/// Once in 1000 years: two members.
MemoryMembers large_events() {
  MemoryMembers m(small_grid(4, 4));
  m.add(member(0, {{5, 5, 2}, {6, 0.5F, 1}}));
  m.add(member(1, {{5, 4, 2}}));
  return m;
}

RiskSpec spec() {
  RiskSpec s;
  s.scenarios = {{"small", 0.01}, {"large", 0.001}};
  s.return_periods_years = {30, 100, 300, 2000};
  return s;
}

/// All planes of a layer in one cell.
std::vector<float> at(const LayerStack& maps, const std::string& name, std::size_t cell) {
  const Layer* layer = maps.find(name);
  std::vector<float> values;
  if (layer == nullptr) return values;
  for (std::size_t p = 0; p < layer->n_planes(); ++p)
    values.push_back(layer->values[16 * p + cell]);
  return values;
}

class RateMaps : public ::testing::Test {
 protected:
  LayerStack maps(const RateContext& context = {}) const {
    StackSink sink;
    make_rate_maps(joined, spec(), context, sink);
    return std::move(sink.stack);
  }
  const MemoryMembers small = small_events(), large = large_events();
  const JoinedMembers joined{{&small, &large}};
};

TEST_F(RateMaps, TwoScenariosByHand) {
  const LayerStack m = maps();
  ASSERT_EQ(m.grid.n_cells(), 16U);
  // Three of four members a hundredth, two of two a thousandth.
  EXPECT_FLOAT_EQ(at(m, "annual_rate", 5)[0], 0.0085F);
  EXPECT_FLOAT_EQ(at(m, "annual_rate_standard_error", 5)[0],
                  static_cast<float>(0.01 * std::sqrt(0.046875)));
  EXPECT_FLOAT_EQ(at(m, "annual_rate_of_high_intensity", 5)[0], 0.0035F);
  EXPECT_THAT(at(m, "thickness_return_level", 5), ElementsAre(0, 0, 3, 5));
  EXPECT_THAT(at(m, "pressure_return_level", 5), ElementsAre(0, 0, 3, 5));  // kPa
  EXPECT_EQ(m.find("thickness_return_level")->axis.values,
            (std::vector<double>{30, 100, 300, 2000}));
  EXPECT_EQ(m.find("pressure_return_level")->units, "kPa");
}

TEST_F(RateMaps, NameTheClassesThatTheirNumbersStandFor) {
  const LayerStack m = maps();
  const std::vector<LayerClass>& fields = m.find("matrix_field")->classes;
  ASSERT_EQ(fields.size(), 6U);
  EXPECT_EQ(fields.front(), (LayerClass{4, "medium intensity low probability"}));
  EXPECT_EQ(fields[2], (LayerClass{6, "medium intensity high probability"}));
  EXPECT_EQ(fields[3], (LayerClass{7, "strong intensity low probability"}));
  EXPECT_EQ(fields.back(), (LayerClass{9, "strong intensity high probability"}));
  EXPECT_EQ(m.find("highest_matrix_field")->classes, fields);
  EXPECT_EQ(m.find("intensity_class")->classes.size(), 2U);
  EXPECT_TRUE(m.find("annual_rate")->classes.empty());
}

TEST_F(RateMaps, MatrixClassesOfThreeCellsByHand) {
  const LayerStack m = maps();
  // Strong 0.0035 times a year, so once in 300 years: strong and low, field 7. Rarer than 300 years
  // has no field.
  EXPECT_THAT(at(m, "intensity_class", 5), ElementsAre(0, 0, 3, 3));
  EXPECT_THAT(at(m, "matrix_field", 5), ElementsAre(0, 0, 7, 0));
  EXPECT_EQ(at(m, "highest_matrix_field", 5)[0], 7);
  // All four members, never strong: exactly once in 100 years, medium and medium, field 5.
  EXPECT_THAT(at(m, "intensity_class", 9), ElementsAre(0, 2, 2, 2));
  EXPECT_THAT(at(m, "matrix_field", 9), ElementsAre(0, 5, 4, 0));
  EXPECT_EQ(at(m, "highest_matrix_field", 9)[0], 5);
  // One of two members of the rare one: 0.0005 times a year.
  EXPECT_THAT(at(m, "intensity_class", 6), ElementsAre(0, 0, 0, 2));
  EXPECT_THAT(at(m, "matrix_field", 6), ElementsAre(0, 0, 0, 0));
}

TEST_F(RateMaps, TheSmoothingsTailAndUntouchedCellsAreZero) {
  const LayerStack m = maps();
  for (const std::size_t cell : {7U, 0U}) {
    EXPECT_EQ(at(m, "annual_rate", cell)[0], 0);
    EXPECT_THAT(at(m, "thickness_return_level", cell), ElementsAre(0, 0, 0, 0));
  }
}

TEST_F(RateMaps, WhereNoGroundIsKnownNothingIsSaid) {
  Raster<double> ground(small_grid(4, 4), 100.0);
  ground.values[0] = ground.values[5] = nan_d;
  RateContext context;
  context.ground = &ground;
  const LayerStack m = maps(context);
  EXPECT_TRUE(std::isnan(at(m, "annual_rate", 0)[0]));
  EXPECT_TRUE(std::isnan(at(m, "matrix_field", 0)[2]));
  EXPECT_FLOAT_EQ(at(m, "annual_rate", 5)[0], 0.0085F);  // members came
}

TEST_F(RateMaps, DependOnNoMemory) {
  RateContext little;
  little.memory_bytes = 64;
  const LayerStack a = maps(), b = maps(little);
  for (std::size_t l = 0; l < a.layers.size(); ++l)
    EXPECT_EQ(a.layers[l].values, b.layers[l].values) << a.layers[l].name;
}

TEST(ProbabilityClass, EndsWithItsReturnPeriod) {
  const RiskSpec s;
  EXPECT_EQ(probability_class(s, 10), 3);
  EXPECT_EQ(probability_class(s, 30), 3);
  EXPECT_EQ(probability_class(s, 31), 2);
  EXPECT_EQ(probability_class(s, 300), 1);
  EXPECT_EQ(probability_class(s, 301), 0);
}

TEST_F(RateMaps, AssetsByYearByHand) {
  Assets assets;
  assets.curves = {{"timber", PeakLayer::thickness, {{0, 0}, {4, 1}}}};
  assets.has_classes = assets.has_values = true;
  assets.value_unit = "CHF";
  Asset house;
  house.name = "house";
  house.vulnerability_class = "timber";
  house.curve = 0;
  house.value = 1000;
  house.cells = {5, 6};
  house.on_known_ground = true;
  Asset away = house;
  away.name = "away";
  away.cells.clear();
  assets.list = {house, away};
  std::vector<ScenarioAtAssets> scenarios;
  for (const MemoryMembers* m : {&small, &large}) {
    AssetHits hits = find_hits(*m, assets);
    RiskTable risk = assess_assets(assets, hits);
    scenarios.push_back({std::move(hits), std::move(risk)});
  }
  const RateTable table = assess_rates(assets, spec(), scenarios);
  const AssetRate& r = table.rows[0];
  EXPECT_DOUBLE_EQ(r.rate, 0.0085);
  EXPECT_DOUBLE_EQ(r.most, 0.0085);
  EXPECT_THAT(r.thickness_m, ElementsAre(0, 0, 3, 5));
  // Losses 250, 500, 750, 0 with mean 375; and 1000, 1000.
  EXPECT_NEAR(r.loss.mean, 0.01 * 375 + 0.001 * 1000, 1e-9);
  const double variance = (125.0 * 125 + 125 * 125 + 375 * 375 + 375 * 375) / 3;
  EXPECT_NEAR(r.loss.standard_error, 0.01 * std::sqrt(variance / 4), 1e-9);
  EXPECT_NEAR(table.total_loss.mean, 4.75, 1e-9);
  EXPECT_EQ(table.n_without_loss, 1U);
  EXPECT_EQ(table.rows[1].place, AssetPlace::outside);
  EXPECT_TRUE(std::isnan(table.rows[1].rate));
  const std::string csv = to_csv(rate_features(assets, spec(), table, ""));
  EXPECT_THAT(csv, HasSubstr("name,place,class,value_CHF,rate_per_year,"
                             "rate_standard_error_per_year,rate_most_per_year,"
                             "thickness_30_years_m,thickness_100_years_m,"));
  EXPECT_THAT(csv, HasSubstr("expected_loss_CHF_per_year,expected_loss_standard_error_CHF_per_year,"
                             "cut_off\n"));
}

}  // namespace
}  // namespace sturz::test
