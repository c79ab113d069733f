// SPDX-License-Identifier: Apache-2.0
#include "io/scenario/scenario_file.hpp"

#include "io/files/io_error.hpp"
#include "scenarios/catalogue.hpp"
#include "scenarios/schema/schema.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

namespace sturz {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

const char* const everything = R"(title: "Everything: at once"
terrain: {raster: data/bed.tif, crs: EPSG:32648, cell_size_m: 5, nodata: wall}
release:
  polygon: source.gpkg
  layer: outline
  crs: EPSG:32633
  thickness_m: {lognormal: {median: 3, sigma_ln: 0.2, max: 9}}
  surface: pre_failure
  velocity_m_s: [1, -2, 0.5]
grains:
  density_kg_m3: {normal: {mean: 2600, sd: 50, min: 2400, max: 2800}}
  diameter_m: {log_uniform: [0.01, 1]}
  solid_fraction: {triangular: [0.40, 0.50, 0.60]}
  friction: {static: 0.38, dynamic: {uniform: {min: 0.5, max: 0.7}}, inertial_number_scale: 0.3}
  cohesion_pa: {discrete: {values: [0, 1000], weights: [3, 1]}}
  poisson_ratio: {table: [0.3, 0.2, 0.25]}
  earth_pressure: active_passive
  friction_cone: plane_strain
  pore_pressure_inside: true
basal:
  friction_coefficient: {truncated_normal: {mean: 0.4, sd: 0.1, min: 0.2, max: 0.6}}
  pore_pressure_ratio: {beta: {alpha: 4, beta: 3, min: 0.0, max: 0.6}}
  restitution: 0.1
  turbulent_coefficient_m_s2: {uniform: [200, 1000]}
  viscosity_pa_s: 50
  yield_stress_pa: {log_uniform: [10, 1000]}
  zones:
    - {polygon: zones/plate.gpkg, layer: "wet part", friction_coefficient: 0.3, cohesion_pa: 0}
    - {polygon: source.gpkg, pore_pressure_ratio: 0.85}
formulation: depth_averaged
numerics: {spacing_m: 5, end_time_s: 150, stop_at_rest: false, max_wall_time_s: 600,
           accept_unresolved: true}
domain:
  periodic: [y]
  walls:
    - {point_m: [3, 0, 0], normal: [0, 1, 0], friction_coefficient: 0.3, remove_at_s: 0}
    - {point_m: [3, 1, 0], normal: [0, -1, 0]}
ensemble:
  design: sobol
  members: 256
  seed: 7
  correlation: {basal.friction_coefficient/basal.pore_pressure_ratio: -0.3}
  max_failed_fraction: 0.1
hazard: {cell_size_m: 5, thickness_m: [0.1, 2], speed_m_s: [1], energy_kj_m2: [10],
         pressure_kpa: [1, 10, 30], quantiles: [0.5]}
)";

TEST(ScenarioFile, ReadsEveryBlock) {
  const Scenario s = read_scenario_text(everything, "all.yaml", "dir");
  EXPECT_EQ(s.title, "Everything: at once");
  EXPECT_EQ(s.directory, "dir");
  EXPECT_EQ(s.terrain.crs, "EPSG:32648");
  EXPECT_EQ(s.terrain.nodata, TerrainEdge::wall);
  EXPECT_EQ(s.release.velocity_m_s, (std::array<double, 3>{1, -2, 0.5}));
  EXPECT_EQ(s.release.thickness_m->distribution->kind, Distribution::Kind::lognormal);
  EXPECT_EQ(s.release.thickness_m->distribution->min, std::nullopt);
  EXPECT_EQ(s.grains->friction->dynamic_coefficient.distribution->max, 0.7);
  EXPECT_THAT(s.grains->poisson_ratio.distribution->values, ElementsAre(0.2, 0.25, 0.3));
  EXPECT_THAT(s.grains->cohesion_pa.distribution->weights, ElementsAre(3, 1));
  EXPECT_EQ(s.basal.friction_coefficient.distribution->kind, Distribution::Kind::normal);
  EXPECT_EQ(s.grains->earth_pressure, LateralPressure::active_passive);
  EXPECT_EQ(s.grains->friction_cone, FrictionCone::plane_strain);
  EXPECT_TRUE(s.grains->pore_pressure_inside);
  EXPECT_EQ(s.basal.turbulent_coefficient_m_s2->distribution->max, 1000);
  EXPECT_EQ(s.basal.viscosity_pa_s, Uncertain(50));
  EXPECT_EQ(s.basal.yield_stress_pa->distribution->kind, Distribution::Kind::log_uniform);
  EXPECT_THAT(s.basal.zones, ElementsAre(BasalZone{"zones/plate.gpkg", "wet part", 0.3, {}, 0.0},
                                         BasalZone{"source.gpkg", "", {}, 0.85, {}}));
  EXPECT_EQ(s.formulation, Formulation::depth_averaged);
  EXPECT_FALSE(s.numerics.stop_at_rest);
  EXPECT_TRUE(s.numerics.accept_unresolved);
  ASSERT_EQ(s.domain.walls.size(), 2u);
  EXPECT_EQ(s.domain.walls[0].remove_at_s, 0.0);
  EXPECT_EQ(s.domain.walls[1].remove_at_s, std::nullopt);
  EXPECT_EQ(s.ensemble.correlation.at("basal.friction_coefficient/basal.pore_pressure_ratio"),
            -0.3);
  EXPECT_EQ(uncertain_keys(s).size(), 11u);
}

