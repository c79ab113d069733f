// SPDX-License-Identifier: Apache-2.0
// Files of inflow, of releases that start at different times, and of gauges.
#include "io/gdal/gdal_vector.hpp"
#include "io/site/scene_inputs.hpp"
#include "scenarios/assembly/assemble.hpp"
#include "tests/io/io_fixture.hpp"

#include <cmath>
#include <numeric>

namespace sturz::test {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class FlowInputs : public IoTest {
 protected:
  FlowInputs() {
    scene.directory = folder().string();
    scene.terrain.raster = "bed.tif";
    Raster<double> slope(Grid{50, 40, 500000, 4600400, 10, "EPSG:32633"});
    for (int r = 0; r < 40; ++r)
      for (int c = 0; c < 50; ++c) slope.at(r, c) = 1000 - 2.0 * c;  // down to the east
    write_raster(
        path("bed.tif"),
        {50, 40, {500000, 10, 0, 4600400, 0, -10}, "EPSG:32633", {}, slope.values, "", false});
    write("flood.csv", "time_s,discharge_m3_s\n0,10\n20,10\n");
    scene.grains.emplace();
    scene.numerics.spacing_m = 2;
  }
  InflowSpec from(const char* line) const {
    InflowSpec source;
    source.hydrograph = "flood.csv";
    source.line = line;
    return source;
  }
  std::string refusal() const {
    return message_of([&] { load_scene_inputs(scene); });
  }
  Scenario scene;
};

TEST_F(FlowInputs, AnInflowNeedsNoRelease) {
  write("gate.geojson", collection(feature("LineString", "[[500100,4600150],[500100,4600170]]")));
  scene.inflow = {from("gate.geojson")};
  const SceneInputs in = load_scene_inputs(scene);
  ASSERT_EQ(in.inflow.size(), 1u);
  ASSERT_EQ(in.inflow[0].lines.size(), 1u);
  EXPECT_EQ(in.inflow[0].lines[0][1], Vec2(500100, 4600170));
  EXPECT_NEAR(in.inflow[0].hydrograph.total_m3(), 200, 1e-12);
  EXPECT_EQ(std::accumulate(in.release->values.begin(), in.release->values.end(), 0.0), 0);
  EXPECT_EQ(in.identities.size(), 3u) << "hydrograph, line, terrain";
  EXPECT_THAT(in.notes, Contains(HasSubstr("2 rows, 200 m3 from 0 to 20 s, at most 10 m3/s")));
  const SceneDescription d = describe(scene, in);
  EXPECT_EQ(d.formulation, "depth_averaged");
  EXPECT_NEAR(d.inflow_volume_m3, 200, 1e-9);
  EXPECT_GT(d.n_particles, 20u);
  EXPECT_GT(d.end_time_s, 20) << "the time counts from the last inflow";
  const auto said = [&](const EffectNote& e) { return e.name == "inflow" && e.active; };
  const auto row = std::find_if(d.effects.begin(), d.effects.end(), said);
  ASSERT_NE(row, d.effects.end());
  EXPECT_THAT(row->reason, HasSubstr("1 source, 200 m3 from 0"));
  const MemberResult m = assemble(scene, in, 0, 1).run();
  EXPECT_TRUE(is_valid(m.outcome)) << m.reason;
  EXPECT_NEAR(m.scalars.inflow_volume_m3, 200, 1e-9);
  EXPECT_LT(std::abs(m.scalars.mass_error), 1e-12);
  const auto& deposit = m.layer(PeakLayer::deposit);
  EXPECT_NEAR(100 * std::accumulate(deposit.begin(), deposit.end(), 0.0), 200, 1e-3);
}

TEST_F(FlowInputs, SaysWhatIsTooNarrowAndWhatComesTooLate) {
  InflowSpec source = from("");
  source.line_m = {{500100, 4600150}, {500100, 4600155}};
  scene.inflow = {source};
  scene.numerics.end_time_s = 15;
  const SceneInputs in = load_scene_inputs(scene);
  const auto said = describe(scene, in).warnings;
  EXPECT_THAT(said, Contains(AllOf(HasSubstr("unresolved inflow: 2.5 spacings of 2 m"),
                                   HasSubstr("spacing_m of 1.2 m or less"))));
  EXPECT_THAT(said, Contains(HasSubstr("m3 start or enter after the end at 15 s")));
  const MemberResult m = assemble(scene, in, 0, 1).run();
  EXPECT_TRUE(is_moving(m.censoring));
  EXPECT_THAT(m.warnings, HasSubstr("m3 were still to enter when the member was stopped"));
  EXPECT_NEAR(m.scalars.inflow_volume_m3, 150, 20);
}

TEST_F(FlowInputs, FaultsOfAHydrographHaveFileAndLine) {
  write("flood.csv", "time_s,discharge_m3_s\n0,10\n20,x\n10,-1\n");
  InflowSpec source = from("");
  source.line_m = {{500100, 4600150}, {500100, 4600170}};
  scene.inflow = {source, source};
  scene.inflow[1].hydrograph = "floood.csv";
  EXPECT_THAT(refusal(),
              AllOf(HasSubstr("inflow[0].hydrograph = flood.csv:3: 'x' in column"),
                    HasSubstr("inflow[0].hydrograph = flood.csv:4: discharge = -1"),
                    HasSubstr("inflow[1].hydrograph = floood.csv"), HasSubstr("flood.csv")));
}

TEST_F(FlowInputs, PlacesAreChecked) {
  InflowSpec source = from("");
  source.line_m = {{500100, 4600150}, {500100, 4700000}};
  scene.inflow = {source};
  EXPECT_THAT(refusal(),
              HasSubstr("inflow[0].line_m: lies outside the terrain (x 500100, y 4700000"));
  write("gate.geojson", collection(feature("Polygon", "[" + square(100, 150, 20) + "]")));
  scene.inflow = {from("gate.geojson")};
  EXPECT_THAT(refusal(), HasSubstr("inflow[0].line = gate.geojson: holds a polygon (a line is"));
  write("flood.csv", "time_s,discharge_m3_s,solid_fraction\n0,10,0.5\n20,10,0.5\n");
  EXPECT_THAT(refusal(), HasSubstr("solid_fraction (there is no mixture"));
}

TEST_F(FlowInputs, LevelGroundSaysNoDirection) {
  write_raster(path("bed.tif"), {50,
                                 40,
                                 {500000, 10, 0, 4600400, 0, -10},
                                 "EPSG:32633",
                                 {},
                                 std::vector<double>(2000, 7.0),
                                 "",
                                 false});
  InflowSpec source = from("");
  source.line_m = {{500100, 4600150}, {500100, 4600170}};
  scene.inflow = {source};
  const SceneInputs in = load_scene_inputs(scene);
  EXPECT_THAT(message_of([&] { describe(scene, in); }), HasSubstr("Give direction_deg"));
  scene.inflow[0].direction_deg = Uncertain(90);
  EXPECT_NO_THROW(describe(scene, in));
}

TEST_F(FlowInputs, PolygonsStartWhenTheirFieldSays) {
  scene.release.polygon = "source.geojson";
  scene.release.thickness_attribute = "h";
  scene.release.start_time_attribute = "t0";
  write("source.geojson",
        collection(
            feature("Polygon", "[" + square(100, 100, 40) + "]", R"({"h": 1, "t0": 0})") + "," +
            feature("Polygon", "[" + square(140, 100, 40) + "]", R"({"h": 2, "t0": 12.5})")));
  const SceneInputs in = load_scene_inputs(scene);
  ASSERT_EQ(in.release_starts.size(), 2u);
  EXPECT_EQ(in.release_starts[1].start_s, 12.5);
  const MemberResult m = assemble(scene, in, 0, 1).run();
  EXPECT_NEAR(m.scalars.release_volume_m3, 40 * 40 * 3, 1e-6);
  EXPECT_NEAR(m.scalars.released_mass_kg, m.scalars.release_volume_m3 * 1560, 1e-3);
  EXPECT_LT(std::abs(m.scalars.mass_error), 1e-12);
  EXPECT_GT(m.scalars.end_time_s, 12.5);
  write("source.geojson",
        collection(feature("Polygon", "[" + square(100, 100, 40) + "]", R"({"h": 1, "t0": -1})")));
  EXPECT_THAT(refusal(), HasSubstr("feature 0 has t0 = -1 (a start must be in 0..1e5 s)"));
}

TEST_F(FlowInputs, GaugesComeFromFilesAndFromTheScene) {
  scene.release.box = ReleaseBox{{500050, 500090}, {4600100, 4600140}};
  scene.release.thickness_m = Uncertain(1);
  scene.gauges.emplace();
  scene.gauges->points = {{"house", {{{500200, 4600120}}}}};
  scene.gauges->file = "gauges.geojson";
  write("gauges.geojson",
        collection(
            feature("LineString", "[[500150,4600000],[500150,4600300]]", R"({"name": "road"})") +
            "," + feature("Point", "[500160,4600120]", R"({"name": "well"})")));
  const SceneInputs in = load_scene_inputs(scene);
  ASSERT_EQ(in.gauge_points.size(), 2u);
  EXPECT_EQ(in.gauge_points[1].name, "well");
  ASSERT_EQ(in.gauge_lines.size(), 1u);
  EXPECT_EQ(in.gauge_lines[0].name, "road");
  scene.gauges->points[0].name = "road";
  EXPECT_THAT(refusal(), HasSubstr("the name road stands there twice"));
  scene.gauges->points[0].name = "house";
  scene.gauges->name_attribute = "nam";
  EXPECT_THAT(refusal(), HasSubstr("has no field 'nam' with names. It has: name."));
}

}  // namespace
}  // namespace sturz::test
