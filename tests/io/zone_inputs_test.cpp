// SPDX-License-Identifier: Apache-2.0
// Zones of the bed from their files to the terrain's cells.
#include "io/scenario/scenario_file.hpp"
#include "io/site/scene_inputs.hpp"
#include "tests/io/io_fixture.hpp"

#include <algorithm>

namespace sturz::test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string polygons(const std::string& rings, const std::string& crs = "EPSG::32633") {
  return collection(feature("Polygon", "[" + rings + "]"), crs);
}

class ZoneInputs : public SceneOnAPlane {
 protected:
  void add_zone(const std::string& file, const std::string& text, const std::string& layer = "") {
    write(file, text);
    scene.basal.zones.push_back({file, layer, 0.3, {}, {}});
  }
  std::string refusal() const {
    return message_of([&] { load_scene_inputs(scene); });
  }
  static std::int64_t count(const SceneInputs& in, int zone) {
    return std::count(in.zones->values.begin(), in.zones->values.end(), zone);
  }
};

TEST_F(ZoneInputs, WithoutZonesThereIsNoRaster) {
  EXPECT_EQ(load_scene_inputs(scene).zones, nullptr);
}

TEST_F(ZoneInputs, CellsBelongByTheirCentres) {
  add_zone("plate.geojson", polygons(square(104, 104, 50)));  // 50 x 50 m, centres from 105 to 145
  const SceneInputs in = load_scene_inputs(scene);
  ASSERT_NE(in.zones, nullptr);
  EXPECT_TRUE(in.zones->grid.same_place(in.elevation->grid));
  EXPECT_EQ(count(in, 1), 25);
  EXPECT_EQ(count(in, 0), 2000 - 25);
  EXPECT_EQ(in.zones->at(in.zones->grid.row_of(4600105), 10), 1);
  EXPECT_EQ(in.zones->at(in.zones->grid.row_of(4600155), 15), 0);
  EXPECT_THAT(in.notes, Contains("basal.zones[0] plate.geojson: 25 cells, 2500 m2"));
}

TEST_F(ZoneInputs, TheLaterOfTwoHolds) {
  add_zone("wide.geojson", polygons(square(100, 100, 100)));
  add_zone("small.geojson", polygons(square(150, 150, 100)));
  SceneInputs in = load_scene_inputs(scene);
  EXPECT_EQ(count(in, 1), 75);
  EXPECT_EQ(count(in, 2), 100);
  EXPECT_THAT(in.notes, Contains("basal.zones[0] wide.geojson: 100 cells, 10000 m2"));
  EXPECT_THAT(in.notes, Contains("basal.zones[1] small.geojson: 100 cells, 10000 m2"));
  std::swap(scene.basal.zones[0], scene.basal.zones[1]);
  in = load_scene_inputs(scene);
  EXPECT_EQ(count(in, 1), 75);
  EXPECT_EQ(in.zones->at(in.zones->grid.row_of(4600155), 15), 2);
}

TEST_F(ZoneInputs, HolesAndSeveralFeaturesOfALayer) {
  const auto list = [](std::string rings) { return rings.insert(0, 1, '[').append(1, ']'); };
  const std::string ring = feature("Polygon", list(square(0, 0, 50) + "," + square(10, 10, 30)));
  const std::string overlapping = feature("Polygon", list(square(40, 0, 50)));
  add_zone("many.geojson", collection(ring + "," + overlapping));
  const SceneInputs in = load_scene_inputs(scene);
  EXPECT_EQ(count(in, 1), (25 - 9) + 25 - 5);
  EXPECT_EQ(in.zones->at(37, 2), 0) << "the hole";
  EXPECT_EQ(in.zones->at(37, 4), 1) << "where the two overlap";
}

TEST_F(ZoneInputs, PolygonsInAnotherSystemAreReprojected) {
  // The rectangle 500000..500200 x 4600000..4600150 of UTM 33, in degrees.
  add_zone("degrees.geojson",
           polygons("[[15.0,41.5516645],[15.0023982,41.5516645],[15.0023982,41.5530156],"
                    "[15.0,41.5530156],[15.0,41.5516645]]",
                    "OGC:1.3:CRS84"));
  const SceneInputs in = load_scene_inputs(scene);
  EXPECT_EQ(count(in, 1), 20 * 15);
  EXPECT_EQ(in.zones->at(39, 19), 1);
  EXPECT_EQ(in.zones->at(24, 0), 0);
  EXPECT_THAT(in.notes, Contains(StartsWith("basal.zones[0].polygon = degrees.geojson: reprojected "
                                            "from WGS 84")));
  EXPECT_THAT(in.notes, Contains("basal.zones[0] degrees.geojson: 300 cells, 30000 m2"));
}

TEST_F(ZoneInputs, WhatLiesBeyondTheTerrainIsLeftOut) {
  add_zone("wide.geojson", polygons(square(-1000, 350, 5000)));
  EXPECT_EQ(count(load_scene_inputs(scene), 1), 50 * 5);
}

