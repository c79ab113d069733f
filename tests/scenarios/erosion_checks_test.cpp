// SPDX-License-Identifier: Apache-2.0
// What of `erosion` goes together, and what is said of what does not.
#include "scenarios/assembly/erosion/erosion_plan.hpp"
#include "scenarios/assembly/formulation.hpp"
#include "scenarios/catalogue.hpp"
#include "scenarios/checks/validate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace sturz {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Scenario with(const ErosionSpec& e) {
  Scenario s = ramp_slide();
  s.formulation = Formulation::depth_averaged;
  s.erosion = e;
  return s;
}

ErosionSpec good() {
  ErosionSpec e;
  e.growth_rate_per_m = Uncertain(1e-3);
  e.depth_m = Uncertain(2);
  return e;
}

std::vector<std::string> paths(const Scenario& s) {
  std::vector<std::string> out;
  for (const Problem& p : validate(s)) out.push_back(p.path);
  return out;
}

TEST(ErosionChecks, AcceptWhatGoesTogether) {
  EXPECT_THAT(paths(with(good())), IsEmpty());
  ErosionSpec stress;
  stress.law = ErosionLaw::shear_stress;
  stress.supply = ErosionSupply::unlimited;
  EXPECT_THAT(paths(with(stress)), IsEmpty());
  stress.supply = ErosionSupply::limited;
  stress.depth_raster = "bed.tif";
  stress.depth_factor = Uncertain(0.5);
  EXPECT_THAT(paths(with(stress)), IsEmpty());
  ErosionSpec jump;
  jump.law = ErosionLaw::momentum_jump;
  jump.depth_m = Uncertain(1);
  jump.polygon = "channel.gpkg", jump.layer = "bed";
  jump.bed_friction_coefficient = Uncertain(0.7), jump.bed_pore_pressure_ratio = Uncertain(1);
  EXPECT_THAT(paths(with(jump)), IsEmpty());
}

TEST(ErosionChecks, NameWhatIsMissing) {
  EXPECT_THAT(paths(with(ErosionSpec{})),
              ElementsAre("erosion.growth_rate_per_m", "erosion.depth_m"));
  ErosionSpec jump = good();
  jump.growth_rate_per_m.reset();
  jump.law = ErosionLaw::momentum_jump;
  EXPECT_THAT(paths(with(jump)),
              ElementsAre("erosion.bed_friction_coefficient", "erosion.bed_pore_pressure_ratio"));
}

TEST(ErosionChecks, NameWhatContradicts) {
  ErosionSpec e = good();
  e.supply = ErosionSupply::unlimited;
  EXPECT_THAT(paths(with(e)), ElementsAre("erosion.depth_m"));
  e = good(), e.law = ErosionLaw::momentum_jump, e.growth_rate_per_m.reset(), e.depth_m.reset();
  e.bed_friction_coefficient = Uncertain(0.5), e.bed_pore_pressure_ratio = Uncertain(1);
  e.supply = ErosionSupply::unlimited;
  EXPECT_THAT(paths(with(e)), ElementsAre("erosion.supply"))
      << "a slow flow would take all there is";
  e = good(), e.depth_raster = "bed.tif", e.polygon = "bed.gpkg";
  EXPECT_THAT(paths(with(e)), ElementsAre("erosion.depth_raster", "erosion.polygon"));
  e = good(), e.depth_factor = Uncertain(2), e.layer = "bed", e.crs = "EPSG:32633";
  EXPECT_THAT(paths(with(e)), ElementsAre("erosion.depth_factor", "erosion.layer", "erosion.crs"));
  e = good(), e.rate_m_s = Uncertain(0.01), e.bed_pore_pressure_ratio = Uncertain(1);
  const auto problems = validate(with(e));
  ASSERT_EQ(problems.size(), 2u);
  EXPECT_THAT(problems[0].message, HasSubstr("erosion.rate_m_s = 0.01 (erosion.law is "
                                             "exponential; only shear_stress knows it)"));
}