TEST(ScenarioFile, WritesWhatReadsBackEqual) {
  const Scenario s = read_scenario_text(everything, "all.yaml", "dir");
  const std::string written = write_scenario(s);
  EXPECT_EQ(read_scenario_text(written, "again.yaml", "dir"), s) << written;
  EXPECT_EQ(write_scenario(read_scenario_text(written, "again.yaml", "dir")), written);
}

TEST(ScenarioFile, WritesEverySceneOfTheCatalogue) {
  for (const auto& name : catalogue_names()) {
    const Scenario s = catalogue_scene(name);
    EXPECT_EQ(read_scenario_text(write_scenario(s), name), s) << name;
  }
}

TEST(ScenarioFile, KeepsEveryDigitAndEveryLetter) {
  Scenario s = pile();
  s.title = "\"quoted\", back\\slash, n\xc3\xa9v\xc3\xa9\nsecond line: - #";
  s.numerics.spacing_m = 1.0 / 3;
  s.numerics.artificial_viscosity = 1e-300;
  s.ensemble.seed = 9007199254740992;
  EXPECT_EQ(read_scenario_text(write_scenario(s), "text"), s);
}

TEST(ScenarioFile, WrittenElsewhereItStillFindsItsFiles) {
  const Scenario s = read_scenario_text(everything, "all.yaml", "/data/scenes");
  const Scenario moved =
      read_scenario_text(write_scenario(s, "/data/out/run"), "s", "/data/out/run");
  EXPECT_EQ(moved.terrain.raster, "../../scenes/data/bed.tif");
  EXPECT_EQ(moved.release.polygon, "../../scenes/source.gpkg");
  EXPECT_EQ(moved.basal.zones[0].polygon, "../../scenes/zones/plate.gpkg");
  EXPECT_EQ(moved.basal.zones[0].layer, "wet part");
  EXPECT_EQ(moved.basal.zones[1].polygon, "../../scenes/source.gpkg");
  Scenario absolute = s;
  absolute.terrain.raster = "/vsicurl/https://example.org/bed.tif";
  absolute.release.polygon = "PG:dbname=a/b";
  absolute.basal.zones[1].polygon = "/data/plate.gpkg";
  EXPECT_THAT(write_scenario(absolute, "/data/out"),
              ::testing::AllOf(HasSubstr("raster: \"/vsicurl/https://example.org/bed.tif\""),
                               HasSubstr("polygon: \"PG:dbname=a/b\""),
                               HasSubstr("{polygon: \"/data/plate.gpkg\", pore")));
}

TEST(ScenarioFile, TellsWhereEachKeyStands) {
  const auto file = read_scenario_file_text(everything, "all.yaml");
  EXPECT_EQ(file.positions.at("terrain.raster").text(), "all.yaml:2:19");
  EXPECT_EQ(file.positions.at("grains.friction.dynamic").text(), "all.yaml:14:37");
  EXPECT_EQ(file.positions.count("basal.cohesion_pa"), 0u);
}

TEST(ScenarioFile, OverridesReplaceAddAndRemove) {
  const Scenario s = read_scenario_text(
      everything, "all.yaml", {},
      {"numerics.spacing_m=8", "basal.friction_coefficient={uniform: [0.2, 0.4]}",
       "basal.cohesion_pa=50", "ensemble.correlation=null", "numerics.spacing_m=9", "title=a = b"});
  EXPECT_EQ(s.numerics.spacing_m, 9);
  EXPECT_EQ(s.basal.friction_coefficient.distribution->max, 0.4);
  EXPECT_EQ(s.basal.cohesion_pa, Uncertain(50));
  EXPECT_TRUE(s.ensemble.correlation.empty());
  EXPECT_EQ(s.title, "a = b");
}

