// SPDX-License-Identifier: Apache-2.0
// grains.friction_cone and grains.pore_pressure_inside: what acts, what is said of it, what is not
// allowed.
#include "scenarios/assembly/grains/strength_inside.hpp"

#include "scenarios/assembly/assemble.hpp"
#include "scenarios/assembly/scene_plan.hpp"
#include "scenarios/catalogue.hpp"
#include "scenarios/checks/idle_keys.hpp"
#include "scenarios/checks/validate.hpp"
#include "tests/support/formula_ground.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

namespace sturz {
namespace {

using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

std::vector<std::string> messages(const Scenario& s) {
  std::vector<std::string> texts;
  for (const auto& problem : validate(s)) texts.push_back(problem.message);
  return texts;
}

Scenario sand(double angle_deg, FrictionCone cone) {
  Scenario s = pile();
  s.grains->friction_angle_deg = Uncertain(angle_deg);
  s.grains->friction_cone = cone;
  return s;
}

/// 10 m of it on 20 x 20 m of level ground.
SceneInputs square() {
  SceneInputs in;
  in.elevation = std::make_shared<const Raster<double>>(
      test::raster_of([](double, double) { return 0.0; }, Grid{60, 60, 0, 60, 1, ""}));
  Raster<double> block(in.elevation->grid);
  for (int r = 20; r < 40; ++r)
    for (int c = 20; c < 40; ++c) block.at(r, c) = 10;
  in.release = std::make_shared<const Raster<double>>(std::move(block));
  in.pattern = ReleasePattern::thickness;
  return in;
}

TEST(StrengthInside, SaysWhichAngleTheConeIs) {
  EXPECT_EQ(strength_text(sand(33, FrictionCone::simple_shear)),
            "friction_cone: simple_shear, 33 degrees act as 40.5 in plane strain");
  EXPECT_EQ(strength_text(sand(33, FrictionCone::plane_strain)),
            "friction_cone: plane_strain, 33 degrees act as 28.6 along a plane");
  EXPECT_THAT(strength_text(sand(50, FrictionCone::simple_shear)),
              EndsWith("50 degrees act as no finite angle in plane strain"));
  Scenario s = sand(33, FrictionCone::simple_shear);
  s.grains->friction_angle_deg.reset();
  s.grains->friction = FrictionLaw{Uncertain(0.38186), Uncertain(0.64347), Uncertain(0.279)};
  EXPECT_THAT(strength_text(s),
              EndsWith("20.9 to 32.8 degrees act as 22.4 to 40.1 in plane strain"));
}

TEST(StrengthInside, SaysWhatPorePressureDoes) {
  Scenario s = sand(33, FrictionCone::plane_strain);
  EXPECT_THAT(strength_text(s), Not(HasSubstr("pore_pressure")));
  s.basal.pore_pressure_ratio = 0.5;
  EXPECT_THAT(strength_text(s), EndsWith("; basal.pore_pressure_ratio weakens the bed only"));
  s.grains->pore_pressure_inside = true;
  EXPECT_THAT(strength_text(s), EndsWith("; pore_pressure_inside: a ratio of 0.5 leaves 15.8 "
                                         "degrees in plane strain"));
}

TEST(StrengthInside, ReachesTheSolverAndTheDescription) {
  Scenario s = sand(30, FrictionCone::plane_strain);
  s.numerics.spacing_m = 2;
  s.basal.pore_pressure_ratio = 0.4;
  const SceneInputs in = square();
  EXPECT_NEAR(plan_scene(s, in, 0).stress.law.static_friction, 0.5, 1e-12) << "the bed alone";
  s.grains->pore_pressure_inside = true;
  EXPECT_NEAR(plan_scene(s, in, 0).stress.law.static_friction, 0.3, 1e-12);
  EXPECT_EQ(plan_scene(s, in, 0).stress.friction_cone, FrictionCone::plane_strain);
  std::string said;
  for (const EffectNote& note : describe(s, in).effects)
    if (note.name == EffectName::grain_stress) said = note.reason;
  EXPECT_THAT(said, EndsWith("full stress; " + strength_text(s)));
}

/// The thrust of columns takes Mohr-Coulomb's own angle.
TEST(StrengthInside, ColumnsDoNotKnowTheCone) {
  Scenario s = sand(30, FrictionCone::plane_strain);
  s.formulation = Formulation::depth_averaged;
  s.basal.pore_pressure_ratio = 0.4;
  s.grains->pore_pressure_inside = true;
  EXPECT_NEAR(plan_scene(s, square(), 0).columns.internal_friction, std::tan(std::numbers::pi / 6),
              1e-15);
  EXPECT_THAT(idle_keys(s, true, true),
              ElementsAre("grains.friction_cone", "grains.pore_pressure_inside"));
  EXPECT_THAT(idle_keys(s, false), IsEmpty());
}

TEST(StrengthInside, OneRatioHoldsInside) {
  Scenario s = sand(33, FrictionCone::simple_shear);
  s.grains->pore_pressure_inside = true;
  s.basal.pore_pressure_ratio = 0.3;
  EXPECT_THAT(messages(s), IsEmpty());
  s.basal.zones.push_back({"zone.shp", "", Uncertain(0.3), std::nullopt, std::nullopt});
  EXPECT_THAT(messages(s), IsEmpty()) << "a zone of another friction";
  s.basal.zones[0].pore_pressure_ratio = Uncertain(0.5);
  EXPECT_THAT(messages(s),
              ElementsAre("grains.pore_pressure_inside = true (basal.zones[0].pore_pressure_ratio "
                          "changes it from place to place; inside, one ratio holds for the whole "
                          "scene). Keep one of them; basal.pore_pressure_ratio acts in both "
                          "places."));
  s.basal.zones.clear();
  s.basal.rasters.pore_pressure_ratio.path = "wet.tif";
  EXPECT_THAT(messages(s), ElementsAre(HasSubstr("(basal.rasters.pore_pressure_ratio changes")));
  s.formulation = Formulation::depth_averaged;
  EXPECT_THAT(messages(s), IsEmpty()) << "columns do not use it";
  s = wet_ramp();
  s.grains->pore_pressure_inside = true;
  s.formulation = Formulation::automatic;
  EXPECT_THAT(messages(s), ElementsAre(HasSubstr("(mixture is there too, which computes")));
}

}  // namespace
}  // namespace sturz
