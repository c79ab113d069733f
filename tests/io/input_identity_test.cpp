// SPDX-License-Identifier: Apache-2.0
// Inputs are the same when what was read of them is, whatever became of their files.
#include "io/gdal/gdal_raster.hpp"
#include "io/gdal/gdal_vector.hpp"
#include "io/gdal/raster_identity.hpp"
#include "io/site/scene_inputs.hpp"
#include "tests/io/typed_raster.hpp"

#include <cpl_conv.h>
#include <cpl_vsi.h>

#include <cmath>
#include <numeric>
#include <optional>

namespace sturz::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

class Identity : public IoTest {
 protected:
  InputIdentity terrain(const std::string& name) const {
    RasterRequest r;
    r.path = name;
    r.directory = folder().string();
    return read_elevation(r).identity;
  }
  InputIdentity polygons(const std::string& name, const std::string& attribute = "") const {
    PolygonRequest r;
    r.path = name;
    r.directory = folder().string();
    r.thickness_attribute = attribute;
    return read_release_polygons(r, {100, 100, 500000, 4600400, 10, utm33_wkt()}).identity;
  }
  void mosaic(const std::string& name, const std::string& tile, int n) const {
    write(name, "<VRTDataset rasterXSize='" + std::to_string(n) + "' rasterYSize='" +
                    std::to_string(n) +
                    "'><SRS>EPSG:32633</SRS>"
                    "<GeoTransform>500000,10,0,4600000,0,-10</GeoTransform>"
                    "<VRTRasterBand dataType='Float32' band='1'><SimpleSource>"
                    "<SourceFilename relativeToVRT='1'>" +
                    tile +
                    "</SourceFilename><SourceBand>1</SourceBand></SimpleSource></VRTRasterBand>"
                    "</VRTDataset>");
  }
};

TEST_F(Identity, LayoutCompressionTypeAndSidecarsDoNotMatter) {
  TypedRaster r = slope(300);
  for (double& v : r.values) v = static_cast<float>(v);
  write_typed(path("a.tif"), r);
  r.type = GDT_Float64;
  r.options = {"TILED=YES", "COMPRESS=DEFLATE", "BLOCKXSIZE=64", "BLOCKYSIZE=64"};
  write_typed(path("b.tif"), r);
  InputIdentity a = terrain("a.tif");
  EXPECT_EQ(a.role, "terrain.raster");
  EXPECT_EQ(a.parts.size(), 4U);  // 300 cells are two blocks of 256 a side
  write("a.tif.aux.xml",
        "<PAMDataset><PAMRasterBand band=\"1\"><Metadata><MDI key=\"STATISTICS_MAXIMUM\">3</MDI>"
        "</Metadata></PAMRasterBand></PAMDataset>");
  EXPECT_EQ(terrain("a.tif"), a);
  EXPECT_THAT(input_differences({a}, {terrain("b.tif")}), IsEmpty());
}

TEST_F(Identity, AChangedValueShiftOrSystemIsSeenAndNamed) {
  TypedRaster r = slope(300);
  write_typed(path("a.tif"), r);
  const InputIdentity before = terrain("a.tif");
  r.values[299] += 0.01;
  write_typed(path("a.tif"), r);
  EXPECT_THAT(input_differences({before}, {terrain("a.tif")}),
              ElementsAre(HasSubstr("input terrain.raster = ")));
  EXPECT_THAT(input_differences({before}, {terrain("a.tif")})[0],
              HasSubstr("other values than before in 1 of 4 blocks of 256 x 256 cells, the first "
                        "block 0/1"));
  r = slope(300);
  r.west += 5;
  write_typed(path("a.tif"), r);
  EXPECT_THAT(input_differences({before}, {terrain("a.tif")})[0], HasSubstr("corner 500005"));
  r.west -= 5;
  r.crs = "EPSG:32632";
  write_typed(path("a.tif"), r);
  EXPECT_THAT(input_differences({before}, {terrain("a.tif")})[0], HasSubstr("EPSG:32632"));
}

