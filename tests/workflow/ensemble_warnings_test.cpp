// SPDX-License-Identifier: Apache-2.0
// What is said of an ensemble before it is computed: of its ends, its copies, its table, its time.
#include "ensemble/workflow/members/ensemble_warnings.hpp"

#include "engine/core/error.hpp"
#include "ensemble/workflow/cost_warnings.hpp"
#include "ensemble/workflow/folder/saved_design.hpp"
#include "tests/workflow/workflow_fixture.hpp"

namespace sturz::test {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

class EnsembleWarnings : public Workflow {
 protected:
  std::vector<std::string> said(std::vector<std::string> overrides) const {
    const workflow::Scene loaded = workflow::load_scene(scene(std::move(overrides)));
    return workflow::ensemble_warnings(loaded, workflow::new_design(loaded.scenario));
  }
};

TEST_F(EnsembleWarnings, AreNoneForAGoodScene) {
  EXPECT_THAT(said({"basal.pore_pressure_ratio={uniform: [0, 0.3]}"}), IsEmpty());
}

TEST_F(EnsembleWarnings, NothingUncertainIsOneMemberManyTimes) {
  const std::vector<std::string> fixed{"basal.friction_coefficient=0.3",
                                       "basal.pore_pressure_ratio=0"};
  EXPECT_THAT(said(fixed), ElementsAre(HasSubstr("nothing is uncertain: 6 members")));
  std::vector<std::string> one = fixed;
  one.emplace_back("ensemble.members=1");
  EXPECT_THAT(said(one), IsEmpty());
}

TEST_F(EnsembleWarnings, ADistributionWithoutEffectIsNamed) {
  EXPECT_THAT(
      said({"grains.friction_angle_deg={uniform: [25, 35]}", "grains.earth_pressure=isotropic"}),
      ElementsAre("drawn but without effect in depth_averaged: grains.friction_angle_deg"));
}

TEST_F(EnsembleWarnings, WhatHardlyBrakesIsCountedOverTheMembersNotTheMedian) {
  EXPECT_THAT(said({"basal.friction_coefficient={discrete: {values: [0.3, 0]}}"}),
              ElementsAre(AllOf(HasSubstr("hardly anything brakes 3 of 6 members"),
                                HasSubstr("falls to 0, under 0.02"))));
  EXPECT_THAT(said({"basal.friction_coefficient={discrete: {values: [0.3, 0]}}",
                    "basal.turbulent_coefficient_m_s2=500"}),
              IsEmpty());
}

TEST_F(EnsembleWarnings, TheThinnestReleaseDrawnIsLookedAt) {
  const std::vector<std::string> particles{
      "formulation=full_stress",
      "release.thickness_m={discrete: {values: [1, 5], weights: [1, 2]}}"};
  EXPECT_THAT(said(particles), Contains(AllOf(HasSubstr(" of 6 members will fail"),
                                              HasSubstr("has 1 layers of particles"))));
  EXPECT_THAT(said({"formulation=full_stress", "release.thickness_m={uniform: [2.5, 9]}"}),
              Contains(HasSubstr("thin members: ")));
}

TEST_F(EnsembleWarnings, MembersOfTwoFormulationsAreAnnounced) {
  // Walls far away confine the mass: the release alone decides.
  EXPECT_THAT(said({"formulation=auto", "release.thickness_m={discrete: {values: [2, 6]}}",
                    "domain={walls: [{point_m: [-59, 0, 0], normal: [1, 0, 0]}]}"}),
              Contains(HasSubstr("formulation: auto computes members unlike: 3 of 6")));
}

TEST_F(EnsembleWarnings, RowsOfATableThatAreNotUsedAreTold) {
  write("t.csv",
        "basal.friction_coefficient,basal.pore_pressure_ratio\n0.3,0\n0.4,0\n0.5,0.1\n0.6,0\n");
  const std::vector<std::string> table{"ensemble.design=table", "ensemble.table=t.csv"};
  auto two = table, all = table;
  two.emplace_back("ensemble.members=2");
  all.emplace_back("ensemble.members=4");
  EXPECT_THAT(said(two), ElementsAre(HasSubstr("2 of its 4 rows are used")));
  EXPECT_THAT(said(all), IsEmpty());
}

TEST_F(EnsembleWarnings, TableAndTerrainAreWrongTogether) {
  write("t.csv", "basal.friction_coefficient,basal.pore_pressure_ratio\n0.3,0\n2.4,0\n");
  try {
    workflow::load_scene(
        scene({"ensemble.design=table", "ensemble.table=t.csv", "ensemble.members=2",
               "terrain.synthetic=null", "terrain.raster=nowhere.tif"}));
    ADD_FAILURE() << "accepted";
  } catch (const SetupError& e) {
    EXPECT_THAT(e.what(), AllOf(HasSubstr("t.csv"),
                                HasSubstr("row 2, basal.friction_coefficient = 2.4 (must be in "
                                          "0..2). Check the unit"),
                                HasSubstr("nowhere.tif")));
  }
}

TEST_F(EnsembleWarnings, OverTenMinutesTheCheaperChoiceIsNamed) {
  workflow::Scene loaded = workflow::load_scene(scene());
  loaded.description.formulation = "depth_averaged";
  loaded.description.spacing_m = 1;
  loaded.description.narrow_side_m = 100;
  loaded.description.other_formulation_cost = 40;
  loaded.description.predicted_seconds = 599;
  EXPECT_THAT(workflow::cost_warnings(loaded, 1, 1), IsEmpty());
  loaded.description.predicted_seconds = 4800;
  // Twice the spacing is an eighth of the time.
  EXPECT_THAT(workflow::cost_warnings(loaded, 1, 1),
              ElementsAre("this member may take 1 h 20 min, more than ten minutes. Cheaper: "
                          "numerics.spacing_m: 2 (10 min 00 s)."));
  EXPECT_THAT(workflow::cost_warnings(loaded, 8, 2),
              ElementsAre(AllOf(HasSubstr("8 members on 2 cores may take 5 h 20 min"),
                                HasSubstr("numerics.spacing_m: 3.17 "))));
  loaded.description.narrow_side_m = 15;
  EXPECT_THAT(workflow::cost_warnings(loaded, 1, 1),
              ElementsAre(HasSubstr("the coarsest that resolves the release")));
}

TEST_F(EnsembleWarnings, LongMapsAreMadeCheaperByLargerCells) {
  workflow::Scene loaded = workflow::load_scene(scene());  // maps of 2 m cells
  loaded.description.predicted_seconds = 1;
  EXPECT_THAT(workflow::cost_warnings(loaded, 100, 2, 500), IsEmpty());
  // 3 times the cell is a ninth of the time.
  EXPECT_THAT(workflow::cost_warnings(loaded, 100, 2, 5400),
              ElementsAre("100 members on 2 cores and 1 h 30 min of maps may take 1 h 30 min, more "
                          "than ten minutes. Cheaper: hazard.cell_size_m: 6 (10 min 50 s)."));
}

TEST_F(EnsembleWarnings, FullStressIsHeldAgainstColumns) {
  workflow::Scene loaded = workflow::load_scene(scene());
  loaded.description.formulation = "full_stress";
  loaded.description.layers = 4;
  loaded.description.other_formulation_cost = 0.01;
  loaded.description.predicted_seconds = 36000;
  EXPECT_THAT(workflow::cost_warnings(loaded, 1, 1),
              ElementsAre(AllOf(HasSubstr("Cheaper: formulation: depth_averaged (about 6 min"),
                                Not(HasSubstr("spacing")))));
  loaded.description.other_formulation_cost = 0;
  EXPECT_THAT(workflow::cost_warnings(loaded, 1, 1),
              ElementsAre(HasSubstr("Nothing cheaper resolves the release.")));
}

}  // namespace
}  // namespace sturz::test
