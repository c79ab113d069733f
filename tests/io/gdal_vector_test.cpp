// SPDX-License-Identifier: Apache-2.0
#include "io/gdal/gdal_vector.hpp"

#include "io/site/polygon_cover.hpp"
#include "tests/io/io_fixture.hpp"

#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

namespace sturz::test {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

double area(const Raster<double>& r) {
  return std::accumulate(r.values.begin(), r.values.end(), 0.0) * r.grid.cell_m * r.grid.cell_m;
}

class GdalVector : public IoTest {
 protected:
  /// 40 x 40 cells of 7 m: no polygon edge below falls on a cell edge.
  static Grid terrain() { return {40, 40, 499983.3, 4600211.7, 7, utm33_wkt()}; }

  PolygonRequest request(const std::string& text) const {
    write("source.geojson", text);
    PolygonRequest r;
    r.path = "source.geojson";
    r.directory = folder().string();
    return r;
  }
  PolygonRelease read(const std::string& text) const {
    return read_release_polygons(request(text), terrain());
  }
  std::string refusal(const PolygonRequest& r) const {
    return message_of([&] { read_release_polygons(r, terrain()); });
  }
};

TEST_F(GdalVector, SharesOfCellsSumToTheArea) {
  const PolygonRelease read =
      this->read(collection(feature("Polygon", "[" + square(10, 20, 123.4) + "]")));
  EXPECT_NEAR(read.area_m2, 123.4 * 123.4, 1e-6);
  EXPECT_NEAR(area(read.pattern) / read.area_m2, 1, 1e-9);
  EXPECT_FALSE(read.is_thickness);
  EXPECT_THAT(read.notes, IsEmpty());
  for (const double v : read.pattern.values) {
    EXPECT_GE(v, 0);
    EXPECT_LE(v, 1 + 1e-12);
  }
}

TEST_F(GdalVector, AHoleIsLeftOut) {
  const PolygonRelease read = this->read(
      collection(feature("Polygon", "[" + square(10, 20, 100) + "," + square(40, 50, 30) + "]")));
  EXPECT_NEAR(read.area_m2, 10000 - 900, 1e-6);
  EXPECT_NEAR(area(read.pattern) / read.area_m2, 1, 1e-9);
  const Grid& g = read.pattern.grid;
  EXPECT_EQ(read.pattern.at(g.row_of(4600065), g.col_of(500055)), 0);
  EXPECT_NEAR(read.pattern.at(g.row_of(4600030), g.col_of(500020)), 1, 1e-12);
}

TEST_F(GdalVector, MultiPolygonsAndSeveralFeaturesAddUp) {
  const PolygonRelease read = this->read(collection(
      feature("MultiPolygon", "[[" + square(0, 0, 20) + "],[" + square(50, 0, 30) + "]]") + "," +
      feature("Polygon", "[" + square(100, 100, 10) + "]")));
  EXPECT_NEAR(read.area_m2, 400 + 900 + 100, 1e-6);
  EXPECT_NEAR(area(read.pattern) / read.area_m2, 1, 1e-9);
}

TEST_F(GdalVector, OverlappingFeaturesCountOnce) {
  const PolygonRelease read =
      this->read(collection(feature("Polygon", "[" + square(0, 0, 20) + "]") + "," +
                            feature("Polygon", "[" + square(10, 0, 20) + "]")));
  EXPECT_NEAR(read.area_m2, 600, 1e-6);
  EXPECT_NEAR(area(read.pattern), 600, 1e-6);
  EXPECT_THAT(read.notes, Contains(HasSubstr("2 features overlap by 200 m2, which counts once")));
}

TEST_F(GdalVector, AThicknessAttributeMakesAThicknessRaster) {
  PolygonRequest r = request(
      collection(feature("Polygon", "[" + square(0, 0, 20) + "]", R"({"h": 2.5})") + "," +
                 feature("Polygon", "[" + square(20, 0, 20) + "]", R"({"h": 5})")));  // they touch
  r.thickness_attribute = "h";
  const PolygonRelease read = read_release_polygons(r, terrain());
  EXPECT_TRUE(read.is_thickness);
  EXPECT_NEAR(read.volume_m3, 400 * 2.5 + 400 * 5, 1e-6);
  EXPECT_NEAR(area(read.pattern) / read.volume_m3, 1, 1e-9);
  EXPECT_NEAR(read.area_m2, 800, 1e-6);
}

TEST_F(GdalVector, ThicknessAttributesAreChecked) {
  const auto with = [&](const std::string& properties, const std::string& name) {
    PolygonRequest r =
        request(collection(feature("Polygon", "[" + square(0, 0, 20) + "]", properties)));
    r.thickness_attribute = name;
    return refusal(r);
  };
  EXPECT_EQ(with(R"({"h": 2, "who": "x"})", "thick"),
            "release.polygon = source.geojson: has no field 'thick' (release.thickness_attribute). "
            "It has: h, who.");
  EXPECT_THAT(with(R"({"h": "two"})", "h"), HasSubstr("field 'h' (release.thickness_attribute) "
                                                      "holds no numbers but String"));
  EXPECT_THAT(with(R"({"h": -2.0})", "h"), HasSubstr("feature 0 has h = -2 (a thickness must be"));
  PolygonRequest r =
      request(collection(feature("Polygon", "[" + square(0, 0, 20) + "]", R"({"h": 2.5})") + "," +
                         feature("Polygon", "[" + square(10, 0, 20) + "]", R"({"h": 5})")));
  r.thickness_attribute = "h";
  EXPECT_EQ(refusal(r),
            "release.polygon = source.geojson: feature 0 and feature 1 overlap by 200 "
            "m2 (which 'h' holds there?). Cut one of them back.");
}

TEST_F(GdalVector, PolygonsInDegreesAreReprojected) {
  // The rectangle 500000..500200 x 4600000..4600150 of UTM 33, in degrees.
  const std::string ring =
      "[[15.0,41.551208],[15.002398,41.551208],[15.002398,41.552559],[15.0,41.552559],"
      "[15.0,41.551208]]";
  const PolygonRelease read =
      this->read(collection(feature("Polygon", "[" + ring + "]"), "OGC:1.3:CRS84"));
  EXPECT_NEAR(read.area_m2, 200 * 150, 100);
  EXPECT_NEAR(area(read.pattern) / read.area_m2, 1, 1e-9);
  EXPECT_THAT(read.notes, Contains(HasSubstr("reprojected from WGS 84")));
}

TEST_F(GdalVector, MetresWithoutASystemAreRefusedUnlessGiven) {
  // GeoJSON without a system is in degrees by its standard; these numbers are not.
  PolygonRequest r = request(collection(feature("Polygon", "[" + square(0, 0, 20) + "]"), ""));
  EXPECT_THAT(refusal(r), AllOf(HasSubstr("tagged as WGS 84"), HasSubstr("outside +-180/90"),
                                HasSubstr("release.crs: EPSG:xxxxx")));
  r.crs = "EPSG:32633";
  EXPECT_NEAR(read_release_polygons(r, terrain()).area_m2, 400, 1e-6);
}

TEST_F(GdalVector, ALayerWithoutASystemIsRefused) {
  write("source.csv",
        "id,WKT\n1,\"POLYGON((500000 4600000,500020 4600000,500020 4600020,500000 "
        "4600000))\"\n");
  PolygonRequest r;
  r.path = "source.csv";
  r.directory = folder().string();
  EXPECT_EQ(refusal(r),
            "release.polygon = source.csv: has no coordinate system (so the result could not be "
            "put on a map). Add `release.crs: EPSG:xxxxx`, the system of its coordinates.");
  r.crs = "EPSG:32633";
  EXPECT_NEAR(read_release_polygons(r, terrain()).area_m2, 200, 1e-6);
}

TEST_F(GdalVector, ASelfCrossingPolygonIsMendedAndNoted) {
  const std::string bow =
      "[[500010,4600010],[500050,4600050],[500050,4600010],[500010,4600050],[500010,4600010]]";
  const PolygonRelease read = this->read(collection(feature("Polygon", "[" + bow + "]")));
  EXPECT_NEAR(read.area_m2, 800, 1e-6);
  EXPECT_NEAR(area(read.pattern), 800, 1e-6);
  EXPECT_THAT(read.notes, Contains(AllOf(HasSubstr("feature 0 was not a valid polygon"),
                                         HasSubstr("mended, area 800 m2"))));
}

TEST_F(GdalVector, EmptyInputIsRefused) {
  EXPECT_EQ(refusal(request(collection(""))),
            "release.polygon = source.geojson: layer 'source' has no features (an empty release). "
            "Draw the release polygon.");
  EXPECT_THAT(refusal(request(collection(feature("Polygon", "[]")))),
              HasSubstr("feature 0 is empty (no polygon drawn)"));
  EXPECT_THAT(refusal(request(collection(
                  feature("Polygon", "[[[500000,4600000],[500050,4600000],[500000,4600000]]]")))),
              HasSubstr("feature 0"));
}

TEST_F(GdalVector, PointsAndLinesAreRefused) {
  EXPECT_EQ(refusal(request(collection(feature("Point", "[500000,4600000]")))),
            "release.polygon = source.geojson: feature 0 is a Point, not a polygon. Draw the "
            "release as polygons.");
  EXPECT_THAT(
      refusal(request(collection(feature("LineString", "[[500000,4600000],[500010,4600000]]")))),
      HasSubstr("feature 0 is a Line String, not a polygon"));
}

TEST_F(GdalVector, OutsideTheTerrainIsRefusedWithTheDistance) {
  const std::string text =
      refusal(request(collection(feature("Polygon", "[" + square(12563.3, 0, 20) + "]"))));
  EXPECT_EQ(text,
            "release.polygon = source.geojson: the release polygon (feature 0) lies 12.3 km "
            "outside the terrain (polygon x 512563.3 to 512583.3, y 4600000 to 4600020; terrain x "
            "499983.3 to 500263.3, y 4599931.7 to 4600211.7). Is its coordinate system right?");
  EXPECT_THAT(
      refusal(request(collection(feature("Polygon", "[" + square(253.3, 0, 20) + "]")))),
      HasSubstr("200 m2 (50 %) of the release polygon (feature 0) lie outside the terrain"));
}

TEST_F(GdalVector, LayersAreChosenByName) {
  const std::string gpkg = path("two.gpkg");
  write("a.geojson", collection(feature("Polygon", "[" + square(0, 0, 20) + "]")));
  write("b.geojson", collection(feature("Polygon", "[" + square(0, 0, 30) + "]")));
  if (shell("ogr2ogr -f GPKG " + gpkg + " " + path("a.geojson") + " -nln small").exit_code != 0)
    GTEST_SKIP() << "ogr2ogr is not installed";
  ASSERT_EQ(shell("ogr2ogr -update " + gpkg + " " + path("b.geojson") + " -nln large").exit_code,
            0);
  PolygonRequest r;
  r.path = gpkg;
  r.layer = "large";
  EXPECT_NEAR(read_release_polygons(r, terrain()).area_m2, 900, 1e-6);
  r.layer = "medium";
  EXPECT_THAT(refusal(r),
              HasSubstr("has no layer 'medium' (release.layer). It has: small, large."));
  r.layer = "";
  const PolygonRelease first = read_release_polygons(r, terrain());
  EXPECT_NEAR(first.area_m2, 400, 1e-6);
  EXPECT_THAT(first.notes, Contains(HasSubstr("layer 'small' is used, the first of small, large")));
}

TEST_F(GdalVector, AMissingFileIsRefused) {
  PolygonRequest r;
  r.path = "nowhere.gpkg";
  r.directory = folder().string();
  EXPECT_THAT(refusal(r), HasSubstr("release.polygon = nowhere.gpkg: no such file"));
}

TEST_F(GdalVector, ARealSquareKeepsItsArea) {
  const auto file = shared("data/marsicano_tinitaly/release_250m.geojson");
  if (file.empty()) GTEST_SKIP() << "shared data marsicano_tinitaly is not there";
  PolygonRequest r;
  r.path = file.string();
  const Grid tinitaly{600, 400, 403000, 4629500, 10, utm33_wkt()};
  const PolygonRelease read = read_release_polygons(r, tinitaly);
  EXPECT_NEAR(read.area_m2, 62500, 1e-6);
  EXPECT_NEAR(area(read.pattern), 62500, 62500e-6);
  int centres = 0;  // what a cell-centre test would take
  for (int row = 0; row < tinitaly.n_rows; ++row)
    for (int col = 0; col < tinitaly.n_cols; ++col)
      centres += tinitaly.x_center(col) > 405675 && tinitaly.x_center(col) < 405925 &&
                 tinitaly.y_center(row) > 4627725 && tinitaly.y_center(row) < 4627975;
  EXPECT_LT(centres * 100, 0.93 * 62500);
}

TEST(PolygonCover, RandomPolygonsKeepTheirArea) {
  std::mt19937 random(3);
  std::uniform_real_distribution<> radius(0.1, 1);
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<Vec2> star;
    for (int i = 0; i < 37; ++i) {
      const double angle = 2 * std::numbers::pi * i / 37, r = 40 * radius(random);
      star.emplace_back(1000050 + r * std::cos(angle), 5000050 + r * std::sin(angle));
    }
    if (trial % 2 == 0) std::reverse(star.begin(), star.end());  // any orientation
    PolygonCover cover(Grid{33, 33, 1000000.5, 5000099.5, 3, ""});
    cover.add_ring(star, 1);
    EXPECT_NEAR(area(cover.finish()) / std::abs(ring_area(star)), 1, 1e-9);
  }
}

TEST(PolygonCover, EachCellHoldsItsOwnShare) {
  PolygonCover cover(Grid{4, 4, 0, 4, 1, ""});
  const std::vector<Vec2> triangle{
      {0, 0}, {4, 0}, {0, 4}};  // half of the square, diagonal cells half
  cover.add_ring(triangle, 1);
  const Raster<double> share = cover.finish();
  for (int row = 0; row < 4; ++row)
    for (int col = 0; col < 4; ++col)
      EXPECT_NEAR(share.at(row, col), col < row ? 1 : (col == row ? 0.5 : 0), 1e-14);
}

}  // namespace
}  // namespace sturz::test
