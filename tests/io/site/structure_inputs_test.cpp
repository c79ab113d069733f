// SPDX-License-Identifier: Apache-2.0
// Dams and buildings from their files to the ground of a scene.
#include "io/scenario/scenario_file.hpp"
#include "io/site/map_ground.hpp"
#include "io/site/scene_inputs.hpp"
#include "scenarios/assembly/ground.hpp"
#include "scenarios/checks/validate.hpp"
#include "tests/io/io_fixture.hpp"
#include "tests/support/distributions.hpp"

#include <algorithm>
#include <cmath>

namespace sturz::test {
namespace {

using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class StructureInputs : public SceneOnAPlane {
 protected:
  /// The plane is 100 + column - 2 row on cells of 10 m.
  static double bare(int row, int col) { return 100 + col - 2 * row; }
  DamSpec& inline_dam(double height = 8) {
    DamSpec& dam = scene.terrain.dams.emplace_back();
    dam.points_m = {{500105, 4600305}, {500305, 4600305}};  // along the centres of row 9
    dam.height_m = Uncertain(height);
    dam.crest_width_m = 20;
    return dam;
  }
  void houses(const std::string& features) {
    write("houses.geojson", collection(features));
    scene.terrain.buildings.emplace().polygon = "houses.geojson";
  }
  static std::string house(double x, double y, double edge, const std::string& properties = "{}") {
    std::string rings = "[";
    rings += square(x, y, edge);
    return feature("Polygon", rings + "]", properties);
  }
  std::string refusal() const {
    return message_of([&] { load_scene_inputs(scene); });
  }
  void line_file(const std::string& features, const std::string& crs = "EPSG::32633") {
    write("dam.geojson", collection(features, crs));
    DamSpec& dam = scene.terrain.dams.emplace_back();
    dam.line = "dam.geojson", dam.height_m = Uncertain(8);
  }
  std::vector<std::string> complaints() const {
    std::vector<std::string> all;
    for (const Problem& p : validate(scene))
      if (p.path.starts_with("terrain.")) all.push_back(p.message);
    return all;
  }
};

TEST_F(StructureInputs, WithoutThemTheGroundIsAsItWas) {
  const SceneInputs in = load_scene_inputs(scene);
  EXPECT_FALSE(in.structures.any());
  EXPECT_EQ(in.structures.site.values.size(), 0U);
  EXPECT_EQ(in.elevation->at(9, 20), bare(9, 20));
}

TEST_F(StructureInputs, AnInlineDamIsRaised) {
  inline_dam();
  const SceneInputs in = load_scene_inputs(scene);
  EXPECT_NEAR(in.elevation->at(9, 20), bare(9, 20) + 8, 1e-9);
  EXPECT_NEAR(in.elevation->at(8, 20), bare(9, 20) + 8, 1e-9) << "the flat crest, 10 m away";
  // 20 m away, 10 m beyond the crest's edge: 10/1.5 lower than the crest.
  EXPECT_NEAR(in.elevation->at(11, 20), bare(9, 20) + 8 - 10 / 1.5, 1e-9);
  EXPECT_EQ(in.elevation->at(15, 20), bare(15, 20));
  EXPECT_THAT(in.notes, Contains(AllOf(StartsWith("terrain.dams[0]: 200 m long, crest 20 m wide at "
                                                  "100 to 120 m, sides 1 in 1.5; "),
                                       HasSubstr("cells raised by up to 10 m, fill "))));
  ASSERT_NE(in.ground, nullptr);
  EXPECT_NEAR(in.ground->node(9, 20), bare(9, 20) + 8, 1e-9);
}

TEST_F(StructureInputs, LinesInAnotherSystemWithHeightsOfTheirOwn) {
  line_file(
      feature("LineString", "[[15.0012588,41.5543],[15.0036588,41.5543]]", R"({"h": 8})") + "," +
          feature("MultiLineString", "[[[15.0012588,41.5525],[15.0024,41.5525]]]", R"({"h": 3.5})"),
      "OGC:1.3:CRS84");
  scene.terrain.dams[0].height_m.reset();
  scene.terrain.dams[0].height_attribute = "h";
  const SceneInputs in = load_scene_inputs(scene);
  ASSERT_EQ(in.structures.dams.size(), 2U);
  EXPECT_EQ(in.structures.dams[0].height_m, 8);
  EXPECT_EQ(in.structures.dams[1].height_m, 3.5);
  EXPECT_NEAR(in.structures.dams[0].points[0].x(), 500105, 2);
  EXPECT_NEAR(in.structures.dams[0].points[0].y(), 4600290, 20);
  EXPECT_THAT(in.notes, Contains(HasSubstr("dam.geojson: reprojected from WGS 84")));
  EXPECT_THAT(in.notes, Contains(StartsWith("terrain.dams[0] feature 1: ")));
  EXPECT_EQ(in.identities.at(1).role, "terrain.dams[0].line");
}

TEST_F(StructureInputs, AHeightIsComparedWithTheFile) {
  line_file(feature("LineString", "[[500105,4600305],[500305,4600305]]", R"({"h": 8})"));
  scene.terrain.dams[0].height_m.reset();
  scene.terrain.dams[0].height_attribute = "h";
  const auto was = load_scene_inputs(scene).identities;
  write("dam.geojson",
        collection(feature("LineString", "[[500105,4600305],[500305,4600305]]", R"({"h": 9})")));
  EXPECT_THAT(input_differences(was, load_scene_inputs(scene).identities),
              ElementsAre(StartsWith("input terrain.dams[0].line = dam.geojson: other polygons or "
                                     "values than before")));
}

TEST_F(StructureInputs, WhatIsWrongWithALineIsNamed) {
  line_file(feature("LineString", "[[500105,4600305],[500905,4600305]]"));
  EXPECT_EQ(
      refusal(),
      "terrain.dams[0]: 41 of 81 points along its line lie on no known ground, the first at x "
      "500505, y 4600305 (terrain x 500000 to 500500, y 4600000 to 4600400). Shorten the line "
      "or fill the terrain.");
  write("dam.geojson", collection(feature("Point", "[500105,4600305]")));
  EXPECT_THAT(refusal(), HasSubstr("feature 0 is a Point, not a line. Draw the dam as a line"));
  write("dam.geojson", collection(feature("LineString", "[[500105,4600305],[500105,4600305]]")));
  EXPECT_THAT(refusal(), HasSubstr("its line has no length"));
  write("dam.geojson", collection(""));
  EXPECT_THAT(refusal(), HasSubstr("has no features (an empty dam)"));
  scene.terrain.dams[0].height_m.reset();
  scene.terrain.dams[0].height_attribute = "h";
  write("dam.geojson",
        collection(feature("LineString", "[[500105,4600305],[500305,4600305]]", R"({"k": 1})")));
  EXPECT_THAT(refusal(), HasSubstr("has no field 'h' (height_attribute). It has: k."));
  write("dam.geojson",
        collection(feature("LineString", "[[500105,4600305],[500305,4600305]]", R"({"h": -1})")));
  EXPECT_THAT(refusal(), HasSubstr("height of feature 0 is -1 (must be > 0 and <= 200 m)"));
}

TEST_F(StructureInputs, LinesBeyondTheEarthAreRefused) {
  for (const char* corner : {"[1e300,4600305]", "[500105,-1e18]", "[1e10,1e10]"}) {
    scene.terrain.dams.clear();
    line_file(feature("LineString", std::string("[[500105,4600305],") + corner + "]"));
    EXPECT_THAT(refusal(), HasSubstr("(no place on the earth). Draw it again.")) << corner;
  }
  scene.terrain.dams.clear();
  line_file(feature("LineString", "[[500105,4600305],[9e8,4600305]]"));
  EXPECT_THAT(refusal(), AnyOf(HasSubstr("lie on no known ground"), HasSubstr("too long")));
}

TEST_F(StructureInputs, FilesAreLookedAtInOneRound) {
  line_file(feature("Point", "[500105,4600305]"));
  houses(feature("Point", "[500105,4600305]"));
  scene.basal.rasters.friction_coefficient.path = "no.tif";
  EXPECT_THAT(refusal(),
              AllOf(HasSubstr("dam.geojson: feature 0 is a Point"),
                    HasSubstr("houses.geojson: feature 0 is a Point"), HasSubstr("no.tif")));
  std::filesystem::remove(path("bed.tif"));
  EXPECT_THAT(refusal(),
              AllOf(HasSubstr("dam.geojson: feature 0 is a Point"),
                    HasSubstr("houses.geojson: feature 0 is a Point"), HasSubstr("bed.tif")));
}

TEST_F(StructureInputs, KeysThatExcludeEachOtherAreNamed) {
  scene.grains.emplace().friction_angle_deg = Uncertain(30);
  scene.numerics.spacing_m = 5;
  DamSpec& dam = scene.terrain.dams.emplace_back();
  EXPECT_THAT(complaints(), ElementsAre(HasSubstr("terrain.dams[0] (where is it?)"),
                                        HasSubstr("terrain.dams[0] (how high is it?)")));
  dam.line = "dam.gpkg", dam.points_m = {{0, 0}, {1, 0}};
  dam.height_m = Uncertain(3), dam.crest_elevation_m = Uncertain(700);
  EXPECT_THAT(complaints(), ElementsAre(HasSubstr("line and points_m both say where"),
                                        HasSubstr("more than one of height_m")));
  dam = {};
  dam.points_m = {{0, 0}}, dam.height_m = Uncertain(-3), dam.side_slope = 20;
  const auto wrong = complaints();
  EXPECT_THAT(wrong, Contains(HasSubstr("terrain.dams[0].height_m = -3 (must be > 0 and <= 200)")));
  EXPECT_THAT(wrong, Contains(HasSubstr("terrain.dams[0].side_slope = 20 (must be in 0..10)")));
  EXPECT_THAT(wrong,
              Contains(HasSubstr("terrain.dams[0].points_m (a line has two corners or more)")));
  scene.terrain.dams.clear();
  scene.terrain.buildings.emplace();
  EXPECT_THAT(complaints(), ElementsAre(HasSubstr("terrain.buildings (polygon is missing)")));
}

TEST_F(StructureInputs, AnUncertainDamIsRaisedByEachMember) {
  DamSpec& dam = inline_dam();
  dam.height_m->distribution = bounded(Distribution::Kind::uniform, 4, 10);
  scene.numerics.spacing_m = 25;
  const auto keys = uncertain_keys(scene);
  ASSERT_EQ(keys.size(), 1U);
  EXPECT_EQ(keys[0].path, "terrain.dams[0].height_m");
  EXPECT_EQ(keys[0].units, "m");
  const SceneInputs in = load_scene_inputs(scene);
  EXPECT_EQ(in.elevation->at(9, 20), bare(9, 20)) << "members share the ground without it";
  EXPECT_EQ(in.ground, nullptr);
  EXPECT_THAT(in.notes, Contains(HasSubstr("its height drawn for each member")));
  const Scenario low = with_value(scene, keys[0].path, 5),
                 high = with_value(scene, keys[0].path, 9);
  EXPECT_NEAR(scene_ground(low, in, {}, false).node(9, 20), bare(9, 20) + 5, 1e-9);
  EXPECT_NEAR(scene_ground(high, in, {}, false).node(9, 20), bare(9, 20) + 9, 1e-9);
  const Terrain columns = scene_ground(high, in, {}, true);
  EXPECT_EQ(columns.grid().cell_m, 20);
  EXPECT_GT(columns.curved(500205, 4600305).z, bare(9, 20) + 8.5);
  // The relief of a map shows it at the middle of its range.
  const Grid whole = in.terrain_grid();
  EXPECT_NEAR(ground_of_map(scene, in, whole)->at(9, 20), bare(9, 20) + 7, 1e-9);
}

TEST_F(StructureInputs, CellsOfBuildingsStandAboveTheGround) {
  houses(house(100, 100, 30, R"({"h": 6})") + "," + house(120, 120, 30, R"({"h": 12})") + "," +
         house(202, 202, 2, R"({"h": 5})"));
  SceneInputs in = load_scene_inputs(scene);
  // South-west corner 500100, 4600100: columns 10 to 12, rows 27 to 29.
  EXPECT_EQ(in.elevation->at(29, 10), bare(29, 10) + 10);
  EXPECT_EQ(in.elevation->at(29, 13), bare(29, 13));
  EXPECT_THAT(in.notes,
              Contains("terrain.buildings.polygon = houses.geojson: 2 buildings on 18 cells "
                       "of 10 m, up to 10 m high"));
  EXPECT_THAT(in.warnings, Contains(HasSubstr("1 of 3 buildings hold the centre of no cell")));
  scene.terrain.buildings->height_attribute = "h";
  in = load_scene_inputs(scene);
  EXPECT_EQ(in.elevation->at(29, 10), bare(29, 10) + 6);
  EXPECT_EQ(in.elevation->at(27, 12), bare(27, 12) + 12) << "the higher of two";
  scene.terrain.buildings->height_attribute = "k";
  EXPECT_THAT(refusal(), HasSubstr("has no field 'k'"));
}

TEST_F(StructureInputs, AScenarioWrittenElsewhereGivesTheSameGround) {
  line_file(feature("LineString", "[[500105,4600305],[500305,4600305]]"));
  scene.terrain.dams[0].side_slope = 2.25;
  inline_dam(3).points_m.push_back({500350.5, 4600310});
  houses(house(100, 100, 30));
  scene.grains.emplace().friction_angle_deg = Uncertain(30);
  scene.numerics.spacing_m = 5;
  const auto elsewhere = folder() / "out" / "run";
  std::filesystem::create_directories(elsewhere);
  const Scenario again =
      read_scenario_text(write_scenario(scene, elsewhere), "scenario.yaml", elsewhere);
  EXPECT_EQ(again.terrain.dams[0].line, "../../dam.geojson");
  EXPECT_EQ(again.terrain.dams[1], scene.terrain.dams[1]);
  EXPECT_EQ(load_scene_inputs(scene).elevation->values, load_scene_inputs(again).elevation->values);
}

TEST_F(StructureInputs, UnknownNamesOfADamAreToldWithTheirLine) {
  const auto read = [&](const std::string& dam) {
    return message_of([&] {
      read_scenario_text("terrain:\n  raster: bed.tif\n  dams:\n    - " + dam + "\n", "scene.yaml",
                         folder());
    });
  };
  EXPECT_THAT(
      read("{line: a.gpkg, hight_m: 3}"),
      AllOf(HasSubstr("scene.yaml:4"), HasSubstr("terrain.dams[0].hight_m (unknown key). Did "
                                                 "you mean height_m?")));
  EXPECT_THAT(
      read("{points_m: [[1, 2], [3]], height_m: low}"),
      AllOf(HasSubstr("terrain.dams[0].points_m"), HasSubstr("terrain.dams[0].height_m = low")));
}

}  // namespace
}  // namespace sturz::test
