// SPDX-License-Identifier: Apache-2.0
/// Blocks fluid and coupling: what they ask for and refuse, what a scene makes of them.
#include "engine/core/error.hpp"
#include "engine/effects/fields.hpp"
#include "engine/simulation/parts.hpp"
#include "scenarios/assembly/assemble.hpp"
#include "scenarios/assembly/formulation.hpp"
#include "scenarios/assembly/ground_words.hpp"
#include "scenarios/assembly/liquid/liquid_plan.hpp"
#include "scenarios/assembly/scene_plan.hpp"
#include "scenarios/checks/idle_keys.hpp"
#include "scenarios/checks/validate.hpp"
#include "scenarios/schema/schema.hpp"
#include "tests/support/formula_ground.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace sturz {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// 40 m x 40 m x 10 m of mud on a slope, five layers.
Scenario mud() {
  Scenario s;
  s.terrain.synthetic = SyntheticTerrain{"plane", 2, {}};
  s.release.box = ReleaseBox{{30, 70}, {30, 70}};
  s.release.thickness_m = Uncertain(10);
  s.fluid.emplace();
  s.fluid->density_kg_m3 = Uncertain(1600);
  s.fluid->viscosity_pa_s = Uncertain(50);
  s.fluid->yield_stress_pa = Uncertain(500);
  s.numerics.spacing_m = 2;
  return s;
}

/// The same place full of grains in water.
Scenario slide() {
  Scenario s = mud();
  s.fluid = FluidSpec{};
  s.fluid->viscosity_pa_s = Uncertain(0.01);
  s.grains.emplace();
  s.grains->density_kg_m3 = Uncertain(2500);
  s.grains->diameter_m = Uncertain(0.5);
  s.grains->solid_fraction = Uncertain(0.55);
  s.grains->friction_angle_deg = Uncertain(30);
  return s;
}

SceneInputs inputs() {
  SceneInputs in;
  const Grid grid{100, 50, 0, 100, 2, ""};
  in.elevation = std::make_shared<const Raster<double>>(
      test::raster_of([](double x, double y) { return 300 - 0.6 * x + 0.1 * y; }, grid));
  Raster<double> pattern(grid, 0.0);
  for (int r = 0; r < grid.n_rows; ++r)
    for (int c = 0; c < grid.n_cols; ++c) {
      const double x = grid.x_center(c), y = grid.y_center(r);
      if (x > 30 && x < 70 && y > 30 && y < 70) pattern.at(r, c) = 1;
    }
  in.release = std::make_shared<const Raster<double>>(pattern);
  in.hazard_grid = grid;
  return in;
}

constexpr double volume = 40 * 40 * 10;

std::vector<std::string> messages(const Scenario& s) {
  std::vector<std::string> texts;
  for (const auto& problem : validate(s)) texts.push_back(problem.message);
  return texts;
}

template <class Change>
std::vector<std::string> messages_of(Scenario s, Change change) {
  change(s);
  return messages(s);
}

double total(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return sum;
}

EffectNote note(const SceneDescription& d, std::string_view name) {
  const auto row = std::find_if(d.effects.begin(), d.effects.end(),
                                [&](const EffectNote& e) { return e.name == name; });
  return row == d.effects.end() ? EffectNote{} : *row;
}

std::vector<std::string> warnings_of(const Scenario& s) {
  return plan_warnings(s, plan_scene(s, inputs(), 0));
}

TEST(Fluid, AloneOrInTheirPoresItIsAScene) {
  EXPECT_THAT(messages(mud()), IsEmpty());
  EXPECT_THAT(messages(slide()), IsEmpty());
  for (Scenario s : {mud(), slide()}) {
    s.formulation = Formulation::full_stress;
    EXPECT_THAT(messages(s), IsEmpty());
  }
}

TEST(Fluid, ItsLawFollowsFromWhatIsGiven) {
  EXPECT_FALSE(liquid_law(*mud().fluid).newtonian());
  EXPECT_EQ(liquid_law(*mud().fluid).stress(2), 500 + 100);
  EXPECT_TRUE(liquid_law(*slide().fluid).newtonian());
  Scenario s = mud();
  s.fluid->viscosity_pa_s.reset();
  s.fluid->consistency_pa_sn = Uncertain(30);
  s.fluid->index = Uncertain(0.5);
  EXPECT_THAT(messages(s), IsEmpty());
  EXPECT_EQ(liquid_law(*s.fluid).stress(4), 500 + 60);
}