TEST(ErosionChecks, ASaturatedBedBelongsToAMixture) {
  ErosionSpec e = good();
  e.bed_solid_fraction = Uncertain(0.6);
  EXPECT_THAT(paths(with(e)), ElementsAre("erosion.bed_solid_fraction"));
  Scenario wet = with(e);
  wet.mixture.emplace();
  wet.erosion->bed_pore_pressure_ratio = Uncertain(0.8);
  EXPECT_THAT(paths(wet), IsEmpty());
  wet.erosion->bed_density_kg_m3 = Uncertain(1900);
  EXPECT_THAT(paths(wet), ElementsAre("erosion.bed_density_kg_m3"));
}

TEST(ErosionChecks, NumbersHaveRanges) {
  ErosionSpec e = good();
  e.growth_rate_per_m = Uncertain(0), e.depth_m = Uncertain(-1), e.bed_density_kg_m3 = Uncertain(5);
  EXPECT_THAT(paths(with(e)), ElementsAre("erosion.growth_rate_per_m", "erosion.depth_m",
                                          "erosion.bed_density_kg_m3"));
}

TEST(ErosionChecks, BelongToColumns) {
  Scenario s = with(good());
  s.formulation = Formulation::full_stress;
  EXPECT_THAT(paths(s), ElementsAre("erosion"));
  EXPECT_FALSE(has_both_formulations(s));
}

TEST(ErosionPlan, HasTheNumbersOfTheScene) {
  Scenario s = with(good());
  const Grid ground{10, 8, 0, 40, 5, ""};
  SceneInputs in;
  in.whole = ground;
  const ErosionPlace place{ground, 1560, {BasalResistance{}}, {}};
  ErosionSettings plan = plan_erosion(s, in, place);
  EXPECT_EQ(plan.bed_density, 1560) << "the flow's own";
  EXPECT_EQ(plan.source.depth(3, 3), 2);
  s.erosion->supply = ErosionSupply::unlimited;
  s.erosion->bed_density_kg_m3 = Uncertain(1900);
  plan = plan_erosion(s, in, place);
  EXPECT_EQ(plan.bed_density, 1900);
  EXPECT_EQ(plan.source.depth(3, 3), std::numeric_limits<double>::infinity());
  s.erosion->law = ErosionLaw::shear_stress;
  plan = plan_erosion(s, in, place);
  EXPECT_EQ(plan.law.rate, 0.025);
  EXPECT_DOUBLE_EQ(plan.law.depth_per_stress, 1e-4);
  EXPECT_EQ(plan.law.critical_stress, 1000);
}

TEST(ErosionPlan, AveragesTheSupplyOntoTheGroundOfColumns) {
  Scenario s = with(good());
  const Grid fine{12, 8, 0, 40, 5, ""}, coarse{6, 4, 0, 40, 10, ""};
  SceneInputs in;
  in.whole = fine;
  // Cells of rows 3 to 5, columns 4 to 5: one row shares its block with one that has nothing.
  in.bed_supply = std::make_shared<const Raster<double>>(grid_of({3, 4, 3, 2}, fine), 1.0);
  const ErosionSettings plan = plan_erosion(s, in, {coarse, 1560, {BasalResistance{}}, {}});
  EXPECT_EQ(plan.source.depth(1, 2), 1) << "half of the block";
  EXPECT_EQ(plan.source.depth(2, 2), 2);
  EXPECT_EQ(plan.source.depth(1, 1), 0);
  EXPECT_EQ(plan.source.depth(3, 2), 0);
  double volume = 0;
  for (int r = 0; r < 4; ++r)
    for (int c = 0; c < 6; ++c) volume += plan.source.depth(r, c) * 100;
  EXPECT_DOUBLE_EQ(volume, 2 * 6 * 25.0) << "no volume is lost";
}

TEST(ErosionPlan, SaysWhatItTakes) {
  ErosionSpec e = good();
  e.polygon = "channel.gpkg", e.bed_density_kg_m3 = Uncertain(1900);
  EXPECT_EQ(erosion_text(e),
            "`erosion.law: exponential`: volume grows by 0.001 per metre; supply 2 m inside "
            "channel.gpkg; bed of 1900 kg/m3");
}

}  // namespace
}  // namespace sturz