TEST_F(Identity, ATileBehindTwoVirtualRastersIsPartOfIt) {
  TypedRaster r = slope(40);
  write_typed(path("tile.tif"), r);
  mosaic("inner.vrt", "tile.tif", 40);
  mosaic("outer.vrt", "inner.vrt", 40);
  const InputIdentity before = terrain("outer.vrt");
  EXPECT_EQ(terrain("outer.vrt"), before);
  r.values[800] += 1;
  write_typed(path("tile.tif"), r);
  EXPECT_EQ(input_differences({before}, {terrain("outer.vrt")}).size(), 1U);
}

TEST_F(Identity, ARasterInAnArchiveHasOne) {
  TypedRaster r = slope(40);
  const auto zipped = [&](const std::string& zip) {
    write_typed(path("dem.tif"), r);
    const std::string inside = "/vsizip/" + path(zip) + "/dem.tif";
    EXPECT_EQ(CPLCopyFile(inside.c_str(), path("dem.tif").c_str()), 0);
    return terrain("/vsizip/" + zip + "/dem.tif");  // beside the scenario
  };
  const InputIdentity before = zipped("a.zip");
  EXPECT_THAT(input_differences({before}, {zipped("b.zip")}), IsEmpty());
  r.values[3] = 700;
  EXPECT_EQ(input_differences({before}, {zipped("c.zip")}).size(), 1U);
}

TEST_F(Identity, OnlyTheValuesOfPolygonsThatAreReadCount) {
  const auto file = [&](const std::string& name, double corner, const std::string& properties) {
    write(name, collection(feature("Polygon", "[" + square(corner, 20, 100) + "]", properties)));
  };
  file("a.geojson", 100, R"({"h": 2, "who": "Anna"})");
  file("who.geojson", 100, R"({"who": "Berta", "h": 2})");
  file("h.geojson", 100, R"({"h": 2.5, "who": "Anna"})");
  file("moved.geojson", 100.001, R"({"h": 2, "who": "Anna"})");
  const InputIdentity a = polygons("a.geojson"), with_h = polygons("a.geojson", "h");
  EXPECT_THAT(input_differences({a}, {polygons("who.geojson")}), IsEmpty());
  EXPECT_THAT(input_differences({a}, {polygons("h.geojson")}), IsEmpty());
  EXPECT_THAT(input_differences({with_h}, {polygons("who.geojson", "h")}), IsEmpty());
  EXPECT_THAT(input_differences({with_h}, {polygons("h.geojson", "h")}),
              ElementsAre(HasSubstr("other polygons or values than before")));
  EXPECT_EQ(input_differences({a}, {polygons("moved.geojson")}).size(), 1U);
}

TEST_F(Identity, InputsAreComparedByTheirKeyAndOnlyWhatDiffersIsNamed) {
  const InputIdentity ground{"terrain.raster", "dem.tif", "shape", {{"0/0", "aa"}}};
  const InputIdentity source{"release.polygon", "a.gpkg", "shape", {{"features", "bb"}}};
  InputIdentity moved = source, changed = source;
  moved.file = "elsewhere/a.gpkg";
  EXPECT_THAT(input_differences({source, ground}, {ground, moved}), IsEmpty());
  changed.parts["features"] = "cc";
  EXPECT_THAT(input_differences({ground, source}, {ground, changed}),
              ElementsAre(StartsWith("input release.polygon = a.gpkg: other polygons")));
  EXPECT_THAT(input_differences({ground, source}, {ground}),
              ElementsAre("input release.polygon = a.gpkg: is not there any more"));
  EXPECT_THAT(input_differences({ground}, {ground, source}),
              ElementsAre("input release.polygon = a.gpkg: was not there before"));
  const InputIdentity old{"", "dem.tif", "", {}};
  EXPECT_THAT(input_differences({old}, {ground}),
              ::testing::Contains(HasSubstr("another version of sturz began this folder")));
}