TEST(Fluid, AnIncompleteLawIsToldWhatItLacks) {
  EXPECT_THAT(messages_of(mud(), [](Scenario& s) { s.fluid->viscosity_pa_s.reset(); }),
              ElementsAre(HasSubstr("fluid.viscosity_pa_s (missing: nothing says")));
  EXPECT_THAT(messages_of(mud(),
                          [](Scenario& s) {
                            s.fluid->viscosity_pa_s.reset();
                            s.fluid->consistency_pa_sn = Uncertain(30);
                          }),
              ElementsAre(HasSubstr("fluid.index (missing; fluid.consistency_pa_sn needs it)")));
  EXPECT_THAT(messages_of(mud(), [](Scenario& s) { s.fluid->index = Uncertain(0.5); }),
              ElementsAre(HasSubstr("fluid.index = 0.5 (fluid.consistency_pa_sn is missing)")));
  EXPECT_THAT(messages_of(mud(),
                          [](Scenario& s) {
                            s.fluid->consistency_pa_sn = Uncertain(30);
                            s.fluid->index = Uncertain(0.5);
                          }),
              ElementsAre(HasSubstr("fluid.consistency_pa_sn = 30 (fluid.viscosity_pa_s is there "
                                    "too). Keep one of them.")));
  EXPECT_THAT(messages_of(mud(), [](Scenario& s) { s.fluid->index = Uncertain(1.5); }),
              Contains(HasSubstr("fluid.index = 1.5 (must be in 0.1..1)")));
}

TEST(Fluid, ColumnsAreRefusedOnceAndToldWhatToUse) {
  const auto as_columns = [](Scenario& s) { s.formulation = Formulation::depth_averaged; };
  EXPECT_THAT(messages_of(mud(), as_columns),
              ElementsAre(AllOf(HasSubstr("fluid (formulation is depth_averaged; only full_stress"),
                                HasSubstr("basal.viscosity_pa_s and basal.yield_stress_pa"))));
  EXPECT_THAT(messages_of(slide(), as_columns),
              ElementsAre(HasSubstr("or use mixture with phases: two")));
  EXPECT_THAT(messages_of(slide(), [](Scenario& s) { s.formulation = Formulation::discrete; }),
              Contains(HasSubstr("fluid (formulation is discrete")));
}

TEST(Fluid, WhatOnlyColumnsKnowIsRefusedBesideIt) {
  const auto refused = [](auto change, const char* path) {
    EXPECT_THAT(messages_of(slide(), change),
                Contains(HasSubstr(std::string(path) + " (fluid is there too")))
        << path;
  };
  refused([](Scenario& s) { s.mixture.emplace(); }, "mixture");
  refused([](Scenario& s) { s.basal.viscosity_pa_s = Uncertain(1); }, "basal.viscosity_pa_s");
  refused([](Scenario& s) { s.basal.turbulent_coefficient_m_s2 = Uncertain(500); },
          "basal.turbulent_coefficient_m_s2");
  refused([](Scenario& s) { s.basal.samosat.emplace(); }, "basal.samosat");
  refused([](Scenario& s) { s.erosion.emplace(); }, "erosion");
  refused([](Scenario& s) { s.inflow.emplace_back(); }, "inflow");
  refused([](Scenario& s) { s.release.start_time_s = Uncertain(1); }, "release.start_time_s");
  refused([](Scenario& s) { s.grains->earth_pressure = LateralPressure::active; },
          "grains.earth_pressure");
  EXPECT_THAT(messages_of(slide(), [](Scenario& s) { s.material = "debris_flow"; }),
              ElementsAre(HasSubstr("material = debris_flow (fluid is there too")));
}

TEST(Fluid, GrainsInItNeedFrictionAndMustBeHeavier) {
  EXPECT_THAT(messages_of(slide(), [](Scenario& s) { s.grains->friction_angle_deg.reset(); }),
              ElementsAre(HasSubstr("grains (no internal friction, which full_stress needs)")));
  EXPECT_THAT(messages_of(slide(), [](Scenario& s) { s.grains->density_kg_m3 = Uncertain(900); }),
              ElementsAre(HasSubstr("must be below grains.density_kg_m3 = 900")));
  EXPECT_THAT(messages_of(slide(), [](Scenario& s) { s.grains->pore_pressure_inside = true; }),
              ElementsAre(HasSubstr("grains.pore_pressure_inside = true (fluid is there too")));
  EXPECT_THAT(messages_of(mud(), [](Scenario& s) { s.fluid->saturation = Uncertain(0.6); }),
              ElementsAre(HasSubstr("fluid.saturation = 0.6 (there are no grains")));
  EXPECT_THAT(messages_of(slide(), [](Scenario& s) { s.fluid->saturation = Uncertain(1.4); }),
              ElementsAre(HasSubstr("fluid.saturation = 1.4 (must be in 0.05..1)")));
}

