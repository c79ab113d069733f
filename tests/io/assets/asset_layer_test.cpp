// SPDX-License-Identifier: Apache-2.0
// Assets from their layer onto the cells of the maps, and what is said of wrong ones.
#include "io/features/feature_file.hpp"
#include "io/site/assets/asset_files.hpp"
#include "io/site/scene_inputs.hpp"
#include "tests/io/io_fixture.hpp"

#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <fstream>
#include <iterator>
#include <memory>

namespace sturz::test {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr const char* curves =
    "timber: {pressure_kpa: [[5, 0], [30, 1]]}\n"
    "road: {thickness_m: [[0.2, 0.1], [1, 0.5]]}\n";

class AssetLayers : public SceneOnAPlane {
 protected:
  AssetLayers() {
    scene.assets.emplace();
    scene.assets->features = "assets.geojson";
    scene.assets->name_attribute = "name";
    write("curves.yaml", curves);
  }
  void with_classes() {
    scene.assets->class_attribute = "class";
    scene.assets->vulnerability = "curves.yaml";
    scene.assets->value_attribute = "worth";
    scene.assets->value_unit = "CHF";
  }
  void layer(const std::string& features) { write("assets.geojson", collection(features)); }
  static std::string named(const std::string& name) { return R"({"name":")" + name + "\"}"; }
  static std::string point(const std::string& name, double x, double y) {
    return feature("Point",
                   "[" + std::to_string(500000 + x) + "," + std::to_string(4600000 + y) + "]",
                   named(name));
  }
  std::shared_ptr<const Assets> load() { return load_scene_inputs(scene).assets; }
  std::string refusal() {
    return message_of([&] { load(); });
  }
};

TEST_F(AssetLayers, ASceneWithoutThemHasNone) {
  scene.assets.reset();
  EXPECT_EQ(load(), nullptr);
}

TEST_F(AssetLayers, PointsLinesAndPolygonsTouchTheirCells) {
  // 50 x 40 cells of 10 m; cell 0 is that in the north-west, at y 390 to 400.
  layer(point("tree", 15, 395) + "," +
        feature("LineString", "[[500005,4600398],[500025,4600382]]", named("road")) + "," +
        feature("Polygon", "[" + square(100, 100, 20) + "]", named("hall")) + "," +
        feature("Polygon", "[" + square(203, 203, 1) + "]", named("hut")));
  const SceneInputs in = load_scene_inputs(scene);
  ASSERT_TRUE(in.assets);
  ASSERT_EQ(in.assets->list.size(), 4U);
  EXPECT_EQ(in.assets->list[0].name, "tree");
  EXPECT_THAT(in.assets->list[0].cells, ElementsAre(1U));
  EXPECT_THAT(in.assets->list[1].cells, ElementsAre(0U, 1U, 51U, 52U));
  // Drawn along the cells' edges it touches its own four alone.
  EXPECT_THAT(in.assets->list[2].cells, ElementsAre(1410U, 1411U, 1460U, 1461U));
  EXPECT_THAT(in.assets->list[3].cells, ElementsAre(970U));
  for (const Asset& a : in.assets->list) EXPECT_EQ(a.place(), AssetPlace::inside) << a.name;
  EXPECT_EQ(in.identities.back().role, "assets.features");
  EXPECT_THAT(in.notes, Contains("assets.features = assets.geojson: 4 assets on known ground"));
}

TEST_F(AssetLayers, HolesAreNotTouchedAndSeveralPartsAreOneAsset) {
  layer(feature("MultiPolygon",
                "[[" + square(100, 100, 30) + "," + square(110, 110, 10) + "],[" +
                    square(300, 300, 10) + "]]",
                named("yard")));
  const auto assets = load();
  ASSERT_EQ(assets->list.size(), 1U);
  EXPECT_EQ(assets->list[0].cells.size(), 9U);  // eight around the hole, and one
}

TEST_F(AssetLayers, ClassesAndValuesComeFromTheirFields) {
  with_classes();
  layer(feature("Point", "[500015,4600395]", R"({"name":"a","class":"road","worth":1200.5})") +
        "," + feature("Point", "[500025,4600395]", R"({"name":"b","class":"timber","worth":3})"));
  const auto assets = load();
  EXPECT_TRUE(assets->has_classes && assets->has_values);
  EXPECT_EQ(assets->value_unit, "CHF");
  ASSERT_EQ(assets->curves.size(), 2U);
  EXPECT_EQ(assets->curves[0].intensity, PeakLayer::pressure);
  EXPECT_EQ(assets->curves[0].points[1].intensity, 30e3);
  EXPECT_EQ(assets->list[0].curve, 1U);
  EXPECT_EQ(assets->list[0].value, 1200.5);
  EXPECT_EQ(assets->list[1].curve, 0U);
}

