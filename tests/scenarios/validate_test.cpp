// SPDX-License-Identifier: Apache-2.0
#include "scenarios/checks/validate.hpp"

#include "engine/core/error.hpp"
#include "scenarios/catalogue.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace sturz {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<std::string> messages(const Scenario& s) {
  std::vector<std::string> texts;
  for (const auto& problem : validate(s)) texts.push_back(problem.message);
  return texts;
}

Uncertain uncertain(Distribution::Kind kind, double min, double max) {
  Uncertain u;
  u.distribution = Distribution{};
  u.distribution->kind = kind;
  u.distribution->min = min;
  u.distribution->max = max;
  return u;
}

Uncertain uniform(double min, double max) {
  return uncertain(Distribution::Kind::uniform, min, max);
}

TEST(Validate, AcceptsEverySceneOfTheCatalogue) {
  for (const auto& name : catalogue_names())
    EXPECT_THAT(messages(catalogue_scene(name)), IsEmpty()) << name;
}

TEST(Validate, AnEmptySceneLacksFourThings) {
  EXPECT_THAT(messages(Scenario{}), ElementsAre(HasSubstr("numerics.spacing_m (missing)"),
                                                HasSubstr("terrain (no ground given)"),
                                                HasSubstr("release (no source given)"),
                                                HasSubstr("grains (missing: nothing would move)")));
}

TEST(Validate, OutOfRangeNumbersGetAHint) {
  Scenario s = pile();
  s.grains->friction_angle_deg = Uncertain(240);
  s.basal.friction_coefficient = 24;
  s.basal.pore_pressure_ratio = 50;
  s.grains->density_kg_m3 = 2.6;
  s.release.thickness_m = Uncertain(-3);
  EXPECT_THAT(
      messages(s),
      ElementsAre("release.thickness_m = -3 (must be > 0 and <= 2000).",
                  "grains.density_kg_m3 = 2.6 (must be in 200..10000). Was it in g/cm3? 2.6 g/cm3 "
                  "= 2600 kg/m3.",
                  "grains.friction_angle_deg = 240 (must be in 0..60). Was it in another unit?",
                  "basal.friction_coefficient = 24 (must be in 0..2). Was it an angle in degrees? "
                  "tan 24 deg = 0.445.",
                  "basal.pore_pressure_ratio = 50 (must be in 0..0.99). Was it a percentage? 50 % "
                  "= 0.5."));
}

TEST(Validate, NotANumberIsOutOfEveryRange) {
  Scenario s = pile();
  s.basal.friction_coefficient = std::numeric_limits<double>::quiet_NaN();
  s.basal.cohesion_pa = std::numeric_limits<double>::infinity();
  EXPECT_THAT(messages(s), ElementsAre("basal.friction_coefficient = nan (must be in 0..2).",
                                       HasSubstr("basal.cohesion_pa = inf (must be >= 0).")));
}

TEST(Validate, ADistributionMustStayInTheKeysRange) {
  Scenario s = pile();
  Uncertain normal;
  normal.distribution = Distribution{};
  normal.distribution->kind = Distribution::Kind::normal;
  normal.distribution->mean = 0.3;
  normal.distribution->sd = 0.1;
  s.basal.pore_pressure_ratio = normal;
  s.basal.friction_coefficient = uniform(0.5, 30);
  EXPECT_THAT(
      messages(s),
      ElementsAre("basal.friction_coefficient = {uniform: [0.5, 30]} (its values reach from 0.5 "
                  "to 30 but must be in 0..2). Was it an angle in degrees? tan 30 deg = 0.577.",
                  "basal.pore_pressure_ratio = {normal: {mean: 0.3, sd: 0.1}} (its values reach "
                  "from -inf to inf but must be in 0..0.99). Truncate it: min: 0, max: 0.99."));
}

