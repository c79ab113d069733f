// SPDX-License-Identifier: Apache-2.0
#include "ensemble/sampling/design.hpp"

#include "engine/core/error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace sturz {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Uncertain uniform(double min, double max) {
  Uncertain value;
  value.distribution.emplace();
  value.distribution->kind = Distribution::Kind::uniform;
  value.distribution->min = min;
  value.distribution->max = max;
  return value;
}

Uncertain triangular(double min, double mode, double max) {
  Uncertain value = uniform(min, max);
  value.distribution->kind = Distribution::Kind::triangular;
  value.distribution->mode = mode;
  return value;
}

/// Three uncertain keys, in schema order: solid fraction, basal friction, pore pressure.
Scenario scene(Design design, int members) {
  Scenario s;
  s.grains.emplace();
  s.grains->solid_fraction = triangular(0.5, 0.6, 0.7);
  s.basal.friction_coefficient = uniform(0.15, 0.4);
  s.basal.pore_pressure_ratio = uniform(0, 0.5);
  s.ensemble.design = design;
  s.ensemble.members = members;
  s.ensemble.seed = 20;
  return s;
}

const std::string solid = "grains.solid_fraction", friction = "basal.friction_coefficient",
                  pore = "basal.pore_pressure_ratio";

/// The text of the error that `action` must throw.
template <class Action>
std::string error_of(Action action) {
  try {
    action();
  } catch (const SetupError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Design, HasAColumnPerUncertainKeyAndARowPerMember) {
  const DesignTable table = draw_design(scene(Design::latin_hypercube, 40));
  EXPECT_THAT(table.keys, ElementsAre(solid, friction, pore));
  EXPECT_EQ(table.units.size(), 3U);
  EXPECT_EQ(table.design, Design::latin_hypercube);
  EXPECT_EQ(table.seed, 20U);
  EXPECT_EQ(table.n_members(), 40);
  EXPECT_EQ(table.unit_cube.size(), 40U);
}

TEST(Design, MapsTheUnitCubeThroughTheQuantiles) {
  const DesignTable table = draw_design(scene(Design::sobol, 64));
  for (std::size_t i = 0; i < 64; ++i) {
    EXPECT_DOUBLE_EQ(table.values[i][1], 0.15 + 0.25 * table.unit_cube[i][1]);
    EXPECT_DOUBLE_EQ(table.values[i][2], 0.5 * table.unit_cube[i][2]);
  }
}

TEST(Design, KeepsValuesWithinTheirBounds) {
  for (const Design design : {Design::monte_carlo, Design::latin_hypercube, Design::sobol})
    for (const auto& row : draw_design(scene(design, 500)).values) {
      EXPECT_TRUE(row[0] >= 0.5 && row[0] <= 0.7);
      EXPECT_TRUE(row[1] >= 0.15 && row[1] <= 0.4);
      EXPECT_TRUE(row[2] >= 0 && row[2] <= 0.5);
    }
}

TEST(Design, ExtendsSobolRowsWithTheirCopula) {
  Scenario longer = scene(Design::sobol, 512), shorter = scene(Design::sobol, 256);
  longer.ensemble.correlation = shorter.ensemble.correlation = {{friction + "/" + pore, -0.3}};
  const auto more = draw_design(longer).values, fewer = draw_design(shorter).values;
  EXPECT_TRUE(std::equal(fewer.begin(), fewer.end(), more.begin()));
}

TEST(Design, GivesTheSameBitsForTheSameSeed) {
  for (const Design design : {Design::monte_carlo, Design::latin_hypercube, Design::sobol})
    EXPECT_EQ(draw_design(scene(design, 33)), draw_design(scene(design, 33)));
}

TEST(Design, GivesEmptyRowsToASceneOfNumbers) {
  Scenario fixed;
  fixed.ensemble.members = 3;
  const DesignTable table = draw_design(fixed);
  EXPECT_TRUE(table.keys.empty());
  EXPECT_EQ(table.values, std::vector<std::vector<double>>(3));
  EXPECT_EQ(member_scenario(fixed, table, 2), fixed);
}

TEST(Design, RefusesAnEnsembleWithoutMembers) {
  EXPECT_THAT(error_of([] { draw_design(scene(Design::sobol, 0)); }),
              HasSubstr("ensemble.members = 0"));
}

TEST(MemberScenario, HoldsTheRowAndNoDistribution) {
  const Scenario s = scene(Design::monte_carlo, 5);
  const DesignTable table = draw_design(s);
  const Scenario numbers = member_scenario(s, table, 3);
  EXPECT_TRUE(uncertain_keys(numbers).empty());
  EXPECT_EQ(numbers.grains->solid_fraction.value, table.values[3][0]);
  EXPECT_EQ(numbers.basal.friction_coefficient.value, table.values[3][1]);
  EXPECT_EQ(numbers.basal.pore_pressure_ratio.value, table.values[3][2]);
  EXPECT_THROW(member_scenario(s, table, 5), SetupError);
  EXPECT_THROW(member_scenario(s, table, -1), SetupError);
}

TEST(MedianScenario, PutsMediansInPlaceOfDistributions) {
  const Scenario numbers = median_scenario(scene(Design::sobol, 8));
  EXPECT_TRUE(uncertain_keys(numbers).empty());
  EXPECT_DOUBLE_EQ(numbers.grains->solid_fraction.value, 0.6);
  EXPECT_DOUBLE_EQ(numbers.basal.friction_coefficient.value, 0.275);
  EXPECT_DOUBLE_EQ(numbers.basal.pore_pressure_ratio.value, 0.25);
}

TEST(TableDesign, SortsTheUsersColumnsIntoSchemaOrder) {
  const std::vector<std::string> columns{pore, solid, friction};
  const DesignTable table =
      table_design(scene(Design::table, 0), columns, {{0.1, 0.55, 0.2}, {0.5, 0.7, 0.15}});
  EXPECT_THAT(table.keys, ElementsAre(solid, friction, pore));
  EXPECT_THAT(table.values, ElementsAre(ElementsAre(0.55, 0.2, 0.1), ElementsAre(0.7, 0.15, 0.5)));
  EXPECT_TRUE(table.unit_cube.empty());
  EXPECT_EQ(table.design, Design::table);
}

TEST(TableDesign, TakesAsManyRowsAsMembersAreAsked) {
  const std::vector<std::string> columns{solid, friction, pore};
  const std::vector<std::vector<double>> rows(4, {0.6, 0.3, 0.2});
  EXPECT_EQ(table_design(scene(Design::table, 3), columns, rows).n_members(), 3);
  EXPECT_THAT(error_of([&] { table_design(scene(Design::table, 5), columns, rows); }),
              HasSubstr("ensemble.members = 5 but ensemble.table has 4 rows"));
}

TEST(TableDesign, NamesWhatIsWrong) {
  const auto error = [](std::vector<std::string> columns, std::vector<double> row) {
    return error_of([&] { table_design(scene(Design::table, 0), columns, {row}); });
  };
  EXPECT_THAT(error({solid, friction}, {0.6, 0.3}), HasSubstr("no column '" + pore + "'"));
  EXPECT_THAT(error({solid, friction, pore, "basal.cohesion_pa"}, {0.6, 0.3, 0.1, 0}),
              HasSubstr("'basal.cohesion_pa' is not an uncertain key"));
  EXPECT_THAT(error({solid, friction, pore, pore}, {0.6, 0.3, 0.1, 0.1}),
              HasSubstr("stands twice"));
  EXPECT_THAT(error({solid, friction, pore}, {0.6, 0.3}), HasSubstr("row 1 has 2 values for 3"));
  EXPECT_THAT(error({solid, friction, pore}, {0.6, 0.45, 0.1}),
              HasSubstr("row 1, basal.friction_coefficient = 0.45 (outside 0.15 .. 0.4"));
  EXPECT_THAT(error({solid, friction, pore}, {60, 0.3, 0.1}),
              HasSubstr("row 1, grains.solid_fraction = 60 (must be in"));
  EXPECT_THAT(error({solid, friction, pore}, {NAN, 0.3, 0.1}), HasSubstr("not a finite number"));
  EXPECT_THAT(
      error_of([] {
        table_design(scene(Design::table, 0), std::vector<std::string>{solid, friction, pore}, {});
      }),
      HasSubstr("no rows"));
}

/// A posterior of friction says nothing of the thickness.
TEST(PosteriorTable, KeysWithoutAColumnAreDrawnFromTheirPrior) {
  Scenario scenario;
  scenario.ensemble.seed = 7;
  scenario.basal.friction_coefficient = uniform(0.1, 0.5);
  scenario.release.thickness_m = uniform(1, 3);
  DesignTable posterior;
  posterior.keys = {"basal.friction_coefficient"};
  posterior.units = {"1"};
  posterior.is_posterior = true;
  for (int i = 0; i < 500; ++i) posterior.values.push_back({0.2 + 0.0002 * ((i * 309) % 500)});
  EXPECT_EQ(from_csv(to_csv(posterior)), posterior);
  EXPECT_EQ(keys_without_column(scenario, posterior),
            (std::vector<std::string>{"release.thickness_m"}));
  const DesignTable whole = with_prior_columns(scenario, posterior);
  ASSERT_EQ(whole.keys.size(), 2U);
  double mean = 0, square = 0, product = 0;
  for (const auto& row : whole.values) {
    EXPECT_TRUE(row[1] > 1 && row[1] < 3);
    const double x = (row[0] - 0.25) / 0.1, y = (row[1] - 2) / 2;
    mean += y / 500, square += y * y / 500, product += x * y / 500;
  }
  EXPECT_NEAR(mean, 0, 0.01);
  EXPECT_NEAR(square, 1.0 / 12, 0.005);
  EXPECT_NEAR(product, 0, 0.01);  // of 1/12, were they one
  posterior.values.resize(100);
  const DesignTable part = with_prior_columns(scenario, posterior);
  EXPECT_TRUE(std::equal(part.values.begin(), part.values.end(), whole.values.begin()));
  const DesignTable used = table_design(scenario, whole.keys, whole.values);
  EXPECT_EQ(used.keys.size(), 2U);
  EXPECT_FALSE(used.is_posterior);
}

TEST(APosteriorOfAnotherScene, IsRefusedInItsOwnWords) {
  Scenario scenario;
  scenario.basal.friction_coefficient = uniform(0.1, 0.3);
  DesignTable posterior;
  posterior.keys = {"basal.friction_coefficient"};
  posterior.units = {"1"};
  posterior.is_posterior = true;
  posterior.values = {{0.2}, {0.35}};
  const auto words = [&] {
    try {
      with_prior_columns(scenario, posterior);
    } catch (const SetupError& problem) {
      return std::string(problem.what());
    }
    return std::string("it is taken");
  };
  EXPECT_THAT(words(), AllOf(HasSubstr("ends at 0.1 and 0.3"), HasSubstr("0.2 .. 0.35"),
                             Not(HasSubstr("ensemble.table"))));
  posterior.values = {{0.2}, {0.3}};
  EXPECT_EQ(words(), "it is taken");
  scenario.basal.friction_coefficient = 0.25;
  EXPECT_THAT(words(), AllOf(HasSubstr("basal.friction_coefficient is one number in this scene"),
                             HasSubstr("0.2 .. 0.3")));
}

}  // namespace
}  // namespace sturz
