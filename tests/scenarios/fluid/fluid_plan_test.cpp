// SPDX-License-Identifier: Apache-2.0
/// What a scene makes of fluid and coupling: sets, masses, numbers, words.
#include "engine/core/error.hpp"
#include "engine/effects/fields.hpp"
#include "engine/laws/grain_states.hpp"
#include "engine/simulation/parts.hpp"
#include "scenarios/assembly/assemble.hpp"
#include "scenarios/assembly/formulation.hpp"
#include "scenarios/assembly/liquid/liquid_plan.hpp"
#include "scenarios/assembly/reach.hpp"
#include "scenarios/assembly/scene_plan.hpp"
#include "scenarios/checks/validate.hpp"
#include "tests/scenarios/fluid/fluid_scenes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sturz {
namespace {

using test::mud;
using test::released_m3;
using test::slope_inputs;
using test::wet_slide;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

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
  return plan_warnings(s, plan_scene(s, slope_inputs(), 0));
}

TEST(FluidPlan, AutoTakesParticlesHoweverThinTheFlow) {
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

TEST(FluidPlan, AloneIsOneSetOfThatNameAndAllOfTheVolume) {
  Simulation run = assemble(mud(), slope_inputs(), 0, 1);
  const State& state = run.parts().state;
  ASSERT_EQ(state.sets.size(), 1u);
  const MovingSet& liquid = state.sets[0];
  EXPECT_EQ(liquid.name, "liquid");
  EXPECT_NEAR(total(liquid.mass), 1600 * released_m3, 1e-9 * 1600 * released_m3);
  EXPECT_NEAR(liquid.ledger.released_mass, total(liquid.mass), 1e-9 * 1600 * released_m3);
  EXPECT_FALSE(liquid.has(fields::grain_share));
  EXPECT_FALSE(run.parts().peaks.settings().by_set);
}

TEST(FluidPlan, GrainsAndLiquidShareTheBulkVolumeExactly) {
  for (const double saturation : {1.0, 0.6}) {
    Scenario s = wet_slide();
    s.fluid->saturation = Uncertain(saturation);
    Simulation run = assemble(s, slope_inputs(), 0, 1);
    const State& state = run.parts().state;
    ASSERT_EQ(state.sets.size(), 2u);
    const MovingSet &grains = state.sets[0], &liquid = state.sets[1];
    EXPECT_EQ(grains.name, "grains");
    EXPECT_EQ(liquid.name, "liquid");
    const double solid = 0.55 * 2500 * released_m3, fluid = saturation * 0.45 * 1000 * released_m3;
    EXPECT_NEAR(total(grains.mass), solid, 1e-11 * solid);
    EXPECT_NEAR(total(liquid.mass), fluid, 1e-11 * fluid);
    if (saturation == 1) {
      EXPECT_EQ(liquid.x, grains.x);
      EXPECT_EQ(liquid.y, grains.y);
      EXPECT_EQ(liquid.z, grains.z);
      EXPECT_EQ(liquid.id, grains.id) << "each set counts its own";
    } else {
      // Five layers of two metres: it stands in the lowest three.
      EXPECT_EQ(5 * liquid.size(), 3 * grains.size());
    }
    EXPECT_TRUE(liquid.has(fields::grain_share));
    EXPECT_FALSE(grains.has(fields::grain_share));
    EXPECT_TRUE(run.parts().peaks.settings().by_set);
    // On a map each has the volume of its own matter.
    const auto on_map = [](const MovingSet& p) {
      return total(p.mass) * p.filled_share / p.bulk_density;
    };
    EXPECT_NEAR(on_map(grains), 0.55 * released_m3, 1e-9 * released_m3);
    EXPECT_NEAR(on_map(liquid), saturation * 0.45 * released_m3, 1e-9 * released_m3);
  }
}

TEST(FluidPlan, DryScenesHaveOneSetAndNothingOfIt) {
  Scenario s = wet_slide();
  s.fluid.reset();
  s.formulation = Formulation::full_stress;
  Simulation run = assemble(s, slope_inputs(), 0, 1);
  EXPECT_EQ(run.parts().state.sets.size(), 1u);
  EXPECT_EQ(run.parts().state.sets[0].filled_share, 1);
  const SceneDescription d = describe(s, slope_inputs());
  for (const char* name : {"liquid", "grains in liquid"}) {
    EXPECT_FALSE(note(d, name).active);
    EXPECT_THAT(note(d, name).fields, IsEmpty());
  }
}

TEST(FluidPlan, ALooseReleaseStaysLooseInAFluidAndIsThickerDry) {
  Scenario s = wet_slide();
  s.grains->solid_fraction = Uncertain(0.42);
  s.grains->states.emplace().dilute.emplace();
  s.formulation = Formulation::full_stress;
  const ScenePlan wet = plan_scene(s, slope_inputs(), 0);
  EXPECT_EQ(wet.reference_fraction, 0.60) << "from there on contacts bear load";
  EXPECT_EQ(wet.stress.states->reference_fraction, 0.60);
  EXPECT_EQ(wet.stress.states->loose_fraction, 0.42);
  EXPECT_NEAR(wet.stress.reference_density, 0.60 * 2500, 1e-9);
  EXPECT_NEAR(wet.release.max_thickness_m, 10, 1e-9);
  s.fluid.reset();
  const ScenePlan dry = plan_scene(s, slope_inputs(), 0);
  EXPECT_EQ(dry.reference_fraction, 0.60);
  EXPECT_FALSE(dry.stress.states->loose_fraction);
  EXPECT_NEAR(dry.release.max_thickness_m, 7, 1e-9);
}

TEST(FluidPlan, GrainsOfAWetReleaseStartInTheStateOfTheirPacking) {
  const std::pair<double, GrainState> packings[] = {
      {0.42, GrainState::dilute}, {0.55, GrainState::transition}, {0.62, GrainState::dense}};
  for (const auto& [packing, name] : packings) {
    Scenario s = wet_slide();
    s.grains->solid_fraction = Uncertain(packing);
    s.grains->states.emplace().dilute.emplace();
    s.formulation = Formulation::full_stress;
    Simulation run = assemble(s, slope_inputs(), 0, 1);
    const MovingSet& grains = run.parts().state.sets[0];
    const auto& change = grains.scalar(fields::density_change);
    const auto& stress = grains.components(fields::stress);
    for (std::size_t i = 0; i < grains.size(); ++i) {
      EXPECT_EQ(grains.flags(fields::state)[i], static_cast<std::uint8_t>(name)) << packing;
      EXPECT_NEAR(grains.reference_fraction * (1 + change[i]), packing, 0.02 * packing);
      // Ten metres of the submerged grains would be 49 kPa and more.
      if (packing < 0.6) {
        EXPECT_GT(stress[2][i], -100) << "a loose packing bears next to nothing";
      }
    }
    EXPECT_NEAR(total(grains.mass), packing * 2500 * released_m3, 1e-9 * 2500 * released_m3);
    for (int k = 0; k < 20; ++k) run.step();
    EXPECT_LT(run.parts().state.max_speed(), 5) << packing;
    EXPECT_TRUE(run.parts().state.sets[0].motion.finite) << packing;
  }
}

TEST(FluidPlan, GrainsStartUnderTheWeightThatBuoyancyLeaves) {
  const auto deepest = [](const Scenario& s) {
    const std::vector<double> depth = plan_scene(s, slope_inputs(), 0).liquid_start.grain_depth;
    return *std::max_element(depth.begin(), depth.end());
  };
  const double lowest = plan_scene(mud(), slope_inputs(), 0).liquid_start.deepest_m;
  EXPECT_GT(lowest, 8.5);
  Scenario s = wet_slide();
  EXPECT_NEAR(weight_on_contacts(s), 1 - 1000.0 / 2500, 1e-12);
  EXPECT_NEAR(deepest(s), 0.6 * lowest, 1e-9);
  // Liquid in the lowest six metres of ten lifts what stands in it.
  s.fluid->saturation = Uncertain(0.6);
  EXPECT_NEAR(weight_on_contacts(s), 1 - 0.6 * 0.4, 1e-12);
  EXPECT_NEAR(deepest(s), lowest - 0.4 * (lowest - 4), 1e-9);
  s = wet_slide();
  s.coupling.emplace().scheme = CouplingScheme::paper;
  EXPECT_EQ(weight_on_contacts(s), 1);
  EXPECT_NEAR(deepest(s), lowest, 1e-9);
  // Of all that lies on the bed, grains bear the rest.
  const double wet = 0.55 * 2500 + 0.45 * 1000;
  EXPECT_NEAR(weight_on_grains(wet_slide()), 0.55 * 1500 / wet, 1e-12);
  EXPECT_NEAR(typical_friction(wet_slide()), 0.4 * 0.55 * 1500 / wet, 1e-12);
}

TEST(FluidPlan, NothingJumpsWherePoresBecomeFull) {
  const auto at = [](double saturation) {
    Scenario s = wet_slide();
    s.fluid->saturation = Uncertain(saturation);
    return plan_scene(s, slope_inputs(), 0);
  };
  const ScenePlan full = at(1), nearly = at(0.999), less = at(0.9);
  const auto near = [](double a, double b) { EXPECT_NEAR(a, b, 2e-3 * std::abs(b)); };
  near(nearly.reference_speed_m_s, full.reference_speed_m_s);
  near(nearly.liquid->sound_speed, full.liquid->sound_speed);
  near(nearly.stress.sound_speed, full.stress.sound_speed);
  near(total(nearly.liquid_start.mass), total(full.liquid_start.mass));
  near(total(nearly.liquid_start.grain_depth), total(full.liquid_start.grain_depth));
  near(nearly.liquid_start.deepest_m, full.liquid_start.deepest_m);
  EXPECT_LT(less.reference_speed_m_s, nearly.reference_speed_m_s) << "it does vary";
}

TEST(FluidPlan, LiquidInSomeOfThePoresStandsFromTheBedUpUnderItsOwnSurface) {
  for (const double saturation : {0.07, 0.37, 0.5, 0.83}) {
    Scenario s = wet_slide();
    s.fluid->saturation = Uncertain(saturation);
    s.numerics.jitter = 0;
    const LiquidLattice at = plan_scene(s, slope_inputs(), 0).liquid_start;
    EXPECT_NEAR(total(at.mass), saturation * 0.45 * 1000 * released_m3, 1e-3);
    EXPECT_LT(at.deepest_m, 10 * saturation);
    for (std::size_t i = 0; i < at.size(); ++i) {
      const double above_bed = at.z[i] - (300 - 0.6 * at.x[i] + 0.1 * at.y[i]);
      EXPECT_NEAR(at.depth[i], std::max(0.0, 10 * saturation - above_bed), 1e-9) << saturation;
    }
  }
}

TEST(FluidPlan, StiffnessFollowsTheFlowAsThatOfGrains) {
  const ScenePlan plan = plan_scene(mud(), slope_inputs(), 0);
  ASSERT_TRUE(plan.liquid);
  const double at_rest = std::sqrt(9.81 * 10);
  EXPECT_NEAR(plan.liquid->least_sound_speed, 10 * at_rest, 0.01 * at_rest);
  EXPECT_NEAR(plan.liquid->sound_speed, 10 * plan.reference_speed_m_s, 1e-9);
  EXPECT_EQ(plan.liquid->viscosity, 0.02);
  EXPECT_EQ(plan.liquid->reference_density, 1600);
  // What the yield stress holds slows the fastest that it may get.
  Scenario stiff = mud();
  stiff.fluid->yield_stress_pa = Uncertain(40000);
  EXPECT_LT(plan_scene(stiff, slope_inputs(), 0).reference_speed_m_s,
            0.9 * plan.reference_speed_m_s);
  Scenario fixed = mud();
  fixed.numerics.adaptive_sound_speed = false;
  const ScenePlan held = plan_scene(fixed, slope_inputs(), 0);
  EXPECT_EQ(held.liquid->least_sound_speed, held.liquid->sound_speed);
}

TEST(FluidPlan, TheLiquidMeetsTheGroundWithoutTheGrainsFriction) {
  Scenario s = wet_slide();
  s.basal.cohesion_pa = 500;
  const ScenePlan plan = plan_scene(s, slope_inputs(), 0);
  EXPECT_EQ(plan.contact.bed[0].friction_coefficient, 0.4);
  EXPECT_EQ(plan.liquid_contact.bed[0].friction_coefficient, 0);
  EXPECT_EQ(plan.liquid_contact.bed[0].cohesion_pa, 0);
  EXPECT_EQ(plan.liquid_contact.reference_density, 1000);
  ASSERT_TRUE(plan.liquid_contact.liquid);
  EXPECT_EQ(plan.liquid_contact.liquid->law.consistency, 0.01);
  EXPECT_FALSE(plan.contact.liquid);
  EXPECT_NEAR(plan.contact.reference_density, 0.55 * 2500, 1e-9);
}

TEST(FluidPlan, WallsDragItWhereTheFileSaysSo) {
  Scenario s = mud();
  s.domain.walls = {WallSpec{{0, 0, 0}, {1, 0, 0}, 0, std::nullopt},
                    WallSpec{{200, 0, 0}, {-1, 0, 0}, 0, std::nullopt, WallLiquid::sticks}};
  const ScenePlan plan = plan_scene(s, slope_inputs(), 0);
  EXPECT_THAT(plan.liquid_contact.liquid->wall_holds, ElementsAre(false, true));
}

TEST(FluidPlan, TheEnergyLineIsThatOfWhatBearsTheWeight) {
  const auto line = [](const Scenario& s) { return energy_line(s, slope_inputs(), 300).friction; };
  const double grains = 0.55 * 1500, all = 0.55 * 2500 + 0.45 * 1000;
  Scenario s = wet_slide();
  EXPECT_NEAR(line(s), 0.4 * grains / all, 1e-12);
  s.basal.pore_pressure_ratio = 0.5;
  EXPECT_NEAR(line(s), 0.2 * grains / all, 1e-12);
  // Loose grains that shear liquefies keep next to nothing.
  s = wet_slide();
  s.coupling.emplace().critical_solid_fraction = Uncertain(0.6);
  EXPECT_NEAR(line(s), 0.4 * liquefied_share, 1e-12);
  s.coupling->critical_solid_fraction = Uncertain(0.5);
  EXPECT_NEAR(line(s), 0.4 * grains / all, 1e-12);
  // Of what is drawn, the least.
  s = wet_slide();
  Distribution& d = s.fluid->saturation.distribution.emplace();
  d.kind = Distribution::Kind::uniform;
  d.min = 0.5, d.max = 1;
  EXPECT_NEAR(line(s), 0.4 * grains / all, 1e-12);
  // A liquid alone: what its yield stress bears of the thickest part, and 0.05 at least.
  EXPECT_EQ(line(mud()), liquid_friction);
  Scenario stiff = mud();
  stiff.fluid->yield_stress_pa = Uncertain(0.1 * 1600 * 9.81 * 10);
  EXPECT_NEAR(line(stiff), 0.1, 1e-4);
}

TEST(FluidPlan, TheBedHoldsWhatLayersResolveAndDragsAFilmElse) {
  const auto bed = [](const Scenario& s) {
    return plan_scene(s, slope_inputs(), 0).liquid_contact.liquid->bed;
  };
  Scenario s = mud();
  EXPECT_EQ(bed(s), LiquidBed::film) << "five layers at release, one where it comes to rest";
  s.numerics.spacing_m = 0.3;
  EXPECT_EQ(bed(s), LiquidBed::no_slip);
  s.fluid->bed = FluidBed::slip;
  EXPECT_EQ(bed(s), LiquidBed::slip);
  s.numerics.spacing_m = 2;
  s.fluid->bed = FluidBed::no_slip;
  EXPECT_EQ(bed(s), LiquidBed::no_slip);
}

TEST(FluidPlan, DescribesBothEffectsAndTheOrderOfTheContacts) {
  Scenario s = wet_slide();
  s.coupling.emplace().drag_diameter_m = Uncertain(0.002);
  const SceneDescription d = describe(s, slope_inputs());
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
  EXPECT_THAT(contacts,
              ElementsAre("terrain contact, liquid", "buoyancy and drag", "terrain contact"));
  const SceneDescription alone = describe(mud(), slope_inputs());
  EXPECT_THAT(note(alone, "liquid").reason,
              HasSubstr("Bingham's law, viscosity 50 Pa s, yield stress 500 Pa; 5 layers"));
  EXPECT_FALSE(note(alone, "grain stress").active);
  EXPECT_EQ(note(alone, "grains in liquid").reason, "no `grains`");
  EXPECT_GT(alone.sound_speed_m_s, 0);
  // Two sets take more memory than one, by about as much as the particles are more.
  EXPECT_GT(d.memory_bytes, 1.5 * static_cast<double>(alone.memory_bytes));
}

TEST(FluidPlan, EveryResultIsWarnedOfWhatIsNotPhysics) {
  EXPECT_THAT(warnings_of(wet_slide()), Each(Not(HasSubstr("coupling"))));
  Scenario s = wet_slide();
  s.coupling.emplace().drag_multiplier = Uncertain(10);
  EXPECT_THAT(warnings_of(s), Contains(HasSubstr("multiplied by 10 (coupling.drag_multiplier)")));
  s = wet_slide();
  s.basal.pore_pressure_ratio = 0.2;
  EXPECT_THAT(validate(s), IsEmpty());
  EXPECT_THAT(warnings_of(s), Contains(HasSubstr("this counts as excess over its pressure")));
  s.fluid->saturation = Uncertain(0.6);
  EXPECT_THAT(warnings_of(s), Contains(HasSubstr("this counts as excess over its pressure")))
      << "there, too, the bed is under liquid";
  s = wet_slide();
  s.coupling.emplace().scheme = CouplingScheme::paper;
  EXPECT_THAT(warnings_of(s), AllOf(Contains(HasSubstr("grains without buoyancy")),
                                    Each(Not(HasSubstr("counted twice")))));
  s.basal.pore_pressure_ratio = 0.2;
  const auto twice = warnings_of(s);
  EXPECT_THAT(twice, Contains(HasSubstr("pore pressure is counted twice: "
                                        "basal.pore_pressure_ratio = 0.2")));
  EXPECT_THAT(twice, Each(Not(HasSubstr("; ")))) << "members part their warnings there";
}

TEST(FluidPlan, CoarseGrainsAreWarnedOfWithTheirDrag) {
  Scenario s = wet_slide();
  s.grains->diameter_m = Uncertain(1.5);
  EXPECT_THAT(warnings_of(s), Contains(AllOf(HasSubstr("coarse grains"), HasSubstr("their drag"))));
}

}  // namespace
}  // namespace sturz