TEST(Validate, AnUntruncatedLognormalFitsAnUnboundedPositiveKey) {
  Scenario s = zhangjiawan_small();
  Uncertain lognormal;
  lognormal.distribution = Distribution{};
  lognormal.distribution->kind = Distribution::Kind::lognormal;
  lognormal.distribution->median = 5e5;
  lognormal.distribution->sigma_ln = 0.2;
  s.release.volume_m3 = lognormal;
  EXPECT_THAT(messages(s), IsEmpty());
}

TEST(Validate, OneTerrainAndOneSource) {
  Scenario s = pile();
  s.terrain.raster = "bed.tif";
  s.release.box = ReleaseBox{{0, 1}, {0, 1}};
  EXPECT_THAT(messages(s), ElementsAre(HasSubstr("terrain.synthetic (terrain.raster is there"),
                                       HasSubstr("more than one source: box, paraboloid")));
}

TEST(Validate, ThicknessOrVolumeNotBothNotNeither) {
  Scenario s = pile();
  s.release.volume_m3 = Uncertain(100);
  EXPECT_THAT(messages(s), ElementsAre(HasSubstr("release.volume_m3 (release.thickness_m fixes")));
  s.release.volume_m3.reset();
  s.release.thickness_m.reset();
  EXPECT_THAT(messages(s), ElementsAre(HasSubstr("how thick is the paraboloid?")));
  s.release = ReleaseSpec{};
  s.release.thickness_raster = "h.tif";
  s.release.thickness_m = Uncertain(3);
  EXPECT_THAT(messages(s), ElementsAre(HasSubstr("release.thickness_raster is the thickness")));
}

TEST(Validate, ASyntheticLandslideBringsItsSource) {
  Scenario s = zhangjiawan_small();
  s.release.thickness_m = Uncertain(3);
  s.release.surface = ReleaseSurface::pre_failure;
  EXPECT_THAT(messages(s), ElementsAre(HasSubstr("the synthetic terrain brings the thickness"),
                                       HasSubstr("release.surface = pre_failure")));
}

TEST(Validate, KeysWithoutTheirFileAreContradictions) {
  Scenario s = pile();
  s.release.layer = "a";
  s.release.thickness_attribute = "h";
  s.release.crs = "EPSG:32648";
  s.terrain.crs = "EPSG:32648";
  s.terrain.cell_size_m = 4;
  EXPECT_EQ(messages(s).size(), 6u) << "thickness from an attribute and from thickness_m clash too";
}

TEST(Validate, InternalFrictionIsGivenOnce) {
  Scenario s = pile();
  s.grains->friction.emplace();
  EXPECT_THAT(messages(s), ElementsAre(HasSubstr("grains.friction is there too")));
  s.grains->friction_angle_deg.reset();
  s.grains->friction.reset();
  EXPECT_THAT(messages(s), ElementsAre(HasSubstr("grains (no internal friction, which full_stress "
                                                 "needs)")));
}

TEST(Validate, InternalFrictionIsOnlyAskedForWhereItActs) {
  Scenario s = pile();
  s.grains->friction_angle_deg.reset();
  for (const Formulation f : {Formulation::depth_averaged, Formulation::automatic}) {
    s.formulation = f;
    s.grains->earth_pressure = LateralPressure::isotropic;
    EXPECT_THAT(messages(s), ::testing::IsEmpty());
    s.grains->earth_pressure = LateralPressure::active_passive;
    EXPECT_THAT(messages(s), ElementsAre(HasSubstr("earth_pressure: active_passive needs")));
  }
}

TEST(Validate, ATaperedFloorNeedsAReleaseThatIsDugOutAndHasNone) {
  Scenario s = pile();
  s.release.paraboloid.reset();
  s.release.box = ReleaseBox{{-5, 5}, {-5, 5}};
  s.release.floor = ReleaseFloor::tapered;
  EXPECT_THAT(messages(s), ElementsAre(HasSubstr("release.floor = tapered (surface is bed")));
  s.release.surface = ReleaseSurface::pre_failure;
  EXPECT_THAT(messages(s), ::testing::IsEmpty());
  s.release.box.reset();
  s.release.paraboloid = ReleaseParaboloid{{0, 0}, {16, 16}};
  EXPECT_THAT(messages(s), ElementsAre(HasSubstr("a paraboloid tapers already")));
  s.release.paraboloid.reset();
  s.release.thickness_m.reset();
  s.release.thickness_raster = "h.tif";
  EXPECT_THAT(messages(s), ElementsAre(HasSubstr("thickness_raster says the floor already")));
}