TEST_F(AssetLayers, WhatLiesBeyondTheTerrainIsNamed) {
  layer(point("here", 15, 395) + "," + point("far", 9000, 100) + "," +
        feature("Polygon", "[" + square(-10, 100, 20) + "]", named("edge")));
  const SceneInputs in = load_scene_inputs(scene);
  EXPECT_EQ(in.assets->list[1].place(), AssetPlace::outside);
  EXPECT_EQ(in.assets->list[2].place(), AssetPlace::partly_outside);
  EXPECT_THAT(in.warnings, Contains(HasSubstr("1 of 3 assets lie beyond the known ground, and "
                                              "nothing is said of them: far")));
  EXPECT_THAT(in.warnings, Contains(HasSubstr("a part of 1 assets lies beyond the known ground and "
                                              "is not looked at: edge")));
  layer(point("far", 9000, 100));
  EXPECT_THAT(refusal(), AllOf(HasSubstr("assets.features = assets.geojson: no asset lies on known "
                                         "ground (terrain x 500000 to 500500"),
                               HasSubstr("Is its coordinate system right?")));
}

TEST_F(AssetLayers, WhereTheGroundHasAHoleNothingIsKnown) {
  layer(point("hole", 15, 395) + "," + point("solid", 25, 395) + "," +
        feature("LineString", "[[500012,4600395],[500028,4600395]]", named("both")));
  Raster<double> ground = plane(50, 40, 10, 500000, 4600400);
  ground.values[1] = nan_d;
  const auto read = [&](const Window& w) {
    Raster<double> part(grid_of(w, ground.grid));
    for (int r = 0; r < w.n_rows; ++r)
      for (int c = 0; c < w.n_cols; ++c) part.at(r, c) = ground.at(w.row0 + r, w.col0 + c);
    return part;
  };
  const AssetsRead found = read_assets(scene, ground.grid, ground.grid, read);
  EXPECT_EQ(found.assets.list[0].place(), AssetPlace::outside);
  EXPECT_EQ(found.assets.list[1].place(), AssetPlace::inside);
  EXPECT_EQ(found.assets.list[2].place(), AssetPlace::partly_outside);
}

TEST_F(AssetLayers, WrongLayersAreRefusedBeforeAnythingIsComputed) {
  layer(point("a", 15, 395) + "," + point("a", 25, 395));
  EXPECT_THAT(refusal(), HasSubstr("assets.features = assets.geojson: feature 1 has the name 'a' "
                                   "of feature 0"));
  layer(point("", 15, 395));
  EXPECT_THAT(refusal(), HasSubstr("feature 0 has no value in 'name'. Name it."));
  layer("");
  EXPECT_THAT(refusal(), HasSubstr("has no features. Draw the assets."));
  layer(point("a", 15, 395));
  scene.assets->name_attribute = "nmae";
  EXPECT_THAT(refusal(), HasSubstr("has no field 'nmae' (assets.name_attribute). It has: name."));
  scene.assets->name_attribute = "name";
  layer(feature("Polygon", "[]", named("empty")));
  EXPECT_THAT(refusal(), HasSubstr("is empty. Draw it or delete it."));
  write("assets.geojson", collection(point("a", 15, 395), "EPSG::32633"));
  scene.assets->features = "asets.geojson";
  EXPECT_THAT(refusal(), HasSubstr("assets.features = asets.geojson"));
}

TEST_F(AssetLayers, WrongClassesAndValuesAreRefused) {
  with_classes();
  layer(feature("Point", "[500015,4600395]", R"({"name":"a","class":"brick","worth":1})"));
  EXPECT_THAT(refusal(), HasSubstr("feature 0 is of class 'brick', for which assets.vulnerability "
                                   "has no curve. It has: timber, road."));
  layer(feature("Point", "[500015,4600395]", R"({"name":"a","class":"road","worth":-1})"));
  EXPECT_THAT(refusal(), HasSubstr("has worth = -1 (a value is 0 or more). Give CHF."));
  layer(feature("Point", "[500015,4600395]", R"({"name":"a","class":"road","worth":"much"})"));
  EXPECT_THAT(refusal(), HasSubstr("field 'worth' (assets.value_attribute) holds no numbers"));
  layer(feature("Point", "[500015,4600395]", R"({"name":"a","class":"road","worth":null})") + "," +
        feature("Point", "[500025,4600395]", R"({"name":"b","class":"road","worth":2})"));
  EXPECT_THAT(refusal(), HasSubstr("feature 0 has no value in 'worth'. Give what it is worth"));
}

TEST_F(AssetLayers, ProblemsOfBothFilesComeTogether) {
  with_classes();
  write("curves.yaml", "timber: {pressure_kpa: [[5, 0], [4, 1]]}\n");
  write("assets.geojson", collection(""));
  EXPECT_THAT(refusal(), AllOf(HasSubstr("intensities must rise"), HasSubstr("has no features")));
}