TEST_F(Identity, AGrownWindowAgreesWhereBothHaveRead) {
  const int n_cols = 700, n_rows = 600;
  std::vector<double> all(static_cast<std::size_t>(n_cols) * n_rows);
  std::iota(all.begin(), all.end(), 0.0);
  const auto hashes = [&](const ReadWindow& w) {
    std::vector<double> part;
    for (int row = w.row0; row < w.row0 + w.n_rows; ++row)
      for (int col = w.col0; col < w.col0 + w.n_cols; ++col)
        part.push_back(all[static_cast<std::size_t>(row) * n_cols + col]);
    return InputIdentity{"terrain.raster", "", "", block_hashes(part, w, n_cols, n_rows)};
  };
  const InputIdentity small = hashes({256, 256, 256, 256}), odd = hashes({200, 10, 333, 500});
  const InputIdentity large = hashes({0, 0, n_cols, n_rows});
  EXPECT_EQ(small.parts.size(), 1U);
  EXPECT_EQ(large.parts.size(), 9U);
  EXPECT_EQ(large.parts.at("1/1"), small.parts.at("1/1"));
  EXPECT_THAT(input_differences({small}, {large}), IsEmpty());
  // Parts of blocks have names of their own: whether they differ is not known before they are read.
  EXPECT_EQ(parts_to_read(large, {odd}).size(), 6U);
  EXPECT_THAT(input_differences({odd}, {large}),
              ElementsAre(HasSubstr("cannot be compared in 6 of 6 blocks")));
  all[300 * n_cols + 300] += 1;
  EXPECT_EQ(input_differences({small}, {hashes({0, 0, n_cols, n_rows})}).size(), 1U);
  EXPECT_EQ(input_differences({odd}, {hashes({200, 10, 333, 500})}).size(), 1U);
  EXPECT_EQ(with_known_parts({small}, {large})[0].parts.size(), 9U);
}

TEST_F(Identity, PartsAreFoundByTheirNamesAndNoOthers) {
  const auto is = [](const ReadWindow& w) {
    return std::vector<int>{w.col0, w.row0, w.n_cols, w.n_rows};
  };
  const auto at = [&](const char* name) {
    const auto w = window_of_part(name, 700, 600);
    return w ? is(*w) : std::vector<int>{};
  };
  EXPECT_THAT(at("0/1"), ElementsAre(256, 0, 256, 256));
  EXPECT_THAT(at("2/2"), ElementsAre(512, 512, 188, 88));
  EXPECT_THAT(at("1/0 rows 300-301 columns 7-7"), ElementsAre(7, 300, 1, 2));
  for (const char* name :
       {"", "features", "3/0", "0/3", "-1/0", "0/0x", "0/0 rows 0-256 columns 0-1",
        "0/0 rows 5-4 columns 0-1", "0/1 rows 0-1 columns 255-256", "0/0 rows 1-2", "0 / 0",
        "0/0 rows 1-2 columns 3-4 ", "99999999999/0", "0/0 rows 1-2 columns 3-99999999999"})
    EXPECT_THAT(at(name), IsEmpty()) << name;
}