TEST(Validate, FrictionMayNotFallWithTheShearRate) {
  Scenario s = cliff();
  s.grains->friction->static_coefficient = uniform(0.3, 0.7);
  EXPECT_THAT(messages(s), ElementsAre("grains.friction.dynamic = 0.64 (must be >= "
                                       "grains.friction.static = 0.7). Friction may not fall with "
                                       "the shear rate."));
}

TEST(Validate, CorrelationsNameUncertainPairs) {
  Scenario s = pile();
  s.basal.friction_coefficient = uniform(0.3, 0.6);
  s.ensemble.correlation = {{"basal.friction_coefficient/basal.pore_pressure_ratio", -0.3}};
  EXPECT_THAT(messages(s), ElementsAre(HasSubstr("basal.pore_pressure_ratio is not an uncertain "
                                                 "value of this scenario")));
  s.basal.pore_pressure_ratio = uniform(0, 0.5);
  EXPECT_THAT(messages(s), IsEmpty());
  s.ensemble.correlation.begin()->second = 1;
  EXPECT_THAT(messages(s), ElementsAre(HasSubstr("(must be above -1 and below 1)")));
  s.ensemble.correlation = {{"basal.friction_coefficient", 0.5}};
  EXPECT_THAT(messages(s), ElementsAre(HasSubstr("(must be two keys, key/key)")));
}

TEST(Validate, AMemberKeepsTheCorrelationItWasDrawnWith) {
  Scenario s = pile();
  s.ensemble.correlation = {{"basal.friction_coefficient/basal.pore_pressure_ratio", -0.3}};
  EXPECT_THAT(messages(s), IsEmpty());
  s.ensemble.correlation = {{"basal.friction_coefficient/numerics.spacing_m", -0.3}};
  EXPECT_THAT(messages(s), ElementsAre(HasSubstr("numerics.spacing_m is not an uncertain value")));
}

TEST(Validate, CorrelationsMustFitTogether) {
  Scenario s = pile();
  s.basal.friction_coefficient = uniform(0.3, 0.6);
  s.basal.pore_pressure_ratio = uniform(0, 0.5);
  s.grains->solid_fraction = uniform(0.5, 0.6);
  const std::string f = "basal.friction_coefficient", p = "basal.pore_pressure_ratio",
                    a = "grains.solid_fraction";
  s.ensemble.correlation = {{f + "/" + p, 0.9}, {p + "/" + a, 0.9}, {a + "/" + f, -0.9}};
  EXPECT_THAT(messages(s), ElementsAre(HasSubstr("the matrix is not positive definite")));
  s.ensemble.correlation[a + "/" + f] = 0.8;
  EXPECT_THAT(messages(s), IsEmpty());
}

TEST(Validate, DesignAndTableBelongTogether) {
  Scenario s = pile();
  s.ensemble.design = Design::table;
  EXPECT_THAT(messages(s), ElementsAre(HasSubstr("ensemble.table (missing: design is table)")));
  s.ensemble.design = Design::sobol;
  s.ensemble.table = "design.csv";
  EXPECT_THAT(messages(s), ElementsAre(HasSubstr("ensemble.table (design is sobol)")));
  s.ensemble.table.clear();
}