TEST(ScenarioFile, OverridesCanReplaceTheZones) {
  const Scenario s = read_scenario_text(
      everything, "all.yaml", {}, {"basal.zones=[{polygon: a.gpkg, friction_coefficient: 0.2}]"});
  EXPECT_THAT(s.basal.zones, ElementsAre(BasalZone{"a.gpkg", "", 0.2, {}, {}}));
  EXPECT_TRUE(
      read_scenario_text(everything, "all.yaml", {}, {"basal.zones=null"}).basal.zones.empty());
}

TEST(ScenarioFile, OverridesCanReplaceAWholeBlock) {
  const Scenario s = read_scenario_text(everything, "all.yaml", {},
                                        {"release={box: {x_m: [0, 1], y_m: [0, 1]}, volume_m3: 3}",
                                         "grains.friction=null", "grains.friction_angle_deg=30"});
  EXPECT_TRUE(s.release.polygon.empty());
  EXPECT_TRUE(s.release.box);
  EXPECT_FALSE(s.grains->friction);
}

TEST(ScenarioFile, NamesTheOverrideThatIsWrong) {
  const auto problems = [](const std::string& text) -> std::vector<std::string> {
    try {
      read_scenario_text(everything, "all.yaml", {}, {text});
    } catch (const ScenarioError& error) {
      return error.problems();
    }
    return {};
  };
  EXPECT_THAT(problems("basal.restitution=2"),
              ElementsAre("--set basal.restitution: basal.restitution = 2 (must be in 0..0.95). "
                          "Was it a percentage? 2 % = 0.02."));
  EXPECT_THAT(problems("basal.restitution"),
              ElementsAre("--set basal.restitution: must look like key.path=value."));
  EXPECT_THAT(problems("basal.restitution="), ElementsAre(HasSubstr("has no value")));
  EXPECT_THAT(problems("title.sub=3"), ElementsAre(HasSubstr("holds a value, not a block")));
  EXPECT_THAT(problems("numerics.courant=null"), ElementsAre(HasSubstr("nothing to remove")));
  EXPECT_THAT(problems("numerics.speed=3"), ElementsAre(HasSubstr("(unknown key)")));
  EXPECT_THAT(problems("numerics.courant=*a"), ElementsAre(HasSubstr("not readable as YAML")));
}

TEST(ScenarioFile, ShippedCasesAreValidAndResolveTheirSource) {
  int n_cases = 0;
  for (const auto& entry : fs::directory_iterator(STURZ_SOURCE_DIR "/scenarios/cases")) {
    const Scenario s = read_scenario(entry.path() / "scenario.yaml");
    EXPECT_EQ(s.directory, entry.path().string());
    EXPECT_GE(s.ensemble.members, 32) << entry.path();
    EXPECT_FALSE(uncertain_keys(s).empty()) << entry.path();
    EXPECT_EQ(read_scenario_text(write_scenario(s), "w", s.directory), s);
    EXPECT_TRUE(fs::exists(entry.path() / "README.md"));
    ++n_cases;
  }
  EXPECT_GE(n_cases, 2);
}

TEST(ScenarioFile, ConditionsOfOneCaseDifferInOneBlockOrNumber) {
  const auto read = [](const std::string& name) {
    return read_scenario(STURZ_SOURCE_DIR "/scenarios/cases/" + name);
  };
  const Scenario dry = read("shuicheng/condition_1.yaml");
  const auto same_but_for = [&](Scenario s, auto undo) {
    undo(s);
    s.title = dry.title;
    EXPECT_EQ(s, dry);
  };
  const auto no_pressure = [](Scenario& s) { s.basal.pore_pressure_ratio = 0; };
  const auto no_slurry = [](Scenario& s) { s.fluid.reset(), s.coupling.reset(); };
  same_but_for(read("shuicheng/condition_2.yaml"), no_pressure);
  same_but_for(read("shuicheng/condition_3.yaml"), no_slurry);
  same_but_for(read("shuicheng/condition_4.yaml"), [&](Scenario& s) {
    no_pressure(s);
    no_slurry(s);
  });
  // 100 kg of gravel; 0, 36.3 and 84.5 kg of slurry.
  const double slurry[] = {0, 36.3, 84.5};
  for (int k = 0; k < 3; ++k) {
    const Scenario s = read("flume/flume_" + std::to_string(k + 1) + ".yaml");
    const double volume = s.release.volume_m3->value, fraction = s.grains->solid_fraction.value;
    EXPECT_NEAR(2600 * fraction * volume, 100, 0.05);
    ASSERT_EQ(s.fluid.has_value(), k > 0);
    if (!s.fluid) continue;
    const FluidSpec& fluid = *s.fluid;
    EXPECT_NEAR(fluid.density_kg_m3.value * fluid.saturation.value * (1 - fraction) * volume,
                slurry[k], 0.05);
  }
}