TEST(Fluid, CouplingNeedsBoth) {
  EXPECT_THAT(messages_of(mud(), [](Scenario& s) { s.coupling.emplace(); }),
              ElementsAre(HasSubstr("coupling (grains missing")));
  EXPECT_THAT(messages_of(slide(),
                          [](Scenario& s) {
                            s.coupling.emplace();
                            s.fluid.reset();
                          }),
              ElementsAre(HasSubstr("coupling (fluid missing")));
}

TEST(Fluid, ByItselfItDoesNotKnowTheBedsFriction) {
  Scenario s = mud();
  s.basal.friction_coefficient = 0.3;
  s.basal.pore_pressure_ratio = 0.2;
  s.numerics.artificial_viscosity = 0.3;
  EXPECT_THAT(idle_keys(s, false),
              ElementsAre("basal.friction_coefficient", "basal.pore_pressure_ratio",
                          "numerics.artificial_viscosity"));
}

TEST(Fluid, TheGrainsDiameterActsInTheirDrag) {
  Scenario s = slide();
  EXPECT_THAT(idle_keys(s, false), IsEmpty());
  s.coupling.emplace().drag_diameter_m = Uncertain(0.002);
  EXPECT_THAT(idle_keys(s, false), ElementsAre("grains.diameter_m"));
}

TEST(Fluid, AutoTakesParticlesHoweverThinTheFlow) {
  const Raster<double> thin(Grid{20, 20, 0, 40, 2, ""}, 5.0);
  const FormulationChoice choice = choose_formulation(mud(), thin);
  EXPECT_FALSE(choice.depth_averaged);
  EXPECT_THAT(choice.reason, HasSubstr("`fluid` is a liquid in three dimensions; 2.5 layers"));
  const Raster<double> film(Grid{20, 20, 0, 40, 2, ""}, 3.0);
  EXPECT_THROW(choose_formulation(mud(), film), SetupError);
  Scenario accepted = mud();
  accepted.numerics.accept_unresolved = true;
  EXPECT_FALSE(choose_formulation(accepted, film).depth_averaged);
}

TEST(Fluid, AloneIsOneSetOfThatNameAndAllOfTheVolume) {
  Simulation run = assemble(mud(), inputs(), 0, 1);
  const State& state = run.parts().state;
  ASSERT_EQ(state.sets.size(), 1u);
  const MovingSet& liquid = state.sets[0];
  EXPECT_EQ(liquid.name, "liquid");
  EXPECT_NEAR(total(liquid.mass), 1600 * volume, 1e-9 * 1600 * volume);
  EXPECT_EQ(liquid.ledger.released_mass, total(liquid.mass));
  EXPECT_FALSE(liquid.has(fields::grain_share));
  EXPECT_FALSE(run.parts().peaks.settings().by_set);
}

TEST(Fluid, GrainsAndLiquidShareTheBulkVolumeExactly) {
  for (const double saturation : {1.0, 0.6}) {
    Scenario s = slide();
    s.fluid->saturation = Uncertain(saturation);
    Simulation run = assemble(s, inputs(), 0, 1);
    const State& state = run.parts().state;
    ASSERT_EQ(state.sets.size(), 2u);
    const MovingSet &grains = state.sets[0], &liquid = state.sets[1];
    EXPECT_EQ(grains.name, "grains");
    EXPECT_EQ(liquid.name, "liquid");
    const double solid = 0.55 * 2500 * volume, fluid = saturation * 0.45 * 1000 * volume;
    EXPECT_NEAR(total(grains.mass), solid, 1e-11 * solid);
    EXPECT_NEAR(total(liquid.mass), fluid, 1e-11 * fluid);
    EXPECT_EQ(liquid.x, grains.x);
    EXPECT_EQ(liquid.y, grains.y);
    EXPECT_EQ(liquid.z, grains.z);
    EXPECT_EQ(liquid.id, grains.id) << "each set counts its own";
    EXPECT_TRUE(liquid.has(fields::grain_share));
    EXPECT_FALSE(grains.has(fields::grain_share));
    EXPECT_TRUE(run.parts().peaks.settings().by_set);
    // On a map each has the volume of its own matter.
    const auto on_map = [](const MovingSet& p) {
      return total(p.mass) * p.filled_share / p.bulk_density;
    };
    EXPECT_NEAR(on_map(grains), 0.55 * volume, 1e-9 * volume);
    EXPECT_NEAR(on_map(liquid), saturation * 0.45 * volume, 1e-9 * volume);
  }
}