TEST(Validate, UnknownWordsAreNamedAndChangeNothing) {
  const auto refusal = [](const char* path, const char* word) {
    const KeyInfo& key = *find_key(path);
    const auto problems = check_value(key, std::string(word));
    Scenario s;
    s.grains.emplace();
    const Scenario before = s;
    key.set(s, std::string(word));
    EXPECT_EQ(s, before);
    return problems.size() == 1 ? problems[0].message : "not one problem";
  };
  EXPECT_EQ(
      refusal("ensemble.design", "sobl"),
      "ensemble.design = sobl (must be one of monte_carlo, latin_hypercube, sobol, table, morris, "
      "saltelli). Did you mean sobol?");
  EXPECT_THAT(refusal("ensemble.design", "full_grid"),
              HasSubstr("(not available in this version)"));
  EXPECT_EQ(
      refusal("grains.states.stress_mode", "seed"),
      "grains.states.stress_mode = seed (has a new name in this version). Write paper_switch.");
  EXPECT_EQ(refusal("formulation", "depth_average"),
            "formulation = depth_average (must be one of auto, full_stress, depth_averaged, "
            "discrete). Did "
            "you mean depth_averaged?");
  EXPECT_EQ(
      refusal("grains.earth_pressure", "passive"),
      "grains.earth_pressure = passive (must be one of auto, isotropic, active, active_passive).");
}

TEST(Validate, ThresholdsRiseAndQuantilesLieInside) {
  Scenario s = pile();
  s.hazard.thickness_m = {1, 0.5};
  s.hazard.speed_m_s = {0, 1};
  s.hazard.quantiles = {0.5, 1};
  EXPECT_THAT(messages(s), ElementsAre(HasSubstr("hazard.speed_m_s = [0, 1] (must be > 0)"),
                                       HasSubstr("hazard.thickness_m = [1, 0.5] (every number"),
                                       HasSubstr("hazard.quantiles = [0.5, 1] (every level")));
}

TEST(Validate, WallsNeedADirection) {
  Scenario s = pile();
  s.domain.walls = {WallSpec{{0, 0, 0}, {0, 0, 0}, 5, -1.0}};
  EXPECT_THAT(messages(s),
              ElementsAre(HasSubstr("domain.walls[0].normal = [0, 0, 0] (must not be zero)"),
                          HasSubstr("domain.walls[0].friction_coefficient = 5 (must be in 0..2)"),
                          HasSubstr("domain.walls[0].remove_at_s = -1")));
}

TEST(Validate, FullStressKnowsNoDragOfColumns) {
  Scenario s = pile();
  s.formulation = Formulation::automatic;
  s.grains->earth_pressure = LateralPressure::active_passive;
  s.basal.turbulent_coefficient_m_s2 = Uncertain(500);
  s.basal.viscosity_pa_s = uniform(10, 100);
  s.basal.yield_stress_pa = Uncertain(200);
  EXPECT_THAT(messages(s), IsEmpty());
  s.formulation = Formulation::depth_averaged;
  EXPECT_THAT(messages(s), IsEmpty());
  s.formulation = Formulation::full_stress;
  EXPECT_THAT(
      messages(s),
      ElementsAre("grains.earth_pressure = active_passive (formulation is full_stress; only "
                  "depth_averaged knows it). Remove it or set formulation: depth_averaged.",
                  "basal.turbulent_coefficient_m_s2 = 500 (formulation is full_stress; only "
                  "depth_averaged knows it). Remove it or set formulation: depth_averaged.",
                  "basal.viscosity_pa_s = {uniform: [10, 100]} (formulation is full_stress; only "
                  "depth_averaged knows it). Remove it or set formulation: depth_averaged.",
                  "basal.yield_stress_pa = 200 (formulation is full_stress; only depth_averaged "
                  "knows it). Remove it or set formulation: depth_averaged."));
}

TEST(Validate, RestitutionAndIsotropicPressureStayInEveryFormulation) {
  Scenario s = pile();
  s.basal.restitution = 0.4;
  for (const Formulation formulation :
       {Formulation::automatic, Formulation::full_stress, Formulation::depth_averaged}) {
    s.formulation = formulation;
    EXPECT_THAT(messages(s), IsEmpty()) << to_string(formulation);
  }
}

