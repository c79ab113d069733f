// SPDX-License-Identifier: Apache-2.0
// Layers with styles, shapes, classes of cells, places in degrees, and the archive of a project.
#include "io/features/cell_polygons.hpp"
#include "io/features/feature_file.hpp"
#include "io/features/geographic.hpp"
#include "io/features/shapes.hpp"
#include "io/features/zip_file.hpp"
#include "io/files/text_files.hpp"
#include "io/gdal/crs.hpp"
#include "tests/io/io_fixture.hpp"

#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <memory>

namespace sturz::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class GeoPackages : public IoTest {
 protected:
  static FeatureTable table(const std::string& name, std::vector<std::string> wkb) {
    FeatureTable t{name, utm33_wkt(), std::move(wkb), {}};
    t.columns = {{"length_m", std::vector<double>(t.wkb.size(), nan_d)}};
    return t;
  }
  std::unique_ptr<GDALDataset> open(const std::string& name) const {
    return std::unique_ptr<GDALDataset>(
        GDALDataset::Open(path(name).c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY));
  }
};

const std::vector<Vec2> box{{0, 0}, {10, 0}, {10, 10}, {0, 10}, {0, 0}};
const std::vector<Vec2> hole{{2, 2}, {2, 4}, {4, 4}, {4, 2}, {2, 2}};

TEST_F(GeoPackages, LayersHaveOneShapeWhereTheirFeaturesHave) {
  OGRPolygon single;
  GeoPackage package(path("a.gpkg"));
  package.add(table("points", {point_as_wkb({1, 2})}));
  package.add(table("lines", {line_as_wkb({{0, 0}, {3, 4}})}));
  package.add(table("areas", {rings_as_wkb({box, hole})}));
  package.add(table("mixed", {point_as_wkb({1, 2}), line_as_wkb({{0, 0}, {3, 4}})}));
  package.commit();
  const auto file = open("a.gpkg");
  ASSERT_NE(file, nullptr);
  EXPECT_EQ(file->GetLayerByName("points")->GetGeomType(), wkbPoint);
  EXPECT_EQ(file->GetLayerByName("lines")->GetGeomType(), wkbLineString);
  EXPECT_EQ(file->GetLayerByName("areas")->GetGeomType(), wkbMultiPolygon);
  EXPECT_EQ(file->GetLayerByName("mixed")->GetGeomType(), wkbUnknown);
  EXPECT_EQ(file->GetLayerByName("layer_styles"), nullptr) << "no style, no table of styles";
  const OGRFeatureUniquePtr area(file->GetLayerByName("areas")->GetNextFeature());
  EXPECT_DOUBLE_EQ(area->GetGeometryRef()->toMultiPolygon()->get_Area(), 96) << "a hole is one";
  EXPECT_TRUE(area->IsFieldNull(0));
}

TEST_F(GeoPackages, StylesGoWhereQgisLooksForThem) {
  GeoPackage package(path("a.gpkg"));
  package.add(table("points", {point_as_wkb({1, 2})}), "<qgis/>");
  package.add(table("lines", {line_as_wkb({{0, 0}, {3, 4}})}));
  package.commit();
  const auto file = open("a.gpkg");
  OGRLayer* styles = file->GetLayerByName("layer_styles");
  ASSERT_NE(styles, nullptr);
  ASSERT_EQ(styles->GetFeatureCount(), 1);
  const OGRFeatureUniquePtr style(styles->GetNextFeature());
  EXPECT_STREQ(style->GetFieldAsString("f_table_name"), "points");
  EXPECT_STREQ(style->GetFieldAsString("f_geometry_column"), "geom");
  EXPECT_TRUE(style->IsFieldSetAndNotNull(style->GetFieldIndex("f_table_schema")));
  EXPECT_STREQ(style->GetFieldAsString("styleQML"), "<qgis/>");
  EXPECT_EQ(style->GetFieldAsInteger("useAsDefault"), 1);
}