TEST(Fluid, DryScenesHaveOneSetAndNothingOfIt) {
  Scenario s = slide();
  s.fluid.reset();
  s.formulation = Formulation::full_stress;
  Simulation run = assemble(s, inputs(), 0, 1);
  EXPECT_EQ(run.parts().state.sets.size(), 1u);
  EXPECT_EQ(run.parts().state.sets[0].filled_share, 1);
  const SceneDescription d = describe(s, inputs());
  for (const char* name : {"liquid", "grains in liquid"}) {
    EXPECT_FALSE(note(d, name).active);
    EXPECT_THAT(note(d, name).fields, IsEmpty());
  }
}

TEST(Fluid, ALooseReleaseStaysLooseInAFluidAndIsThickerDry) {
  Scenario s = slide();
  s.grains->solid_fraction = Uncertain(0.42);
  s.grains->states.emplace().dilute.emplace();
  s.formulation = Formulation::full_stress;
  const ScenePlan wet = plan_scene(s, inputs(), 0);
  EXPECT_EQ(wet.reference_fraction, 0.42);
  EXPECT_EQ(wet.stress.states->reference_fraction, 0.42);
  EXPECT_NEAR(wet.stress.reference_density, 0.42 * 2500, 1e-9);
  EXPECT_NEAR(wet.release.max_thickness_m, 10, 1e-9);
  s.fluid.reset();
  const ScenePlan dry = plan_scene(s, inputs(), 0);
  EXPECT_EQ(dry.reference_fraction, 0.60);
  EXPECT_NEAR(dry.release.max_thickness_m, 7, 1e-9);
}

TEST(Fluid, GrainsStartUnderTheWeightThatBuoyancyLeaves) {
  Scenario s = slide();
  EXPECT_NEAR(weight_on_contacts(s), 1 - 1000.0 / 2500, 1e-12);
  EXPECT_NEAR(depth_on_contacts(s, {10})[0], 6, 1e-12);
  s.fluid->saturation = Uncertain(0.6);
  EXPECT_EQ(weight_on_contacts(s), 1) << "what does not fill the pores has no pressure";
  s = slide();
  s.coupling.emplace().scheme = CouplingScheme::paper;
  EXPECT_EQ(weight_on_contacts(s), 1);
  // Of all that lies on the bed, grains bear the rest.
  const double wet = 0.55 * 2500 + 0.45 * 1000;
  EXPECT_NEAR(weight_on_grains(slide()), 0.55 * 1500 / wet, 1e-12);
  EXPECT_NEAR(typical_friction(slide()), 0.4 * 0.55 * 1500 / wet, 1e-12);
}

TEST(Fluid, StiffnessFollowsTheFlowAsThatOfGrains) {
  const ScenePlan plan = plan_scene(mud(), inputs(), 0);
  ASSERT_TRUE(plan.liquid);
  const double at_rest = std::sqrt(9.81 * 10);
  EXPECT_NEAR(plan.liquid->least_sound_speed, 10 * at_rest, 0.01 * at_rest);
  EXPECT_NEAR(plan.liquid->sound_speed, 10 * plan.reference_speed_m_s, 1e-9);
  EXPECT_EQ(plan.liquid->viscosity, 0.02);
  EXPECT_EQ(plan.liquid->reference_density, 1600);
  // What the yield stress holds slows the fastest that it may get.
  Scenario stiff = mud();
  stiff.fluid->yield_stress_pa = Uncertain(40000);
  EXPECT_LT(plan_scene(stiff, inputs(), 0).reference_speed_m_s, 0.9 * plan.reference_speed_m_s);
  Scenario fixed = mud();
  fixed.numerics.adaptive_sound_speed = false;
  const ScenePlan held = plan_scene(fixed, inputs(), 0);
  EXPECT_EQ(held.liquid->least_sound_speed, held.liquid->sound_speed);
}

TEST(Fluid, TheLiquidMeetsTheGroundWithoutTheGrainsFriction) {
  Scenario s = slide();
  s.basal.cohesion_pa = 500;
  const ScenePlan plan = plan_scene(s, inputs(), 0);
  EXPECT_EQ(plan.contact.bed[0].friction_coefficient, 0.4);
  EXPECT_EQ(plan.liquid_contact.bed[0].friction_coefficient, 0);
  EXPECT_EQ(plan.liquid_contact.bed[0].cohesion_pa, 0);
  EXPECT_EQ(plan.liquid_contact.reference_density, 1000);
  EXPECT_NEAR(plan.contact.reference_density, 0.55 * 2500, 1e-9);
}