TEST(Validate, AYieldStressNeedsAViscosity) {
  Scenario s = pile();
  s.formulation = Formulation::automatic;
  s.basal.yield_stress_pa = Uncertain(200);
  EXPECT_THAT(messages(s), ElementsAre("basal.yield_stress_pa = 200 (basal.viscosity_pa_s is "
                                       "missing). Add it: a Bingham fluid has both."));
}

TEST(Validate, TheDragOfColumnsHasRanges) {
  Scenario s = pile();
  s.formulation = Formulation::depth_averaged;
  s.basal.turbulent_coefficient_m_s2 = Uncertain(0);
  s.basal.viscosity_pa_s = Uncertain(0);
  s.basal.yield_stress_pa = Uncertain(-1);
  EXPECT_THAT(
      messages(s),
      ElementsAre("basal.turbulent_coefficient_m_s2 = 0 (must be > 0). Was it in another unit?",
                  "basal.viscosity_pa_s = 0 (must be > 0). Was it in another unit?",
                  "basal.yield_stress_pa = -1 (must be >= 0)."));
  s.basal.yield_stress_pa = Uncertain(0);
  EXPECT_THAT(messages(s).size(), 2u);
}

TEST(Validate, ZonesHaveAFileAndNumbersInTheBasesRanges) {
  Scenario s = pile();
  s.basal.zones = {{"plate.gpkg", "", 0.3, 0.85, 0.0}, {"ice.gpkg", "", {}, {}, 100.0}};
  EXPECT_THAT(messages(s), IsEmpty());
  s.basal.zones = {
      {"plate.gpkg", "", 24.0, 50.0, -1.0}, {"", "a", 0.3, {}, {}}, {"ice.gpkg", "", {}, {}, {}}};
  EXPECT_THAT(
      messages(s),
      ElementsAre("basal.zones[0].friction_coefficient = 24 (must be in 0..2). Was it an angle in "
                  "degrees? tan 24 deg = 0.445.",
                  "basal.zones[0].pore_pressure_ratio = 50 (must be in 0..0.99). Was it a "
                  "percentage? 50 % = 0.5.",
                  "basal.zones[0].cohesion_pa = -1 (must be >= 0).",
                  "basal.zones[1] (polygon is missing). Name the file that outlines the zone.",
                  "basal.zones[2] (gives no value). Give it some of friction_coefficient, "
                  "pore_pressure_ratio, cohesion_pa, turbulent_coefficient_m_s2."));
}

TEST(Validate, ZonesAreAtMost255) {
  Scenario s = pile();
  s.basal.zones.assign(255, {"plate.gpkg", "", 0.3, {}, {}});
  EXPECT_THAT(messages(s), IsEmpty());
  s.basal.zones.push_back(s.basal.zones.back());
  EXPECT_THAT(messages(s), ElementsAre("basal.zones = 256 zones (must be at most 255). Put "
                                       "polygons with equal values into one layer."));
}

TEST(Validate, SyntheticShapesAndTheirParametersAreKnown) {
  Scenario s = pile();
  s.terrain.synthetic->shape = "plan";
  EXPECT_THAT(messages(s), ElementsAre(HasSubstr("Did you mean plane?")));
  s = pile();
  s.terrain.synthetic->parameters = {{"slop_deg", 3}, {"width_m", -1}};
  EXPECT_THAT(messages(s),
              ElementsAre("terrain.synthetic.plane.slop_deg (unknown key). Did you mean slope_deg?",
                          "terrain.synthetic.plane.width_m = -1 (must be in 0.01..100000)."));
}

TEST(Validate, RequireValidThrowsAllProblemsAtOnce) {
  Scenario s = pile();
  s.numerics.courant = 3;
  s.numerics.jitter = 3;
  try {
    require_valid(s);
    FAIL();
  } catch (const SetupError& error) {
    EXPECT_THAT(error.what(), HasSubstr("courant"));
    EXPECT_THAT(error.what(), HasSubstr("\nnumerics.jitter"));
  }
}

}  // namespace
}  // namespace sturz