std::string bytes_of(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST_F(AssetLayers, GeoPackageHoldsGeometriesAndColumns) {
  layer(point("tree", 15, 395) + "," +
        feature("Polygon", "[" + square(100, 100, 20) + "]", named("hall")));
  const SceneInputs in = load_scene_inputs(scene);
  FeatureTable table;
  table.name = "assets";
  table.crs_wkt = in.hazard_grid.crs_wkt;
  for (const Asset& a : in.assets->list) table.wkb.push_back(a.wkb);
  table.columns = {{"name", std::vector<std::string>{"tree", "hall"}},
                   {"hit_members", std::vector<std::int64_t>{3, 0}},
                   {"probability", std::vector<double>{0.25, nan_d}}};
  write_geopackage(path("assets.gpkg"), table);
  write_geopackage(path("again.gpkg"), table);
  EXPECT_EQ(bytes_of(path("assets.gpkg")), bytes_of(path("again.gpkg")));
  EXPECT_THAT(names(), Not(Contains(HasSubstr(".part"))));
  GDALAllRegister();
  const std::unique_ptr<GDALDataset> file(
      GDALDataset::Open(path("assets.gpkg").c_str(), GDAL_OF_VECTOR));
  ASSERT_NE(file, nullptr);
  ASSERT_EQ(file->GetLayerCount(), 1);
  OGRLayer& read = *file->GetLayer(0);
  EXPECT_STREQ(read.GetName(), "assets");
  ASSERT_NE(read.GetSpatialRef(), nullptr);
  EXPECT_STREQ(read.GetSpatialRef()->GetAuthorityCode(nullptr), "32633");
  const OGRFeatureUniquePtr tree(read.GetNextFeature()), hall(read.GetNextFeature());
  ASSERT_TRUE(tree && hall);
  EXPECT_STREQ(tree->GetFieldAsString("name"), "tree");
  EXPECT_EQ(tree->GetFieldAsInteger64("hit_members"), 3);
  EXPECT_EQ(tree->GetFieldAsDouble("probability"), 0.25);
  EXPECT_TRUE(hall->IsFieldNull(hall->GetFieldIndex("probability")));
  EXPECT_EQ(tree->GetGeometryRef()->toPoint()->getX(), 500015);
  EXPECT_EQ(hall->GetGeometryRef()->toPolygon()->get_Area(), 400);
}

TEST(DamageCurves, AreReadInSi) {
  const std::vector<DamageCurve> read = parse_damage_curves(
      "timber: {pressure_kpa: [[5, 0], [30, 1]]}\nroad: {energy_kj_m2: [[1.5, 0.1]]}\n"
      "rail: {speed_m_s: [[0, 0], [3, 0.4], [9, 0.4]]}\n",
      "curves.yaml");
  ASSERT_EQ(read.size(), 3U);
  EXPECT_EQ(read[0].name, "timber");
  EXPECT_EQ(read[1].intensity, PeakLayer::energy);
  EXPECT_EQ(read[1].points[0].intensity, 1500);
  EXPECT_EQ(read[2].points[1].intensity, 3);
}

TEST(DamageCurves, ProblemsHaveTheirPlace) {
  const auto problem = [](const std::string& text) {
    return message_of([&] { parse_damage_curves(text, "curves.yaml"); });
  };
  EXPECT_THAT(problem("a: {pressure_kpa: [[5, 0], [5, 1]]}\n"),
              HasSubstr("curves.yaml:1:28: a.pressure_kpa[1] = [5, 1] (intensities must rise"));
  EXPECT_THAT(problem("a: {pressure_kpa: [[5, 0.5], [6, 0.2]]}\n"),
              HasSubstr("more intensity cannot do less damage"));
  EXPECT_THAT(problem("a: {pressure_kpa: [[5, 50]]}\n"), HasSubstr("Divide per cent by 100"));
  EXPECT_THAT(problem("a: {pressure_kpa: [[-5, 0.5]]}\n"), HasSubstr("must be in 0..1e6"));
  EXPECT_THAT(problem("a: {presure_kpa: [[5, 0.5]]}\n"), HasSubstr("Did you mean pressure_kpa?"));
  EXPECT_THAT(problem("a: {pressure_kpa: [[5]]}\n"), HasSubstr("[intensity, damage]"));
  EXPECT_THAT(problem("a: 3\n"), HasSubstr("one curve"));
  EXPECT_THAT(problem(""), HasSubstr("holds no class"));
  EXPECT_THAT(problem("a: {pressure_kpa: [[5, x]]}\n"), Not(IsEmpty()));
}

}  // namespace
}  // namespace sturz::test