TEST_F(GeoPackages, TheSameTablesGiveTheSameBytesAndNothingComesHalf) {
  for (const char* name : {"a.gpkg", "b.gpkg"}) {
    GeoPackage package(path(name));
    package.add(table("points", {point_as_wkb({1, 2})}), "<qgis/>");
    package.commit();
  }
  EXPECT_EQ(read_text(path("a.gpkg")), read_text(path("b.gpkg")));
  {
    GeoPackage given_up(path("c.gpkg"));
    given_up.add(table("points", {point_as_wkb({1, 2})}));
  }
  GeoPackage broken(path("d.gpkg"));
  EXPECT_THAT(message_of([&] { broken.add(table("points", {"no geometry"})); }),
              HasSubstr("d.gpkg: cannot be made"));
  EXPECT_THAT(names(), ElementsAre("a.gpkg", "b.gpkg"));
}

TEST_F(GeoPackages, ClassesOfCellsAreAreasOfTheirOwn) {
  Raster<std::uint8_t> cells(Grid{5, 4, 100, 50, 2, ""});
  cells.at(0, 0) = cells.at(0, 1) = 3;
  cells.at(1, 1) = cells.at(3, 4) = 7;
  const auto areas = classes_as_polygons(cells);
  ASSERT_EQ(areas.size(), 2U);
  for (const auto& [value, n_polygons] : {std::pair{3, 1}, std::pair{7, 2}}) {
    OGRGeometry* read = nullptr;
    const std::string& wkb = areas.at(static_cast<std::uint8_t>(value));
    ASSERT_EQ(OGRGeometryFactory::createFromWkb(wkb.data(), nullptr, &read, wkb.size()),
              OGRERR_NONE);
    const std::unique_ptr<OGRGeometry> area(read);
    EXPECT_EQ(area->toMultiPolygon()->getNumGeometries(), n_polygons);
    EXPECT_DOUBLE_EQ(area->toMultiPolygon()->get_Area(), 8);
    EXPECT_TRUE(area->IsValid());
  }
}

TEST_F(GeoPackages, APlaceInDegrees) {
  // On the central meridian of zone 33, 15 degrees east; northing of 42 degrees on WGS 84.
  const Geographic geographic(utm33_wkt());
  ASSERT_TRUE(geographic.is_known());
  std::vector<double> x{500000}, y{4649776.22};
  geographic.transform(x, y);
  EXPECT_NEAR(x[0], 15, 1e-9);
  EXPECT_NEAR(y[0], 42, 1e-7);
  const auto ring = geographic_outline({10, 20, 500000, 4650000, 10, utm33_wkt()});
  ASSERT_EQ(ring.size(), 33U);
  EXPECT_EQ(ring.front(), ring.back());
  EXPECT_TRUE(geographic_outline({10, 20, 0, 0, 10, ""}).empty());
  EXPECT_EQ(epsg_code(utm33_wkt()), 32633);
  EXPECT_EQ(epsg_code(""), std::nullopt);
}

TEST_F(GeoPackages, OtherBodiesAreNoPlaceInDegreesAndNoError) {
  for (const char* system : {"IAU_2015:30110", "IAU_2015:49910", "+proj=eqc +R=1737400 +units=m"}) {
    const std::string wkt = crs_wkt2(parse_crs(system, "test"));
    ASSERT_FALSE(wkt.empty()) << system;
    EXPECT_FALSE(Geographic(wkt).is_known()) << system;
    EXPECT_TRUE(geographic_outline({10, 20, 0, 0, 10, wkt}).empty()) << system;
  }
}

TEST_F(GeoPackages, AnArchiveHoldsItsTextAndNoTime) {
  write_zip(path("a.qgz"), "hazard.qgs", "<qgis/>");
  write_zip(path("b.qgz"), "hazard.qgs", "<qgis/>");
  EXPECT_EQ(read_text(path("a.qgz")), read_text(path("b.qgz")));
  const std::string inside = "/vsizip/{" + path("a.qgz") + "}/hazard.qgs";
  VSILFILE* file = VSIFOpenL(inside.c_str(), "rb");
  ASSERT_NE(file, nullptr);
  std::string text(100, ' ');
  text.resize(VSIFReadL(text.data(), 1, text.size(), file));
  VSIFCloseL(file);
  EXPECT_EQ(text, "<qgis/>");
  EXPECT_THAT(names(), ElementsAre("a.qgz", "b.qgz"));
}

}  // namespace
}  // namespace sturz::test