TEST_F(ZoneInputs, AZoneWithoutCellsIsRefused) {
  add_zone("good.geojson", polygons(square(0, 0, 50)));
  add_zone("far.geojson", polygons(square(9000, 0, 50)));
  EXPECT_EQ(refusal(),
            "basal.zones[1].polygon = far.geojson: holds the centre of no cell of the terrain "
            "(polygon x 509000 to 509050, y 4600000 to 4600050; terrain x 500000 to 500500, y "
            "4600000 to 4600400; cells of 10 m). Is its coordinate system right?");
  write("far.geojson", polygons(square(6, 6, 8)));  // between four centres
  EXPECT_THAT(refusal(),
              StartsWith("basal.zones[1].polygon = far.geojson: holds the centre of no"));
}

TEST_F(ZoneInputs, FilesThatAreWrongAreNamed) {
  add_zone("plate.geojson", polygons(square(0, 0, 50)), "plates");
  EXPECT_EQ(refusal(),
            "basal.zones[0].polygon = plate.geojson: has no layer 'plates' (basal.zones[0].layer). "
            "It has: plate.");
  scene.basal.zones[0] = {"plat.geojson", "", 0.3, {}, {}};
  EXPECT_THAT(refusal(), StartsWith("basal.zones[0].polygon = plat.geojson: no such file"));
  EXPECT_THAT(refusal(), HasSubstr("Did you mean 'plate.geojson'?"));
  scene.basal.zones.clear();
  add_zone("point.geojson", collection(feature("Point", "[500000,4600000]")));
  EXPECT_EQ(refusal(),
            "basal.zones[0].polygon = point.geojson: feature 0 is a Point, not a polygon. Draw the "
            "zone as polygons.");
  write("point.geojson", collection(""));
  EXPECT_EQ(refusal(),
            "basal.zones[0].polygon = point.geojson: layer 'point' has no features (an empty "
            "zone). Draw the zone polygon.");
}

TEST_F(ZoneInputs, OnlyTheFileCanNameItsSystem) {
  add_zone("plate.csv",
           "id,WKT\n1,\"POLYGON((500000 4600000,500050 4600000,500050 4600050,500000 "
           "4600000))\"\n");
  EXPECT_EQ(refusal(),
            "basal.zones[0].polygon = plate.csv: has no coordinate system (so the result could not "
            "be put on a map). Add EPSG:xxxxx to the file (ogr2ogr -a_srs), the system of its "
            "coordinates.");
  scene.basal.zones.clear();
  add_zone("plate.geojson", polygons(square(0, 0, 50), ""));
  EXPECT_THAT(refusal(), HasSubstr("These look like metres: give EPSG:xxxxx to the file"));
}

TEST_F(ZoneInputs, OnBareGroundCoordinatesAreTakenAsTheyAre) {
  scene.terrain.raster.clear();
  scene.terrain.synthetic =
      SyntheticTerrain{"plane", 2, {{"slope_deg", 30}, {"length_m", 120}, {"width_m", 50}}};
  scene.release.box = ReleaseBox{{-50, -40}, {-5, 5}};
  add_zone("plate.geojson",
           polygons("[[-20,-10],[20,-10],[20,10],[-20,10],[-20,-10]]", "OGC:1.3:CRS84"));
  const SceneInputs in = load_scene_inputs(scene);
  EXPECT_EQ(count(in, 1), 20 * 10);
  EXPECT_THAT(in.notes, Contains(HasSubstr("its coordinates are taken as they are")));
}

TEST_F(ZoneInputs, EveryFileHasItsIdentityInTheOrderOfTheZones) {
  add_zone("a.geojson", polygons(square(0, 0, 50)));
  add_zone("b.geojson", polygons(square(100, 0, 50)));
  const auto names = [&] {
    std::vector<std::string> all;
    for (const auto& input : load_scene_inputs(scene).identities) all.push_back(input.file);
    return all;
  };
  EXPECT_THAT(names(), ::testing::ElementsAre("bed.tif", "a.geojson", "b.geojson"));
  // Named once for each zone: which zone uses which file is part of what is compared.
  scene.basal.zones.push_back(scene.basal.zones[0]);
  EXPECT_THAT(names(), ::testing::ElementsAre("bed.tif", "a.geojson", "b.geojson", "a.geojson"));
}

TEST_F(ZoneInputs, AScenarioWrittenElsewhereGivesTheSameZones) {
  std::filesystem::create_directories(folder() / "zones");
  add_zone("zones/wide.geojson", polygons(square(100, 100, 100)));
  add_zone("zones/small.geojson", polygons(square(150, 150, 100)), "small");
  scene.grains.emplace().friction_angle_deg = Uncertain(30);
  scene.numerics.spacing_m = 5;
  const auto elsewhere = folder() / "out" / "run";
  std::filesystem::create_directories(elsewhere);
  const Scenario again =
      read_scenario_text(write_scenario(scene, elsewhere), "scenario.yaml", elsewhere);
  EXPECT_EQ(again.basal.zones[0].polygon, "../../zones/wide.geojson");
  const SceneInputs was = load_scene_inputs(scene), is = load_scene_inputs(again);
  EXPECT_EQ(is.zones->values, was.zones->values);
  EXPECT_THAT(input_differences(was.identities, is.identities), ::testing::IsEmpty());
}

}  // namespace
}  // namespace sturz::test
