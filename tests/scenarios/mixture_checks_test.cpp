// SPDX-License-Identifier: Apache-2.0
// What goes with a mixture and what does not; what a scene makes of it.
#include "scenarios/assembly/formulation.hpp"
#include "scenarios/assembly/ground_words.hpp"
#include "scenarios/assembly/scene_plan.hpp"
#include "scenarios/catalogue.hpp"
#include "scenarios/checks/idle_keys.hpp"
#include "scenarios/checks/validate.hpp"
#include "scenarios/schema/schema.hpp"
#include "tests/support/formula_ground.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <utility>

namespace sturz {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

std::vector<std::string> messages(const Scenario& s) {
  std::vector<std::string> texts;
  for (const auto& problem : validate(s)) texts.push_back(problem.message);
  return texts;
}

TEST(MixtureChecks, AFixedPorePressureIsRefusedWithTheReason) {
  Scenario s = wet_ramp();
  EXPECT_THAT(messages(s), IsEmpty());
  s.basal.pore_pressure_ratio = 0.3;
  EXPECT_THAT(messages(s), Contains(HasSubstr("mixture is there too, which computes the pore")));
  s = wet_ramp();
  s.basal.zones.push_back({"zone.shp", "", std::nullopt, 0.5, std::nullopt});
  EXPECT_THAT(messages(s), Contains(HasSubstr("pore_pressure_ratio of a zone")));
}

TEST(MixtureChecks, OnlyColumnsKnowIt) {
  Scenario s = wet_ramp();
  s.formulation = Formulation::full_stress;
  EXPECT_THAT(messages(s), Contains(HasSubstr("mixture (formulation is full_stress; only")));
  s.formulation = Formulation::automatic;
  EXPECT_THAT(messages(s), IsEmpty());
  const Raster<double> thick{Grid{40, 40, 0, 40, 1, ""}, 30.0};
  const FormulationChoice choice = choose_formulation(s, thick);
  EXPECT_TRUE(choice.depth_averaged) << "although so many layers would resolve it";
  EXPECT_THAT(choice.reason, HasSubstr("`mixture` acts on columns"));
}

TEST(MixtureChecks, SaysEverythingThatIsWrongAtOnce) {
  Scenario s = wet_ramp();
  s.basal.viscosity_pa_s = Uncertain(100);
  s.basal.yield_stress_pa = Uncertain(100);
  s.grains->earth_pressure = LateralPressure::active;
  s.material = "debris_flow";
  s.mixture->initial_pressure = InitialPressure::liquefied;
  s.mixture->initial_pressure_ratio = Uncertain(0.7);
  s.mixture->fluid_density_kg_m3 = Uncertain(2000);
  s.grains->density_kg_m3 = Uncertain(1900);
  const auto all = messages(s);
  for (const char* text :
       {"material = debris_flow (mixture is there too", "Use mixture.fluid_viscosity_pa_s",
        "held by its grains", "it knows isotropic only", "which is a ratio of 1",
        "must be below grains.density_kg_m3 = 1900"})
    EXPECT_THAT(all, Contains(HasSubstr(text)));
}

TEST(MixtureChecks, AParabolaHasNoNodesAndDrainsAtTheSurface) {
  Scenario s = wet_ramp();
  s.mixture->pressure_nodes = 7;
  s.mixture->drainage = Drainage::both;
  EXPECT_THAT(messages(s),
              Contains(HasSubstr("mixture.pressure_nodes = 7 (mixture.pressure_profile "
                                 "is parabola")));
  EXPECT_THAT(messages(s),
              Contains(HasSubstr("mixture.drainage = both (mixture.pressure_profile")));
  s.mixture->pressure_profile = PressureProfile::resolved;
  EXPECT_THAT(messages(s), IsEmpty());
  for (const int nodes : {4, 11}) {
    s.mixture->pressure_nodes = nodes;
    EXPECT_THAT(messages(s), Contains(HasSubstr("mixture.pressure_nodes")));
  }
}

TEST(MixtureChecks, AThickMassWithAParabolaIsToldOfTheOtherChoice) {
  SceneInputs in;
  in.elevation = std::make_shared<const Raster<double>>(
      test::raster_of([](double x, double) { return -0.3 * x; }, Grid{60, 60, 0, 60, 1, ""}));
  const auto warned = [&](double thickness, PressureProfile profile) {
    Scenario s;
    s.formulation = Formulation::depth_averaged;
    s.grains.emplace();
    s.basal.friction_coefficient = 0.7;
    s.numerics.spacing_m = 2;
    s.mixture.emplace().pressure_profile = profile;
    Raster<double> slab(in.elevation->grid);
    for (int r = 10; r < 50; ++r)
      for (int c = 10; c < 50; ++c) slab.at(r, c) = thickness;
    SceneInputs with = in;
    with.release = std::make_shared<const Raster<double>>(std::move(slab));
    with.pattern = ReleasePattern::thickness;
    const ScenePlan plan = plan_scene(s, with, 0);
    for (const std::string& text : plan_warnings(s, plan))
      if (text.find("drains too fast") != std::string::npos) {
        EXPECT_THAT(text, HasSubstr("22 %"));
        EXPECT_THAT(text, HasSubstr("mixture.pressure_profile: resolved"));
        return true;
      }
    return false;
  };
  EXPECT_TRUE(warned(8, PressureProfile::parabola));
  EXPECT_FALSE(warned(3, PressureProfile::parabola));
  EXPECT_FALSE(warned(8, PressureProfile::resolved));
}

TEST(MixtureChecks, APileHasNoFrictionInsideWhereWaterCarriesPartOfIt) {
  Scenario s;
  s.formulation = Formulation::depth_averaged;
  s.grains.emplace().friction_angle_deg = Uncertain(35);
  s.basal.friction_coefficient = 0.3;
  s.numerics.spacing_m = 2;
  SceneInputs in;
  in.elevation = std::make_shared<const Raster<double>>(
      test::raster_of([](double x, double) { return -0.1 * x; }, Grid{60, 60, 0, 60, 1, ""}));
  Raster<double> pile(in.elevation->grid);
  for (int r = 20; r < 40; ++r)
    for (int c = 20; c < 40; ++c) pile.at(r, c) = 10;
  in.release = std::make_shared<const Raster<double>>(std::move(pile));
  in.pattern = ReleasePattern::thickness;
  const ScenePlan dry = plan_scene(s, in, 0);
  ASSERT_TRUE(knows_internal_friction(dry.columns)) << "the same pile of dry grains";
  s.mixture.emplace();
  const ScenePlan wet = plan_scene(s, in, 0);
  EXPECT_FALSE(knows_internal_friction(wet.columns));
  EXPECT_TRUE(wet.columns.spent_inside.empty());
  EXPECT_NEAR(wet.bulk_density_kg_m3, dry.bulk_density_kg_m3 + 0.4 * 1000, 1e-9);
  const auto said = plan_warnings(s, wet);
  EXPECT_THAT(said, Contains(HasSubstr("A mixture knows no friction inside")));
  EXPECT_THAT(said, Each(Not(HasSubstr("; ")))) << "members part their warnings there";
}

TEST(MixtureChecks, TheEnergyLineSaysThatItIsThatOfALiquefiedMass) {
  SceneInputs in;
  in.elevation = std::make_shared<const Raster<double>>(
      test::raster_of([](double x, double) { return -0.1 * x; }, Grid{60, 60, 0, 60, 1, ""}));
  in.reach.emplace().friction = 0.07;
  in.reach->above_end_m = 12, in.reach->end = "east";
  for (const bool wet : {true, false}) {
    const Scenario s = wet ? wet_ramp() : ramp_slide();
    const std::string line = wet ? "energy line of a nearly liquefied mixture (friction 0.07)"
                                 : "energy line of the least friction drawn (0.07)";
    EXPECT_THAT(ground_line(s, in), HasSubstr(line));
    EXPECT_THAT(ground_warnings(s, in), Contains(HasSubstr(line + " still stands 12 m")));
  }
}

TEST(MixtureChecks, EveryNumberMayBeUncertain) {
  int n = 0;
  for (const KeyInfo& key : schema())
    if (key.path.starts_with("mixture.")) {
      n += key.kind == ValueKind::uncertain;
      Scenario s;
      if (key.kind == ValueKind::uncertain) key.set(s, Uncertain(0.5));
      EXPECT_EQ(s.mixture.has_value(), key.kind == ValueKind::uncertain) << key.path;
    }
  EXPECT_EQ(n, 10);
}

TEST(MixtureChecks, ALooseMixtureIsTakenAsNearlyLiquefied) {
  const Scenario loose = wet_ramp(0.6), dense = wet_ramp(0.67);
  EXPECT_NEAR(typical_friction(loose), liquefied_share * loose.basal.friction_coefficient.value,
              1e-15);
  EXPECT_GT(typical_friction(dense), 3 * typical_friction(loose));
}

Scenario two_phases() {
  Scenario s = wet_ramp(0.6);
  s.mixture->phases = MixturePhases::two;
  return s;
}

TEST(TwoPhaseChecks, RefuseWhatTwoVelocitiesDoNotKnow) {
  EXPECT_THAT(messages(two_phases()), IsEmpty());
  Scenario s = two_phases();
  s.mixture->initial_pressure = InitialPressure::liquefied;
  s.basal.pore_pressure_ratio = 0.3;
  s.mixture->pressure_profile = PressureProfile::resolved;
  s.erosion.emplace();
  s.inflow.emplace_back();
  s.release.start_time_s = Uncertain(5);
  s.basal.rasters.friction_coefficient.path = "friction.tif";
  const auto all = messages(s);
  const char* const no_pressure = "carries the grains' buoyancy and no excess pressure";
  EXPECT_THAT(all, Contains(AllOf(StartsWith("mixture.initial_pressure"), HasSubstr(no_pressure))));
  EXPECT_THAT(all, Contains(AllOf(StartsWith("mixture.pressure_profile"), HasSubstr(no_pressure))));
  EXPECT_THAT(all, Contains(HasSubstr("basal.pore_pressure_ratio")));
  for (const char* path : {"erosion", "inflow", "release.start_time_s", "basal.rasters"})
    EXPECT_THAT(all, Contains(AllOf(StartsWith(path), HasSubstr("two sets of columns")))) << path;
  s = two_phases();
  s.mixture->initial_pressure_ratio = Uncertain(0.7);
  EXPECT_THAT(messages(s), Contains(HasSubstr("mixture.initial_pressure_ratio")));
}

TEST(TwoPhaseChecks, DragKeysNeedTheirLaw) {
  Scenario s = two_phases();
  s.mixture->settling_speed_m_s = Uncertain(1);
  EXPECT_THAT(messages(s), Contains(HasSubstr("mixture.drag_law is permeability")));
  s.mixture->drag_law = PhaseDragLaw::settling;
  EXPECT_THAT(messages(s), IsEmpty());
  s.mixture->phases = MixturePhases::one;
  EXPECT_THAT(messages(s), Contains(HasSubstr("mixture.phases is one")));
}

TEST(TwoPhaseChecks, SettlingUsesTheDiameterAndLeavesPermeabilityIdle) {
  Scenario s = two_phases();
  s.grains->diameter_m = Uncertain(0.3);
  s.mixture->compressibility = Uncertain(0.1);
  s.mixture->permeability_m2 = Uncertain(1e-8);
  EXPECT_THAT(idle_keys(s, true),
              testing::IsSupersetOf({"grains.diameter_m", "mixture.compressibility"}));
  EXPECT_THAT(idle_keys(s, true), testing::Not(Contains("mixture.permeability_m2")));
  s.mixture->drag_law = PhaseDragLaw::settling;
  EXPECT_THAT(idle_keys(s, true), Contains("mixture.permeability_m2"));
  EXPECT_THAT(idle_keys(s, true), testing::Not(Contains("grains.diameter_m")));
}

}  // namespace
}  // namespace sturz
