// SPDX-License-Identifier: Apache-2.0
// Which systems, places and sources of inputs are taken, by the same rules for every kind of file.
#include "io/gdal/crs.hpp"
#include "io/gdal/input_files.hpp"
#include "io/scenario/scenario_file.hpp"
#include "io/site/scene_inputs.hpp"
#include "tests/io/typed_raster.hpp"

#include <cpl_conv.h>
#include <cpl_vsi.h>

#include <cmath>

namespace sturz::test {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

class InputRules : public IoTest {
 protected:
  InputRules() {
    scene.directory = folder().string();
    scene.terrain.raster = "bed.tif";
    scene.release.thickness_m = Uncertain(4);
  }
  void ground(const std::string& crs, double west = 500000, double north = 4600000) const {
    TypedRaster r = slope(60);
    r.crs = crs, r.west = west, r.north = north;
    write_typed(path("bed.tif"), r);
  }
  /// 100 m x 100 m in the middle of the ground.
  void source(const std::string& crs, double west = 500000, double north = 4600000) {
    const auto corner = [&](double dx, double dy) {
      return fmt_pair(west + 250 + dx, north - 350 + dy);
    };
    write("source.csv", "id,WKT\n1,\"POLYGON((" + corner(0, 0) + "," + corner(100, 0) + "," +
                            corner(100, 100) + "," + corner(0, 100) + "," + corner(0, 0) +
                            "))\"\n");
    scene.release.polygon = "source.csv";
    scene.release.crs = crs;
  }
  static std::string fmt_pair(double x, double y) {
    return std::to_string(x) + " " + std::to_string(y);
  }
  void depths(const std::string& crs) {
    TypedRaster r = slope(20);
    r.crs = crs, r.west = 500200, r.north = 4599800;
    std::fill(r.values.begin(), r.values.end(), 3);
    write_typed(path("depth.tif"), r);
    scene.release.thickness_raster = "depth.tif";
    scene.release.thickness_m.reset();
  }
  std::string refusal() const {
    return message_of([&] { load_scene_inputs(scene); });
  }
  Scenario scene;
};

TEST_F(InputRules, AFileWithoutASystemTakesTheTerrainsKeyWhateverItsKind) {
  ground("");
  scene.terrain.crs = "EPSG:32633";
  source("");
  EXPECT_THAT(load_scene_inputs(scene).notes,
              Contains(HasSubstr("source.csv: has no coordinate system; taken to be in terrain.crs "
                                 "= WGS 84 / UTM zone 33N")));
  scene.release.polygon.clear();
  depths("");
  EXPECT_THAT(load_scene_inputs(scene).notes,
              Contains(HasSubstr("depth.tif: has no coordinate system; taken to be in terrain.crs "
                                 "= WGS 84 / UTM zone 33N")));
  ground("EPSG:32633");  // the file names it: no key, so neither stands in
  scene.terrain.crs.clear();
  EXPECT_THAT(refusal(), HasSubstr("depth.tif: has no coordinate system"));
  scene.release.thickness_raster.clear();
  scene.release.thickness_m = Uncertain(4);
  source("");
  EXPECT_THAT(refusal(), HasSubstr("source.csv: has no coordinate system"));
}

TEST_F(InputRules, AllFilesAreCheckedInOneRound) {
  ground("");
  source("");
  scene.basal.zones.push_back({"none.geojson", "", 0.3, {}, {}});
  EXPECT_THAT(refusal(), AllOf(HasSubstr("terrain.raster = bed.tif: has no coordinate system"),
                               HasSubstr("\nrelease.polygon = source.csv: has no coordinate"),
                               HasSubstr("\nbasal.zones[0].polygon = none.geojson: no such file")));
  scene.terrain.raster = "bde.tif";
  scene.release.polygon.clear();
  depths("EPSG:32633");
  TypedRaster r = slope(20);
  r.values[7] = -3;
  write_typed(path("depth.tif"), r);
  EXPECT_THAT(refusal(),
              AllOf(HasSubstr("Did you mean 'bed.tif'?"),
                    HasSubstr("\nrelease.thickness_raster = depth.tif: thickness -3 m")));
}

TEST_F(InputRules, LocalCoordinatesNeedTheWord) {
  ground("", 0, 600);
  source("", 0, 600);
  EXPECT_THAT(refusal(), HasSubstr("or `terrain.crs: local` if they are metres"));
  scene.terrain.crs = "local";
  const SceneInputs in = load_scene_inputs(scene);
  EXPECT_EQ(in.hazard_grid.crs_wkt, "");
  EXPECT_EQ(in.hazard_grid.west_m, 0);
  EXPECT_NEAR(in.source_area_m2, 10000, 1e-6);
  ground("LOCAL_CS[\"mine grid\",UNIT[\"metre\",1]]", 0, 600);
  EXPECT_EQ(load_scene_inputs(scene).hazard_grid.crs_wkt, "");
  ground("EPSG:4326", 14, 41);
  EXPECT_THAT(refusal(), HasSubstr("counts in degrees (local coordinates are metres)"));
}

TEST_F(InputRules, AnUnknownShiftOfDatumsIsRefused) {
  // Beijing 1954 and CGCS2000, both in the same projection: the numbers fit, the places do not.
  ground("EPSG:4547", 500000, 3500000);
  source("EPSG:2435", 500000, 3500000);
  EXPECT_THAT(refusal(), AllOf(HasSubstr("the shift between their datums is not known"),
                               HasSubstr("Beijing 1954"), HasSubstr("CGCS2000")));
  source("EPSG:2383", 500000, 3500000);  // Xian 1980
  EXPECT_THAT(refusal(), HasSubstr("the shift between their datums is not known"));
  source("EPSG:4547", 500000, 3500000);
  EXPECT_NEAR(load_scene_inputs(scene).source_area_m2, 10000, 1e-6);
}

TEST_F(InputRules, ShiftsThatAreKnownAreMadeAndMissingDatumsAreTold) {
  ground("EPSG:32633");
  source("EPSG:25833");  // ETRS89: the same within a metre, by a published shift
  SceneInputs in = load_scene_inputs(scene);
  EXPECT_NEAR(in.source_area_m2, 10000, 1);
  EXPECT_THAT(in.warnings, IsEmpty());
  source("+proj=utm +zone=33 +ellps=GRS80 +units=m");
  in = load_scene_inputs(scene);
  EXPECT_NEAR(in.source_area_m2, 10000, 1);
  EXPECT_THAT(in.warnings, Contains(HasSubstr("names no datum; both are taken to have the same")));
}

TEST_F(InputRules, NamesInsideArchivesStartAtTheScenario) {
  ground("EPSG:32633");
  const std::string inside = "/vsizip/" + path("dem.zip") + "/bed.tif";
  ASSERT_EQ(CPLCopyFile(inside.c_str(), path("bed.tif").c_str()), 0);
  scene.release.box = ReleaseBox{{500200, 500250}, {4599700, 4599750}};
  scene.terrain.raster = "/vsizip/dem.zip/bed.tif";
  EXPECT_EQ(load_scene_inputs(scene).elevation->grid.n_cols, 60);
  scene.terrain.raster = "/vsizip/{dem.zip}/bed.tif";
  EXPECT_EQ(load_scene_inputs(scene).elevation->grid.n_cols, 60);
  scene.terrain.raster = inside;
  EXPECT_EQ(load_scene_inputs(scene).elevation->grid.n_cols, 60);
  scene.terrain.raster = "/vsizip/dem.zip/bad.tif";
  EXPECT_THAT(refusal(), HasSubstr("nothing of that name is there"));
  // A scenario that is written elsewhere still finds it.
  EXPECT_EQ(anchored_gdal_name("/vsizip/dem.zip/bed.tif", folder().string()),
            "/vsizip/" + path("dem.zip") + "/bed.tif");
  EXPECT_EQ(anchored_gdal_name("NETCDF:\"bed.tif\":z", folder().string()),
            "NETCDF:\"" + path("bed.tif") + "\":z");
}

TEST_F(InputRules, LinesAreCalledLinesBeforeTheirFieldsAreMissed) {
  ground("EPSG:32633");
  write("source.geojson", collection(feature("LineString", "[[500200,4599700],[500300,4599700]]",
                                             R"({"name": "crown"})")));
  scene.release.polygon = "source.geojson";
  scene.release.thickness_attribute = "h";
  scene.release.thickness_m.reset();
  EXPECT_THAT(refusal(), AllOf(HasSubstr("Line String, not polygons"), Not(HasSubstr("field"))));
}

class Trust : public InputRules {
 protected:
  Trust() {
    ground("EPSG:32633");
    scene.release.box = ReleaseBox{{500200, 500250}, {4599700, 4599750}};
  }
  std::string with(const std::string& name, const std::string& band) {
    write(name,
          "<VRTDataset rasterXSize='60' rasterYSize='60'><SRS>EPSG:32633</SRS>"
          "<GeoTransform>500000,10,0,4600000,0,-10</GeoTransform>" +
              band + "</VRTDataset>");
    scene.terrain.raster = name;
    return refusal();
  }
  static std::string simple(const std::string& source) {
    return "<VRTRasterBand dataType='Float32' band='1'><SimpleSource>"
           "<SourceFilename relativeToVRT='1'>" +
           source + "</SourceFilename><SourceBand>1</SourceBand></SimpleSource></VRTRasterBand>";
  }
};

TEST_F(Trust, NothingIsFetchedOverTheNetwork) {
  for (const char* name :
       {"/vsicurl/http://127.0.0.1:9/bed.tif", "http://127.0.0.1:9/bed.tif",
        "/vsis3/bucket/bed.tif", "/vsizip//vsicurl/http://127.0.0.1:9/a.zip/bed.tif",
        "WCS:http://127.0.0.1:9/?", "/vsicurl_streaming/http://127.0.0.1:9/bed.tif",
        "NETCDF:\"https://127.0.0.1:9/a.nc\":z"}) {
    scene.terrain.raster = name;
    EXPECT_THAT(refusal(),
                AllOf(HasSubstr("lies on the network"), HasSubstr("--allow-remote-inputs")))
        << name;
  }
  scene.terrain.raster = "bed.tif";
  scene.release.box.reset();
  scene.release.polygon = "/vsigs/bucket/source.gpkg";
  EXPECT_THAT(refusal(), HasSubstr("lies on the network"));
}

TEST_F(Trust, VirtualRastersAreLookedThrough) {
  EXPECT_THAT(with("far.vrt", simple("/vsicurl/http://127.0.0.1:9/bed.tif")),
              HasSubstr("'/vsicurl/http://127.0.0.1:9/bed.tif' lies on the network"));
  EXPECT_THAT(with("outer.vrt", simple("far.vrt")), HasSubstr("lies on the network"));
  write("secret.txt", std::string(4000, 'x'));
  const std::string raw =
      "<VRTRasterBand dataType='Byte' band='1' subClass='VRTRawRasterBand'>"
      "<SourceFilename relativeToVRT='1'>secret.txt</SourceFilename></VRTRasterBand>";
  EXPECT_THAT(with("raw.vrt", raw), HasSubstr("takes the bytes of secret.txt for values"));
  EXPECT_THAT(with("around.vrt", simple("raw.vrt")), HasSubstr("takes the bytes of secret.txt"));
  write("near.vrt",
        "<VRTDataset rasterXSize='60' rasterYSize='60'><SRS>EPSG:32633</SRS>"
        "<GeoTransform>500000,10,0,4600000,0,-10</GeoTransform>" +
            simple("bed.tif") + "</VRTDataset>");
  scene.terrain.raster = "near.vrt";
  EXPECT_EQ(load_scene_inputs(scene).elevation->grid.n_cols, 60);
}

TEST_F(Trust, TheLibraryItselfHasNoNetwork) {
  scene.terrain.raster = "none.tif";
  EXPECT_THAT(refusal(), HasSubstr("none.tif"));  // the first reader closes it
  EXPECT_EQ(VSIFOpenL("/vsicurl/http://127.0.0.1:9/bed.tif", "rb"), nullptr);
  EXPECT_THAT(CPLGetLastErrorMsg(), HasSubstr("which is not read"));
  EXPECT_EQ(GDALGetDriverByName("WMS"), nullptr);
  EXPECT_EQ(GDALGetDriverByName("PostgreSQL"), nullptr);
  OGRSpatialReference crs;
  EXPECT_NE(crs.importFromUrl("http://127.0.0.1:9/crs"), OGRERR_NONE);
  EXPECT_THAT(CPLGetLastErrorMsg(), HasSubstr("not read"));
}

}  // namespace
}  // namespace sturz::test
