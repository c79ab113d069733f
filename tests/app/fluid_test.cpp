// SPDX-License-Identifier: Apache-2.0
// A liquid in three dimensions as its users meet it: alone, and in the pores of grains.
#include "tests/app/app_fixture.hpp"

#include <cmath>

namespace sturz::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// 300 m3 on a slope of 15 degrees, 700 particles of each set, three seconds.
constexpr const char* slope = R"(title: Small flow
terrain: {synthetic: {plane: {cell_size_m: 2, slope_deg: 15, length_m: 100, width_m: 50}}}
release: {box: {x_m: [-30, -20], y_m: [-5, 5]}, thickness_m: 3}
numerics: {spacing_m: 0.75, end_time_s: 3}
hazard: {cell_size_m: 2, thickness_m: [0.5]}
ensemble: {members: 2, design: latin_hypercube, seed: 1}
)";
constexpr const char* mud =
    "fluid: {density_kg_m3: 1500, yield_stress_pa: {uniform: [200, 400]}, viscosity_pa_s: 20}\n";
constexpr const char* slurry = R"(grains:
  {density_kg_m3: 2600, diameter_m: 0.1, solid_fraction: {uniform: [0.50, 0.55]},
   friction_angle_deg: 30}
fluid: {density_kg_m3: 1100, viscosity_pa_s: 0.01}
coupling: {drag_diameter_m: 0.005}
basal: {friction_coefficient: 0.5}
)";

class Fluid : public App {
 protected:
  Ended run(const std::string& scene, const std::string& out, const std::string& threads) const {
    write("flow.yaml", scene);
    return sturz({"run", path("flow.yaml"), "-o", path(out), "--json", "--threads", threads,
                  "--particles", "1"});
  }
  /// Runs on one and on two threads. \return the scalars
  nlohmann::json scalars_of(const std::string& scene) const {
    const Ended one = run(scene, "one", "1"), two = run(scene, "two", "2");
    EXPECT_EQ(one.exit_code, 0) << one.err;
    const nlohmann::json a = event(one, "done"), b = event(two, "done");
    EXPECT_EQ(a.value("state_hash", "a"), b.value("state_hash", "b"));
    EXPECT_EQ(a.value("outcome", ""), "out_of_time") << a.value("reason", "");
    return a.at("scalars");
  }
};

TEST_F(Fluid, AMudFlowRunsAndKeepsItsMass) {
  const nlohmann::json m = scalars_of(std::string(slope) + mud);
  EXPECT_NEAR(m.value("released_mass_kg", 0.0), 1500 * 300, 1e-6 * 1500 * 300);
  EXPECT_LE(std::abs(m.value("mass_error", 1.0)), 1e-12);
  EXPECT_GT(m.value("com_travel_m", 0.0), 1);
  EXPECT_LT(m.value("max_speed_m_s", 1e9), 30);
  EXPECT_FALSE(m.at("energy_residual").is_null());
  EXPECT_TRUE(m.at("solid_runout_m").is_null()) << "one material has no phases";
  EXPECT_FALSE(m.contains("liquid_lost_fraction"));
  EXPECT_TRUE(exists("one/particles/particles.pvd"));
}

TEST_F(Fluid, ASaturatedSlideRunsAndTellsItsMaterialsApart) {
  const nlohmann::json m = scalars_of(std::string(slope) + slurry);
  const double fraction = 0.525, wet = 300 * (fraction * 2600 + (1 - fraction) * 1100);
  EXPECT_NEAR(m.value("released_mass_kg", 0.0), wet, 1e-6 * wet);
  for (const char* error : {"mass_error", "solids_error", "water_error"})
    EXPECT_LE(std::abs(m.value(error, 1.0)), 1e-12) << error;
  for (const char* extent :
       {"solid_runout_m", "liquid_runout_m", "max_solid_thickness_m", "max_liquid_thickness_m",
        "drag_loss_fraction", "solid_reached_area_m2", "liquid_reached_area_m2",
        "max_solid_pressure_pa", "max_liquid_pressure_pa"})
    EXPECT_GT(m.value(extent, -1.0), 0) << extent;
  const double both = m.value("max_thickness_m", 0.0);
  EXPECT_LT(m.value("max_solid_thickness_m", 1e9), 0.75 * both);
  EXPECT_THAT(read("one/particles/particles.pvd"), HasSubstr("liquid"));
}

TEST_F(Fluid, MapsOfAnEnsembleShowBoth) {
  write("flow.yaml", std::string(slope) + slurry);
  const Ended ended = sturz({"ensemble", path("flow.yaml"), "-o", path("out")});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_TRUE(exists("out/hazard/solid_thickness_mean_m.tif"));
  EXPECT_TRUE(exists("out/hazard/P_liquid_thickness_gt_0.5m.tif"));
  EXPECT_THAT(read("out/report.html"), HasSubstr("Thickness of liquid alone"));
}

