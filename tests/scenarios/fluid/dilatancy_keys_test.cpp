// SPDX-License-Identifier: Apache-2.0
/// coupling.critical_solid_fraction: its presence is the switch of dilatancy.
#include "engine/effects/fields.hpp"
#include "engine/simulation/parts.hpp"
#include "engine/simulation/simulation.hpp"
#include "scenarios/assembly/assemble.hpp"
#include "scenarios/assembly/scene_plan.hpp"
#include "scenarios/checks/validate.hpp"
#include "tests/scenarios/fluid/fluid_scenes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace sturz {
namespace {

using test::slope_inputs;
using test::wet_slide;
using ::testing::HasSubstr;

Scenario sheared(double critical) {
  Scenario s = wet_slide();
  s.coupling.emplace();
  s.coupling->critical_solid_fraction = Uncertain(critical);
  s.coupling->drag_diameter_m = Uncertain(0.002);
  return s;
}

TEST(DilatancyKeys, PresenceOfTheCriticalFractionIsTheSwitch) {
  const ScenePlan plan = plan_scene(sheared(0.62), slope_inputs(), 0);
  ASSERT_TRUE(plan.dilatancy);
  EXPECT_EQ(plan.dilatancy->law.critical_fraction, 0.62);
  EXPECT_EQ(plan.dilatancy->law.solid_density, 2500);
  EXPECT_EQ(plan.dilatancy->law.fluid_viscosity, 0.01);
  EXPECT_EQ(plan.dilatancy->law.grain_diameter, 0.002);
  EXPECT_EQ(plan.dilatancy->reference_fraction, 0.55);
  EXPECT_EQ(plan.dilatancy->slope, 4);
  Simulation loose = assemble(sheared(0.62), slope_inputs(), 0, 1);
  EXPECT_TRUE(loose.parts().state.grains().has(fields::packing_change));
  EXPECT_FALSE(plan_scene(wet_slide(), slope_inputs(), 0).dilatancy);
  Simulation without = assemble(wet_slide(), slope_inputs(), 0, 1);
  EXPECT_FALSE(without.parts().state.grains().has(fields::packing_change));
}

TEST(DilatancyKeys, DescribeSaysWhichWayItGoes) {
  for (const double critical : {0.62, 0.5}) {
    const SceneDescription d = describe(sheared(critical), slope_inputs());
    const auto note = std::find_if(d.effects.begin(), d.effects.end(),
                                   [](const EffectNote& e) { return e.name == "dilatancy"; });
    ASSERT_NE(note, d.effects.end());
    EXPECT_TRUE(note->active);
    EXPECT_THAT(note->reason, HasSubstr(critical > 0.55 ? "tightens" : "loosens"));
  }
}

TEST(DilatancyKeys, WhatDoesNotGoTogetherIsSaid) {
  Scenario s = sheared(0.62);
  s.grains->states.emplace();
  std::string all;
  for (const Problem& p : validate(s)) all += p.message + "\n";
  EXPECT_THAT(all, HasSubstr("coupling.critical_solid_fraction = 0.62 (grains.states is there"));
  Scenario slope = wet_slide();
  slope.coupling.emplace();
  slope.coupling->dilatancy_slope = Uncertain(1);
  all.clear();
  for (const Problem& p : validate(slope)) all += p.message + "\n";
  EXPECT_THAT(all, HasSubstr("coupling.dilatancy_slope = 1 (no effect without"));
}

}  // namespace
}  // namespace sturz