/// Rasters of which a window is read: the names of its parts find the same cells again.
class IdentityOfParts : public Identity {
 protected:
  ElevationRaster open(std::optional<double> cell = {}) const {
    RasterRequest r;
    r.path = "dem.tif";
    r.directory = folder().string();
    r.cell_size_m = cell;
    return ElevationRaster(r);
  }
  static std::vector<std::string> names(const InputIdentity& identity) {
    std::vector<std::string> all;
    for (const auto& [name, hash] : identity.parts) all.push_back(name);
    return all;
  }
  /// \param row,col a cell of the file that the middle of the working grid was made from
  void expect_found_again(TypedRaster raster, int row, int col, std::optional<double> cell = {}) {
    write_typed(path("dem.tif"), raster);
    const Grid& g = open(cell).grid();
    const Window w = window_between(g.n_rows / 2 - 40, g.n_rows / 2 + 40, g.n_cols / 2 - 45,
                                    g.n_cols / 2 + 45, g);
    const InputIdentity read = open(cell).read(w).identity;
    EXPECT_THAT(names(read), ::testing::Contains(HasSubstr("rows")));
    EXPECT_EQ(open(cell).hashes_of(names(read)), read.parts);
    raster.values[static_cast<std::size_t>(row) * raster.n_cols + col] += 0.5;
    write_typed(path("dem.tif"), raster);
    EXPECT_NE(open(cell).hashes_of(names(read)), read.parts);
    EXPECT_THAT(open(cell).hashes_of({"9/9", "features"}), IsEmpty());
  }
};

TEST_F(IdentityOfParts, OfARasterKeptCellByCell) { expect_found_again(slope(600), 300, 300); }

TEST_F(IdentityOfParts, OfARasterResampled) { expect_found_again(slope(1500), 750, 750, 7.0); }

TEST_F(IdentityOfParts, OfARasterInDegrees) {
  TypedRaster r = slope(1500);
  r.crs = "EPSG:4326";
  r.west = 14, r.north = 42, r.cell = 1e-4;
  expect_found_again(r, 750, 750);
}

TEST_F(IdentityOfParts, OfScaledWholeNumbersWithMarks) {
  TypedRaster r = slope(600);
  for (double& v : r.values) v = std::nearbyint(10 * v);
  r.type = GDT_Int32;
  r.scale = 0.1;
  for (std::size_t i = 0; i < r.values.size(); i += 7) r.values[i] = 2147483647;
  expect_found_again(r, 300, 301);
}

TEST_F(IdentityOfParts, ABlockWithoutAnyGroundIsNoError) {
  TypedRaster r = slope(600);
  for (int row = 256; row < 512; ++row)  // more than the highest mountain, no mark
    for (int col = 256; col < 512; ++col)
      r.values[static_cast<std::size_t>(row) * 600 + col] = 20000;
  write_typed(path("dem.tif"), r);
  ElevationRaster raster = open();
  const InputIdentity read = raster.read(whole_of(raster.grid())).identity;
  EXPECT_EQ(raster.hashes_of({"1/1"}).at("1/1"), read.parts.at("1/1"));
}

TEST_F(Identity, NotANumberAndZeroHaveOneHashEach) {
  const std::vector<double> a{NAN, 0.0, 1.0, 2.0}, b{-NAN, -0.0, 1.0, 2.0};
  EXPECT_EQ(block_hashes(a, {0, 0, 2, 2}, 2, 2), block_hashes(b, {0, 0, 2, 2}, 2, 2));
}

TEST_F(Identity, TheHashOfTheReleaseFollowsItsGroundOnly) {
  TypedRaster r = slope(60);
  write_typed(path("dem.tif"), r);
  Scenario scene;
  scene.directory = folder().string();
  scene.terrain.raster = "dem.tif";
  scene.release.thickness_m = Uncertain(4);
  scene.release.box = ReleaseBox{{500200, 500250}, {4599700, 4599750}};
  const std::string before = load_scene_inputs(scene).release_hash;
  EXPECT_THAT(before, ::testing::MatchesRegex("sha256:[0-9a-f]{64}"));
  r.values[5 * 60 + 5] += 1;
  write_typed(path("dem.tif"), r);
  EXPECT_EQ(load_scene_inputs(scene).release_hash, before);
  r.values[27 * 60 + 22] += 1;
  write_typed(path("dem.tif"), r);
  EXPECT_NE(load_scene_inputs(scene).release_hash, before);
}

}  // namespace
}  // namespace sturz::test
