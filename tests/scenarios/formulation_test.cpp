// SPDX-License-Identifier: Apache-2.0
#include "scenarios/assembly/formulation.hpp"

#include "engine/core/constants.hpp"
#include "engine/core/error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace sturz {
namespace {

/// A scene that leaves the choice open.
Scenario scene(double spacing, Formulation formulation = Formulation::automatic) {
  Scenario s;
  s.grains.emplace().friction.emplace();
  s.formulation = formulation;
  s.numerics.spacing_m = spacing;
  return s;
}

/// Even thickness on 100 x 100 m.
Raster<double> slab(double thickness) {
  return Raster<double>(Grid{10, 10, 0, 100, 10, ""}, thickness);
}

std::string refusal(const Scenario& s, const Raster<double>& thickness) {
  try {
    choose_formulation(s, thickness);
  } catch (const SetupError& e) {
    return e.what();
  }
  return "accepted";
}

Scenario confined(Scenario s) {
  s.domain.walls = {WallSpec{{0, 0, 0}, {1, 0, 0}, 0, std::nullopt}};
  return s;
}

TEST(Formulation, LayersAreThoseOfTheReleaseAndOfTheExpectedDeposit) {
  const FormulationChoice c = choose_formulation(scene(0.5), slab(20));
  EXPECT_NEAR(c.release_layers, 40, 1e-12);
  // 200 000 m^3 over 20 V^(2/3).
  EXPECT_NEAR(c.deposit_layers, std::cbrt(2e5) / 20 / 0.5, 1e-12);
  EXPECT_EQ(c.layers, c.deposit_layers);
  const FormulationChoice thin = choose_formulation(scene(0.5), slab(0.1));
  EXPECT_NEAR(thin.release_layers, 0.2, 1e-12);
  EXPECT_EQ(thin.layers, thin.release_layers);
}

TEST(Formulation, LayersAreTheMedianByVolumeNotByArea) {
  // 300 m^2 of 2 m beside 100 m^2 of 10 m: half of the volume is in the thick part.
  Raster<double> thickness(Grid{5, 1, 0, 10, 10, ""}, 2.0);
  thickness.at(0, 3) = 10;
  thickness.at(0, 4) = nan_d;
  EXPECT_NEAR(choose_formulation(confined(scene(2)), thickness).release_layers, 5, 1e-12);
}

TEST(Formulation, AutoTakesFullStressWhereFourLayersResolveBoth) {
  const FormulationChoice c = choose_formulation(scene(0.5), slab(20));
  EXPECT_FALSE(c.depth_averaged);
  EXPECT_EQ(c.name(), "full_stress");
  EXPECT_EQ(c.reason,
            "`formulation: auto`: 40 layers at release, about 5.85 in the deposit (not fewer than "
            "4)");
}

TEST(Formulation, AutoTakesColumnsWhereTheDepositIsTooThin) {
  const FormulationChoice c = choose_formulation(scene(1), slab(20));
  EXPECT_TRUE(c.depth_averaged);
  EXPECT_EQ(c.name(), "depth_averaged");
  EXPECT_EQ(c.reason,
            "`formulation: auto`: 20 layers at release, about 2.92 in the deposit (fewer than 4)");
}

TEST(Formulation, AutoTakesColumnsWhereTheReleaseIsTooThin) {
  const FormulationChoice c = choose_formulation(scene(0.1), slab(0.3));
  EXPECT_TRUE(c.depth_averaged);
  EXPECT_EQ(c.reason,
            "`formulation: auto`: 3 layers at release, about 7.21 in the deposit (fewer than 4)");
}

TEST(Formulation, ConfinedScenesAreChosenByTheirReleaseAlone) {
  Scenario periodic = scene(5);
  periodic.domain.periodic = {"y"};
  for (const Scenario& s : {confined(scene(5)), periodic}) {
    const FormulationChoice c = choose_formulation(s, slab(20));
    EXPECT_FALSE(c.depth_averaged);
    EXPECT_EQ(c.deposit_layers, std::numeric_limits<double>::infinity());
    EXPECT_EQ(c.layers, 4);
    EXPECT_EQ(c.reason, "`formulation: auto`: 4 layers at release (not fewer than 4)");
  }
  const FormulationChoice thin = choose_formulation(confined(scene(8)), slab(20));
  EXPECT_TRUE(thin.depth_averaged);
  EXPECT_EQ(thin.reason, "`formulation: auto`: 2.5 layers at release (fewer than 4)");
}

TEST(Formulation, AutoTakesColumnsForWhatOnlyColumnsKnow) {
  Scenario s = scene(0.5);
  s.grains->earth_pressure = LateralPressure::active_passive;
  EXPECT_EQ(choose_formulation(s, slab(20)).reason,
            "`formulation: auto`: `grains.earth_pressure` acts on columns");
  s.basal.viscosity_pa_s = 100;
  EXPECT_EQ(choose_formulation(s, slab(20)).reason,
            "`formulation: auto`: `basal.viscosity_pa_s` acts on columns");
  s.basal.turbulent_coefficient_m_s2 = 500;
  const FormulationChoice c = choose_formulation(s, slab(20));
  EXPECT_EQ(c.reason, "`formulation: auto`: `basal.turbulent_coefficient_m_s2` acts on columns");
  EXPECT_TRUE(c.depth_averaged);
  EXPECT_NEAR(c.release_layers, 40, 1e-12) << "counted all the same";
}

TEST(Formulation, AutoTakesColumnsForATurbulentZone) {
  Scenario s = scene(0.5);
  ASSERT_FALSE(choose_formulation(s, slab(20)).depth_averaged);
  s.basal.zones = {{"forest.gpkg", "", {}, {}, {}, 400.0}};
  EXPECT_TRUE(choose_formulation(s, slab(20)).depth_averaged);
}

TEST(Formulation, AutoTakesColumnsWhereNoInternalFrictionIsGiven) {
  Scenario s = scene(0.5);
  s.grains->friction.reset();
  const FormulationChoice c = choose_formulation(s, slab(20));
  EXPECT_TRUE(c.depth_averaged);
  EXPECT_EQ(
      c.reason,
      "`formulation: auto`: no internal friction is given, which full_stress needs; 40 layers "
      "at release, about 5.85 in the deposit");
  s.grains->friction_angle_deg = Uncertain(30);
  EXPECT_FALSE(choose_formulation(s, slab(20)).depth_averaged);
}

/// Level ground under and around the slab.
Terrain level_ground() {
  return {std::make_shared<const Raster<double>>(Grid{30, 30, -100, 200, 10, ""}, 0.0),
          NodataRule::outflow};
}

TEST(Formulation, RefinementCostsItsPowerOfTheSpacing) {
  // Level ground, so that the speed of sqrt(g H) does not depend on the path.
  const CostEstimate coarse = estimate_cost(scene(2), slab(20), level_ground(), 120);
  const CostEstimate fine = estimate_cost(scene(1), slab(20), level_ground(), 120);
  EXPECT_NEAR(fine.full_stress / coarse.full_stress, 16, 1e-9);
  EXPECT_NEAR(fine.depth_averaged / coarse.depth_averaged, 8, 1e-9);
  // 200 000 particles of 1 m; c0 = 10 sqrt(g H), a step of 0.25 x 1.3 m / (1.1 c0), 120 s.
  const double wave = std::sqrt(standard_gravity * 20);
  EXPECT_NEAR(fine.full_stress, 2e5 * 120 * 1.1 * 10 * wave / (0.25 * 1.3),
              1e-3 * fine.full_stress);
}

TEST(Formulation, AutoNeverFlipsToWhatTakesHours) {
  FormulationChoice c = choose_formulation(scene(0.5), slab(20));
  ASSERT_FALSE(c.depth_averaged);
  weigh_cost(scene(0.5), slab(20), level_ground(), 120, c);
  EXPECT_TRUE(c.depth_averaged);
  // 1.6 million particles times 120 s x 11 x 14.0 m/s / 0.1625 m at 3 million a second.
  EXPECT_THAT(c.reason, ::testing::HasSubstr("which full_stress would resolve in about 16.9 h a "
                                             "member, columns in "));
  EXPECT_THAT(c.reason, ::testing::HasSubstr("have to be asked for (formulation: full_stress)"));
}

TEST(Formulation, AutoKeepsFullStressThatIsAffordableAndTellsBothCosts) {
  const Scenario s = confined(scene(5));
  FormulationChoice c = choose_formulation(s, slab(20));
  weigh_cost(s, slab(20), level_ground(), 120, c);
  EXPECT_FALSE(c.depth_averaged);
  EXPECT_THAT(c.reason, ::testing::StartsWith(
                            "`formulation: auto`: 4 layers at release (not fewer than 4); about "));
  EXPECT_THAT(c.reason, ::testing::HasSubstr(" a member, columns "));
}

TEST(Formulation, ColumnsAreTakenAtAnyThicknessWhenAskedFor) {
  for (const double thickness : {0.1, 20.0}) {
    const FormulationChoice c =
        choose_formulation(scene(0.5, Formulation::depth_averaged), slab(thickness));
    EXPECT_TRUE(c.depth_averaged);
    EXPECT_EQ(c.reason, "`formulation: depth_averaged`");
    EXPECT_NEAR(c.release_layers, 2 * thickness, 1e-12);
  }
}

TEST(Formulation, FullStressIsTakenDownToTwoLayersWhenAskedFor) {
  const FormulationChoice c = choose_formulation(scene(10, Formulation::full_stress), slab(20));
  EXPECT_FALSE(c.depth_averaged);
  EXPECT_EQ(c.reason,
            "`formulation: full_stress`; 2 layers at release, about 0.292 in the deposit");
  EXPECT_EQ(choose_formulation(confined(scene(10, Formulation::full_stress)), slab(20)).reason,
            "`formulation: full_stress`; 2 layers at release");
}

TEST(Formulation, FullStressUnderTwoLayersIsRefusedWithTheSpacingThatWouldDo) {
  EXPECT_EQ(refusal(scene(2, Formulation::full_stress), slab(3)),
            "formulation = full_stress (1.5 layers of particles resolve the release, fewer than 2: "
            "the footprint would be wrong by up to 100 %). Use formulation: auto, a "
            "numerics.spacing_m below 1.5 m, or accept it with numerics.accept_unresolved: true.");
  EXPECT_EQ(refusal(scene(1.5, Formulation::full_stress), slab(3)), "accepted");
}

TEST(Formulation, FullStressUnderTwoLayersIsTakenWhenAccepted) {
  Scenario s = scene(2, Formulation::full_stress);
  s.numerics.accept_unresolved = true;
  const FormulationChoice c = choose_formulation(s, slab(3));
  EXPECT_FALSE(c.depth_averaged);
  EXPECT_EQ(c.layers, c.deposit_layers) << "the deposit is thinner still";
}

TEST(Formulation, NoMassIsNotAMatterOfLayers) {
  // The release says what is wrong; a spacing below 0 m would not help.
  for (const Formulation formulation :
       {Formulation::automatic, Formulation::full_stress, Formulation::depth_averaged})
    for (const double nothing : {0.0, -1.0, nan_d})
      EXPECT_EQ(refusal(scene(2, formulation), slab(nothing)), "accepted")
          << to_string(formulation);
}

}  // namespace
}  // namespace sturz