TEST_F(Fluid, WhatIsNotPhysicsIsSaidByDescribeAndEveryResult) {
  write("flow.yaml", std::string(slope) + slurry);
  const Ended plain = sturz({"describe", path("flow.yaml")});
  ASSERT_EQ(plain.exit_code, 0) << plain.err;
  EXPECT_THAT(plain.out, HasSubstr("effect grains in liquid: on (`coupling`: drag and buoyancy"));
  EXPECT_THAT(plain.out + plain.err, Not(HasSubstr("counted twice")));
  const std::vector<std::string> as_published = {
      "--set", "coupling.scheme=paper",      "--set", "basal.pore_pressure_ratio=0.2",
      "--set", "coupling.drag_multiplier=5", "--set", "numerics.end_time_s=0.1"};
  std::vector<std::string> words{"run", path("flow.yaml"), "-o", path("paper")};
  words.insert(words.end(), as_published.begin(), as_published.end());
  const Ended paper = sturz(words);
  ASSERT_EQ(paper.exit_code, 0) << paper.err;
  for (const char* said : {"counted twice", "multiplied by 5"}) {
    EXPECT_THAT(paper.out + paper.err, HasSubstr(said));
    EXPECT_THAT(read("paper/report.html"), HasSubstr(said));
  }
}

/// Ground from 13.4 m in the west to -13.4 m in the east.
constexpr const char* lake =
    "{\"type\": \"FeatureCollection\", \"features\": [{\"type\": "
    "\"Feature\", \"properties\": {}, \"geometry\": {\"type\": "
    "\"Polygon\", \"coordinates\": [[[20, -10], [40, -10], [40, 10], "
    "[20, 10], [20, -10]]]}}]}";

TEST_F(Fluid, APoolIsOutlinedByAPolygonAndNamedByDescribe) {
  write("lake.geojson", lake);
  write("flow.yaml", std::string(slope) +
                         "fluid: {viscosity_pa_s: 1, pool: {surface_m: -4, polygon: "
                         "lake.geojson}}\n");
  const Ended ended = sturz({"describe", path("flow.yaml")});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  // 20 m x 20 m under a mean of tan 15 x 30 - 4 m.
  EXPECT_THAT(ended.out, HasSubstr("`fluid.pool`: standing water up to -4 m, 16"));
  EXPECT_THAT(ended.out, HasSubstr(" m3 on 400 m2 with what lies in it"));
  EXPECT_THAT(ended.out + ended.err, HasSubstr("open water: along "));
}

TEST_F(Fluid, APoolThatTheGroundDoesNotHoldIsRefusedAtItsKey) {
  write("lake.geojson", lake);
  const auto refusal = [&](const std::string& pool) {
    write("flow.yaml", std::string(slope) + "fluid:\n  viscosity_pa_s: 1\n  pool:\n    " + pool);
    const Ended ended = sturz({"describe", path("flow.yaml")});
    EXPECT_EQ(ended.exit_code, 1) << pool;
    return ended.err;
  };
  EXPECT_THAT(refusal("surface_m: -30\n"),
              HasSubstr("flow.yaml:10:16: fluid.pool.surface_m = -30 (the ground there lies at "));
  EXPECT_THAT(refusal("surface_m: -4\n"),
              HasSubstr("flow.yaml:10:16: fluid.pool.surface_m = -4 (the pool reaches the end"));
  EXPECT_THAT(refusal("surface_m: {uniform: [-9.5, -4]}\n    polygon: lake.geojson\n"),
              HasSubstr("fluid.pool.surface_m = -9.5 (1."));
  EXPECT_THAT(refusal("surface_m: -4\n    box: {x_m: [20, 70], y_m: [-10, 10]}\n"),
              HasSubstr("flow.yaml:11:10: fluid.pool.box: reaches 20 m beyond the terrain"));
  EXPECT_THAT(refusal("polygon: lake.geojson\n"),
              HasSubstr("fluid.pool.surface_m (missing: how high does the water stand?)"));
  write("flow.yaml", std::string(slope) + "pool: {surface_m: 3}\n");
  EXPECT_EQ(sturz({"describe", path("flow.yaml")}).exit_code, 1) << "it belongs to `fluid`";
}

TEST_F(Fluid, ColumnsAreRefusedWithLineAndCure) {
  write("flow.yaml", std::string(slope) + mud + "formulation: depth_averaged\n");
  const Ended ended = sturz({"describe", path("flow.yaml")});
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.err, HasSubstr("flow.yaml:7"));
  EXPECT_THAT(ended.err, HasSubstr("only full_stress knows a liquid"));
  EXPECT_THAT(ended.err, HasSubstr("basal.viscosity_pa_s"));
}

}  // namespace
}  // namespace sturz::test
