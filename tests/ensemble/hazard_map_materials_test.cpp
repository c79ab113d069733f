// SPDX-License-Identifier: Apache-2.0
// Hazard maps of grains and of liquid: where each comes, and what cuts each off.
#include "ensemble/hazard/hazard_map.hpp"
#include "ensemble/hazard/wilson.hpp"
#include "tests/support/memory_members.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace sturz {
namespace {

using test::MemoryMembers;

constexpr int n_members = 6, n_cells = 8;

/// One row of cells: grains of member k come to cell k, liquid two cells farther, where it is
/// alone.
MemberResult member(int k) {
  MemberResult m;
  m.member = k;
  m.outcome = Outcome::settled;
  m.grid = {n_cells, 1, 0, 10, 10, ""};
  m.window = {0, 0, 1, n_cells};
  for (int layer = 0; layer < n_peak_layers; ++layer)
    m.layers[static_cast<std::size_t>(layer)].assign(n_cells,
                                                     info(static_cast<PeakLayer>(layer)).untouched);
  for (int cell = 0; cell <= k + 2 && cell < n_cells; ++cell) {
    const auto put = [&](PeakLayer layer, float v) {
      m.layer(layer)[static_cast<std::size_t>(cell)] = v;
    };
    const bool grains = cell <= k;
    put(PeakLayer::thickness, 2), put(PeakLayer::arrival, static_cast<float>(cell));
    put(PeakLayer::liquid, grains ? 1.0F : 2.0F), put(PeakLayer::liquid_pressure, 4000);
    put(PeakLayer::liquid_arrival, static_cast<float>(cell));
    put(PeakLayer::liquid_fraction, grains ? 0.5F : 1.0F);
    if (!grains) continue;
    put(PeakLayer::solid, 1), put(PeakLayer::solid_pressure, 20000);
    put(PeakLayer::solid_arrival, static_cast<float>(cell + 10));
  }
  MemberScalars& s = m.scalars;
  s.solid_runout_m = 10.0 * k, s.liquid_runout_m = s.runout_m = 10.0 * (k + 2);
  s.solid_lost_fraction = 0, s.liquid_lost_fraction = k + 2 >= n_cells - 1 ? 0.1 : 0;
  if (s.liquid_lost_fraction > 0) m.censoring = Censoring::left_terrain;
  if (m.censoring == Censoring::none) m.layer(PeakLayer::left).clear();
  return m;
}

LayerStack maps(bool dry = false) {
  MemoryMembers source(member(0).grid);
  for (int k = 0; k < n_members; ++k) {
    MemberResult m = member(k);
    if (dry) m.scalars = {};
    source.add(m);
  }
  HazardSpec spec;
  spec.pressure_kpa = {3, 10};
  spec.quantiles = {0.5};
  return make_hazard_map(source, spec, {});
}

float at(const LayerStack& stack, const std::string& name, int cell, std::size_t plane = 0) {
  const Layer* layer = stack.find(name);
  if (layer == nullptr) {
    ADD_FAILURE() << "no layer " << name;
    return nan_f;
  }
  return layer->values[plane * stack.grid.n_cells() + static_cast<std::size_t>(cell)];
}

TEST(HazardMapOfMaterials, TellsWhereEachComesWithItsBounds) {
  const LayerStack m = maps();
  ASSERT_EQ(m.grid.n_cols, n_cells);
  for (int cell = 0; cell < n_cells; ++cell) {
    const int grains = std::clamp(n_members - cell, 0, n_members);
    const int liquid = std::clamp(n_members - (cell - 2), 0, n_members);
    for (const auto& [name, hits] :
         {std::pair<std::string, int>{"probability_of_solid_reach", grains},
          {"probability_of_liquid_reach", liquid},
          {"probability_of_reach", liquid}}) {
      const ProbabilityBounds bounds = wilson_interval(hits, n_members);
      EXPECT_FLOAT_EQ(at(m, name, cell), static_cast<float>(hits) / n_members) << name << cell;
      EXPECT_EQ(at(m, name + "_lower", cell), static_cast<float>(bounds.lower));
      EXPECT_EQ(at(m, name + "_upper", cell), static_cast<float>(bounds.upper));
    }
    EXPECT_FLOAT_EQ(at(m, "solid_pressure_exceedance", cell, 1),
                    static_cast<float>(grains) / n_members);
    EXPECT_EQ(at(m, "liquid_pressure_exceedance", cell, 1), 0);
  }
  EXPECT_EQ(at(m, "solid_arrival_quantile", 3), 13);
  EXPECT_EQ(at(m, "liquid_arrival_quantile", 3), 3);
  EXPECT_TRUE(std::isnan(at(m, "solid_arrival_quantile", 7))) << "grains come there never";
}

TEST(HazardMapOfMaterials, TheShareOfLiquidIsThatOfTheMembersThatCome) {
  const LayerStack m = maps();
  EXPECT_FLOAT_EQ(at(m, "liquid_fraction_quantile", 0), 0.5F);
  EXPECT_FLOAT_EQ(at(m, "liquid_fraction_quantile", 7), 1);
  LayerStack few = maps();
  EXPECT_EQ(few.find("liquid_fraction_quantile")->units, "1");
}

TEST(HazardMapOfMaterials, CutEachOffByWhatLeftOfItAlone) {
  const LayerStack m = maps();
  EXPECT_EQ(m.find("probability_of_reach")->n_censored, 1);
  EXPECT_EQ(m.find("probability_of_liquid_reach")->n_censored, 1);
  EXPECT_EQ(m.find("liquid_pressure_mean")->n_censored, 1);
  EXPECT_EQ(m.find("probability_of_solid_reach")->n_censored, 0);
  EXPECT_EQ(m.find("solid_pressure_mean")->n_censored, 0);
  EXPECT_EQ(m.find("liquid_fraction_quantile")->n_censored, 1) << "the mixture's, by either";
  const auto attribute = [&](const std::string& name) {
    for (const auto& [key, text] : m.attributes)
      if (key == name) return text;
    return std::string("none");
  };
  EXPECT_EQ(attribute("left_terrain_members"), "5");
  EXPECT_EQ(attribute("left_terrain_members_of_grains"), "");
  EXPECT_EQ(attribute("left_terrain_members_of_liquid"), "5");
}

TEST(HazardMapOfMaterials, AreNotThereWhereNoMemberTellsThemApart) {
  const LayerStack m = maps(true);
  for (const Layer& layer : m.layers) {
    EXPECT_EQ(phase_of(layer.meaning.quantity), Phase::both) << layer.name;
    EXPECT_NE(layer.meaning.quantity, Quantity::liquid_fraction);
  }
  for (const auto& [name, text] : m.attributes)
    EXPECT_THAT(name, testing::Not(testing::HasSubstr("liquid")));
}

}  // namespace
}  // namespace sturz