TEST(Fluid, DescribesBothEffectsAndTheOrderOfTheContacts) {
  Scenario s = slide();
  s.coupling.emplace().drag_diameter_m = Uncertain(0.002);
  const SceneDescription d = describe(s, inputs());
  EXPECT_EQ(d.formulation, "full_stress");
  EXPECT_EQ(d.n_particles % 2, 0u);
  EXPECT_NEAR(d.bulk_density_kg_m3, 0.55 * 2500 + 0.45 * 1000, 1e-9);
  EXPECT_THAT(note(d, "liquid").reason, HasSubstr("Newton's law, viscosity 0.01 Pa s"));
  EXPECT_THAT(note(d, "grains in liquid").reason,
              AllOf(HasSubstr("drag of grains of 0.002 m (coupling.drag_diameter_m; "
                              "grains.diameter_m is 0.5)"),
                    HasSubstr("a slow slip dies out within"), HasSubstr("drag and buoyancy")));
  std::vector<std::string> contacts;
  for (const std::string& pass : d.passes)
    if (pass.starts_with("contact: ")) contacts.push_back(pass.substr(9));
  ASSERT_GE(contacts.size(), 2u);
  EXPECT_EQ(contacts.front(), "terrain contact") << "the liquid's";
  EXPECT_EQ(contacts.back(), "terrain contact") << "the grains'";
  const SceneDescription alone = describe(mud(), inputs());
  EXPECT_THAT(note(alone, "liquid").reason,
              HasSubstr("Bingham's law, viscosity 50 Pa s, yield stress 500 Pa; 5 layers"));
  EXPECT_FALSE(note(alone, "grain stress").active);
  EXPECT_EQ(note(alone, "grains in liquid").reason, "no `grains`");
  EXPECT_GT(alone.sound_speed_m_s, 0);
  // Two sets take more memory than one, by about as much as the particles are more.
  EXPECT_GT(d.memory_bytes, 1.5 * static_cast<double>(alone.memory_bytes));
}

TEST(Fluid, EveryResultIsWarnedOfWhatIsNotPhysics) {
  EXPECT_THAT(warnings_of(slide()), Each(Not(HasSubstr("coupling"))));
  Scenario s = slide();
  s.coupling.emplace().drag_multiplier = Uncertain(10);
  EXPECT_THAT(warnings_of(s), Contains(HasSubstr("multiplied by 10 (coupling.drag_multiplier)")));
  s = slide();
  s.basal.pore_pressure_ratio = 0.2;
  EXPECT_THAT(messages(s), IsEmpty());
  EXPECT_THAT(warnings_of(s), Contains(HasSubstr("this counts as excess over its pressure")));
  s.fluid->saturation = Uncertain(0.6);
  EXPECT_THAT(warnings_of(s), Each(Not(HasSubstr("excess over"))));
  s = slide();
  s.coupling.emplace().scheme = CouplingScheme::paper;
  EXPECT_THAT(warnings_of(s), AllOf(Contains(HasSubstr("grains without buoyancy")),
                                    Each(Not(HasSubstr("counted twice")))));
  s.basal.pore_pressure_ratio = 0.2;
  const auto twice = warnings_of(s);
  EXPECT_THAT(twice, Contains(HasSubstr("pore pressure is counted twice: "
                                        "basal.pore_pressure_ratio = 0.2")));
  EXPECT_THAT(twice, Each(Not(HasSubstr("; ")))) << "members part their warnings there";
}

TEST(Fluid, CoarseGrainsAreWarnedOfWithTheirDrag) {
  Scenario s = slide();
  s.grains->diameter_m = Uncertain(1.5);
  EXPECT_THAT(warnings_of(s), Contains(AllOf(HasSubstr("coarse grains"), HasSubstr("their drag"))));
}

TEST(Fluid, PhysicalNumbersMayBeDistributions) {
  for (const char* path : {"fluid.density_kg_m3", "fluid.viscosity_pa_s", "fluid.yield_stress_pa",
                           "fluid.consistency_pa_sn", "fluid.index", "fluid.saturation",
                           "coupling.drag_diameter_m", "coupling.drag_multiplier"}) {
    ASSERT_NE(find_key(path), nullptr) << path;
    EXPECT_EQ(find_key(path)->kind, ValueKind::uncertain) << path;
  }
}

}  // namespace
}  // namespace sturz
