// SPDX-License-Identifier: Apache-2.0
/// Blocks fluid and coupling: what they ask for, what they refuse, which keys do nothing.
#include "scenarios/assembly/liquid/liquid_plan.hpp"
#include "scenarios/checks/idle_keys.hpp"
#include "scenarios/checks/validate.hpp"
#include "scenarios/schema/schema.hpp"
#include "tests/scenarios/fluid/fluid_scenes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

namespace sturz {
namespace {

using test::mud;
using test::wet_slide;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

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

TEST(FluidChecks, AloneOrInTheirPoresItIsAScene) {
  EXPECT_THAT(messages(mud()), IsEmpty());
  EXPECT_THAT(messages(wet_slide()), IsEmpty());
  for (Scenario s : {mud(), wet_slide()}) {
    s.formulation = Formulation::full_stress;
    EXPECT_THAT(messages(s), IsEmpty());
  }
}

TEST(FluidChecks, ItsLawFollowsFromWhatIsGiven) {
  EXPECT_FALSE(liquid_law(*mud().fluid).newtonian());
  EXPECT_EQ(liquid_law(*mud().fluid).stress(2), 500 + 100);
  EXPECT_TRUE(liquid_law(*wet_slide().fluid).newtonian());
  Scenario s = mud();
  s.fluid->viscosity_pa_s.reset();
  s.fluid->consistency_pa_sn = Uncertain(30);
  s.fluid->index = Uncertain(0.5);
  EXPECT_THAT(messages(s), IsEmpty());
  EXPECT_EQ(liquid_law(*s.fluid).stress(4), 500 + 60);
}

TEST(FluidChecks, AnIncompleteLawIsToldWhatItLacks) {
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

TEST(FluidChecks, ColumnsAreRefusedOnceAndToldWhatToUse) {
  const auto as_columns = [](Scenario& s) { s.formulation = Formulation::depth_averaged; };
  EXPECT_THAT(messages_of(mud(), as_columns),
              ElementsAre(AllOf(HasSubstr("fluid (formulation is depth_averaged; only full_stress"),
                                HasSubstr("basal.viscosity_pa_s and basal.yield_stress_pa"))));
  EXPECT_THAT(messages_of(wet_slide(), as_columns),
              ElementsAre(HasSubstr("or use mixture with phases: two")));
  EXPECT_THAT(messages_of(wet_slide(), [](Scenario& s) { s.formulation = Formulation::discrete; }),
              Contains(HasSubstr("fluid (formulation is discrete")));
}

TEST(FluidChecks, WhatOnlyColumnsKnowIsRefusedBesideIt) {
  const auto refused = [](auto change, const char* path) {
    EXPECT_THAT(messages_of(wet_slide(), change),
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
  EXPECT_THAT(messages_of(wet_slide(), [](Scenario& s) { s.material = "debris_flow"; }),
              ElementsAre(HasSubstr("material = debris_flow (fluid is there too")));
}

TEST(FluidChecks, GrainsInItNeedFrictionAndMustBeHeavier) {
  EXPECT_THAT(messages_of(wet_slide(), [](Scenario& s) { s.grains->friction_angle_deg.reset(); }),
              ElementsAre(HasSubstr("grains (no internal friction, which full_stress needs)")));
  EXPECT_THAT(
      messages_of(wet_slide(), [](Scenario& s) { s.grains->density_kg_m3 = Uncertain(900); }),
      ElementsAre(HasSubstr("must be below grains.density_kg_m3 = 900")));
  EXPECT_THAT(messages_of(wet_slide(), [](Scenario& s) { s.grains->pore_pressure_inside = true; }),
              ElementsAre(HasSubstr("grains.pore_pressure_inside = true (fluid is there too")));
  EXPECT_THAT(messages_of(mud(), [](Scenario& s) { s.fluid->saturation = Uncertain(0.6); }),
              ElementsAre(HasSubstr("fluid.saturation = 0.6 (there are no grains")));
  EXPECT_THAT(messages_of(wet_slide(), [](Scenario& s) { s.fluid->saturation = Uncertain(1.4); }),
              ElementsAre(HasSubstr("fluid.saturation = 1.4 (must be in 0..1)")));
}

TEST(FluidChecks, CouplingNeedsBoth) {
  EXPECT_THAT(messages_of(mud(), [](Scenario& s) { s.coupling.emplace(); }),
              ElementsAre(HasSubstr("coupling (grains missing")));
  EXPECT_THAT(messages_of(wet_slide(),
                          [](Scenario& s) {
                            s.coupling.emplace();
                            s.fluid.reset();
                          }),
              ElementsAre(HasSubstr("coupling (fluid missing")));
}

TEST(FluidChecks, ByItselfItDoesNotKnowTheBedsFriction) {
  Scenario s = mud();
  s.basal.friction_coefficient = 0.3;
  s.basal.pore_pressure_ratio = 0.2;
  s.numerics.artificial_viscosity = 0.3;
  EXPECT_THAT(idle_keys(s, false),
              ElementsAre("basal.friction_coefficient", "basal.pore_pressure_ratio",
                          "numerics.artificial_viscosity"));
}

TEST(FluidChecks, ByItselfItRefusesWhatOnlyGrainsFeel) {
  EXPECT_THAT(
      messages_of(mud(), [](Scenario& s) { s.basal.rasters.friction_coefficient.path = "mu.tif"; }),
      ElementsAre(HasSubstr("basal.rasters.friction_coefficient (there are no grains")));
  const auto rough = [](Scenario& s) {
    s.domain.walls = {WallSpec{{0, 0, 0}, {1, 0, 0}, 0, std::nullopt},
                      WallSpec{{9, 0, 0}, {-1, 0, 0}, 0.3, std::nullopt}};
  };
  EXPECT_THAT(messages_of(mud(), rough),
              ElementsAre(HasSubstr("domain.walls[1].friction_coefficient = 0.3 (there are no "
                                    "grains that it could act on)")));
  EXPECT_THAT(messages_of(wet_slide(), rough), IsEmpty());
}

TEST(FluidChecks, AWallSticksToALiquidOnly) {
  const auto sticks = [](Scenario& s) {
    s.domain.walls = {WallSpec{{0, 0, 0}, {1, 0, 0}, 0, std::nullopt, WallLiquid::sticks}};
  };
  EXPECT_THAT(messages_of(mud(), sticks), IsEmpty());
  Scenario dry = wet_slide();
  dry.fluid.reset();
  EXPECT_THAT(messages_of(dry, sticks),
              ElementsAre(HasSubstr("domain.walls[0].liquid = sticks (there is no `fluid`)")));
}

TEST(FluidChecks, TheGrainsDiameterActsInTheirDrag) {
  Scenario s = wet_slide();
  EXPECT_THAT(idle_keys(s, false), IsEmpty());
  s.coupling.emplace().drag_diameter_m = Uncertain(0.002);
  EXPECT_THAT(idle_keys(s, false), ElementsAre("grains.diameter_m"));
}

TEST(FluidChecks, PhysicalNumbersMayBeDistributions) {
  for (const char* path : {"fluid.density_kg_m3", "fluid.viscosity_pa_s", "fluid.yield_stress_pa",
                           "fluid.consistency_pa_sn", "fluid.index", "fluid.saturation",
                           "coupling.drag_diameter_m", "coupling.drag_multiplier"}) {
    ASSERT_NE(find_key(path), nullptr) << path;
    EXPECT_EQ(find_key(path)->kind, ValueKind::uncertain) << path;
  }
}

}  // namespace
}  // namespace sturz
