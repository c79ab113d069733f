// SPDX-License-Identifier: Apache-2.0
// What a page draws besides results: overlays in the terrain's system, an orthophoto of its window.
#include "io/site/overlays/orthophoto.hpp"
#include "io/site/overlays/overlay_layers.hpp"
#include "io/site/scene_inputs.hpp"
#include "tests/io/io_fixture.hpp"

#include <fmt/format.h>
#include <gdal_priv.h>

#include <memory>

namespace sturz::test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class Overlays : public SceneOnAPlane {
 protected:
  std::string refusal() {
    return message_of([&] { load_scene_inputs(scene); });
  }
};

TEST_F(Overlays, KeepTheirNamesKindsAndPlaces) {
  write("roads.geojson",
        collection(
            feature("LineString", "[[500005,4600398],[500025,4600382]]", R"({"name":"pass"})") +
            "," + feature("Point", "[500100,4600200]", R"({"NAME":"well"})")));
  write("houses.geojson", collection(feature("Polygon", "[" + square(100, 100, 20) + "]")));
  scene.report.overlays = {{"Roads", "roads.geojson"}, {"Houses", "houses.geojson"}};
  const std::vector<Overlay> read = load_scene_inputs(scene).overlays;
  ASSERT_EQ(read.size(), 2U);
  EXPECT_EQ(read[0].name, "Houses");
  EXPECT_EQ(read[0].features.at(0).kind, OverlayFeature::Kind::polygon);
  EXPECT_EQ(read[0].features.at(0).parts.at(0).size(), 5U);
  ASSERT_EQ(read[1].features.size(), 2U);
  EXPECT_EQ(read[1].features[0].name, "pass");
  EXPECT_EQ(read[1].features[0].parts.at(0).at(1), Vec2(500025, 4600382));
  EXPECT_EQ(read[1].features[1].name, "well");
}

TEST_F(Overlays, AreCutAtTheTerrainAndThinned) {
  std::string line = "[[499000,4600200]";
  for (int i = 0; i <= 400; ++i)
    line += fmt::format(",[{},{}]", 500000 + i, 4600200 + (i % 2 == 0 ? 0.1 : -0.1));
  write("long.geojson", collection(feature("LineString", line + "]")));
  scene.report.overlays = {{"Long", "long.geojson"}};
  const std::vector<Overlay> read = load_scene_inputs(scene).overlays;
  ASSERT_EQ(read.size(), 1U);
  EXPECT_LT(corners_of(read[0]), 10U) << "corners a hundredth of a cell off say nothing";
  EXPECT_NEAR(read[0].features.at(0).parts.at(0).front().x(), 500000, 1e-6);
}

TEST_F(Overlays, BeyondTheTerrainAreNamedAndNotShown) {
  write("far.geojson", collection(feature("Point", "[600000,4600000]")));
  scene.report.overlays = {{"Far", "far.geojson"}};
  const SceneInputs in = load_scene_inputs(scene);
  EXPECT_THAT(in.overlays, IsEmpty());
  EXPECT_THAT(in.warnings, ::testing::Contains(HasSubstr("none of its 1 features")));
}

TEST_F(Overlays, ThatAreTooLargeOrMissingAreRefusedWithTheirName) {
  std::string line = "[";
  for (std::size_t i = 0; i <= most_overlay_corners; ++i)
    line += fmt::format("{}[{},{}]", i == 0 ? "" : ",", 500010 + 0.006 * static_cast<double>(i),
                        i % 2 == 0 ? 4600050 : 4600350);
  write("dense.geojson", collection(feature("LineString", line + "]")));
  scene.report.overlays = {{"Dense", "dense.geojson"}};
  EXPECT_THAT(refusal(), AllOf(HasSubstr("report.overlays: Dense"), HasSubstr("corners")));
  scene.report.overlays = {{"Gone", "gone.geojson"}};
  EXPECT_THAT(refusal(), AllOf(HasSubstr("report.overlays: Gone"), HasSubstr("gone.geojson")));
}

TEST_F(Overlays, AnOrthophotoIsCutToTheWindowAsAJpeg) {
  const auto make = [&](const char* name, int bands) {
    GDALAllRegister();
    GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
    const std::unique_ptr<GDALDataset> out(
        driver->Create(path(name).c_str(), 500, 400, bands, GDT_Byte, nullptr));
    double affine[] = {500000, 1, 0, 4600400, 0, -1};
    out->SetGeoTransform(affine);
    OGRSpatialReference utm;
    utm.importFromEPSG(32633);
    out->SetSpatialRef(&utm);
    for (int b = 1; b <= bands; ++b) out->GetRasterBand(b)->Fill(60 * b);
  };
  make("photo.tif", 3);
  make("grey.tif", 1);
  scene.report.orthophoto = "photo.tif";
  const SceneInputs in = load_scene_inputs(scene);
  Grid view = in.terrain_grid();
  const std::vector<std::uint8_t> jpeg = orthophoto_jpeg(scene, view);
  ASSERT_GT(jpeg.size(), 100U);
  EXPECT_THAT(std::vector<int>(jpeg.begin(), jpeg.begin() + 3), ElementsAre(0xFF, 0xD8, 0xFF));
  EXPECT_LT(jpeg.size(), 200'000U);
  scene.report.orthophoto = "grey.tif";
  EXPECT_THAT(refusal(), AllOf(HasSubstr("report.orthophoto"), HasSubstr("1 bands")));
}

}  // namespace
}  // namespace sturz::test