TEST(ScenarioFile, AWallSaysWhatItDoesToALiquid) {
  const auto read = [](const std::string& word) {
    return read_scenario_text(
        "terrain: {synthetic: {plane: {cell_size_m: 2}}}\n"
        "release: {box: {x_m: [-30, -20], y_m: [-5, 5]}, thickness_m: 3}\n"
        "fluid: {viscosity_pa_s: 20}\nnumerics: {spacing_m: 1}\n"
        "domain: {walls: [{point_m: [40, 0, 0], normal: [-1, 0, 0], liquid: " +
            word + "}]}\n",
        "glass.yaml", {});
  };
  const Scenario s = read("sticks");
  EXPECT_EQ(s.domain.walls[0].liquid, WallLiquid::sticks);
  EXPECT_EQ(read_scenario_text(write_scenario(s), "w", s.directory), s);
  EXPECT_EQ(read("slips").domain.walls[0].liquid, WallLiquid::slips);
  EXPECT_THROW(read("glues"), ScenarioError);
}

TEST(ScenarioFile, ColumnsInWaterDifferInPackingAndHeightAlone) {
  const auto read = [](const std::string& name) {
    return read_scenario(STURZ_SOURCE_DIR "/scenarios/cases/column_in_water/" + name);
  };
  const Scenario loose = read("loose.yaml");
  EXPECT_EQ(loose.grains->solid_fraction, Uncertain(0.55));
  EXPECT_EQ(loose.release.thickness_m, Uncertain(0.048));
  Scenario dense = read("dense.yaml"), open = read("scenario.yaml");
  EXPECT_EQ(dense.grains->solid_fraction, Uncertain(0.60));
  EXPECT_EQ(dense.release.thickness_m, Uncertain(0.042));
  dense.grains->solid_fraction = loose.grains->solid_fraction;
  dense.release.thickness_m = loose.release.thickness_m;
  dense.title = loose.title;
  EXPECT_EQ(dense, loose);
  EXPECT_THAT(uncertain_keys(open), SizeIs(2)) << "packing, and the one that shear leaves";
  EXPECT_EQ(open.fluid, loose.fluid);
  EXPECT_EQ(open.domain, loose.domain);
}

TEST(ScenarioFile, ZhangjiawanCarriesTheNumbersOfItsTable) {
  const Scenario s = read_scenario(STURZ_SOURCE_DIR "/scenarios/cases/zhangjiawan/scenario.yaml");
  EXPECT_EQ(s.grains->density_kg_m3, Uncertain(2400));
  EXPECT_EQ(s.grains->diameter_m, Uncertain(3));
  EXPECT_EQ(*s.grains->friction_angle_deg, Uncertain(24));
  EXPECT_EQ(s.grains->cohesion_pa, Uncertain(5000));
  EXPECT_EQ(s.grains->solid_fraction.distribution->mode, 0.70);
  // Between what the paper computes with and the published H/L.
  EXPECT_EQ(s.basal.friction_coefficient.distribution->mean, 0.30);
  EXPECT_LT(*s.basal.friction_coefficient.distribution->min, 0.24);
  EXPECT_GT(*s.basal.friction_coefficient.distribution->max, 305.0 / 840);
  EXPECT_FALSE(s.numerics.end_time_s) << "the shipped case runs to rest";
  EXPECT_LE(s.numerics.spacing_m, 28.0 / 3) << "three particles over the mean thickness";
}

TEST(ScenarioFile, AMissingFileIsSaid) {
  EXPECT_THROW(read_scenario("no/such/scenario.yaml"), SetupError);
}

TEST(ScenarioFile, AHugeFileIsRefusedBeforeItIsRead) {
  const fs::path path = fs::path(::testing::TempDir()) / "sturz_huge_scenario.yaml";
  std::ofstream(path) << "title: x\n";
  fs::resize_file(path, std::uintmax_t{1} << 40);  // sparse: no disk is used
  try {
    read_scenario(path);
    FAIL();
  } catch (const ScenarioError& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("1099511627776 bytes long (a scenario file may have 65536)"));
  }
  fs::remove(path);
}

}  // namespace
}  // namespace sturz
