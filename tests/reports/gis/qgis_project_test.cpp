// SPDX-License-Identifier: Apache-2.0
#include "reports/gis/qgis_project.hpp"

#include "reports/gis/qgis_style.hpp"
#include "reports/gis/stac_item.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace sturz {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

QgisProject project() {
  QgisProject p;
  p.title = "Hang <b> & \"Co\"\n";
  p.place = {4, 3, 1000, 2000, 10, "LOCAL"};
  p.epsg = 32633;
  p.groups = {{"Maps",
               {{"Reached", "hazard/P_reached.tif", "", {}, hillshade_symbology(), true},
                {"Areas", "hazard.gpkg", "P_reached", Shape::polygon, "<style/>", false}},
               false}};
  return p;
}

TEST(QgisProject, NamesFilesFromItsOwnFolder) {
  const std::string text = qgis_project(project());
  EXPECT_THAT(text, HasSubstr("<datasource>./hazard/P_reached.tif</datasource>"));
  EXPECT_THAT(text, HasSubstr("<datasource>./hazard.gpkg|layername=P_reached</datasource>"));
  EXPECT_THAT(text, HasSubstr("<Absolute type=\"bool\">false</Absolute>"));
  EXPECT_THAT(text, HasSubstr("<authid>EPSG:32633</authid>"));
  EXPECT_THAT(text, HasSubstr("<xmin>1000</xmin><ymin>1970</ymin><xmax>1040</xmax>"));
}

TEST(QgisProject, IsXmlWhateverTheTitle) {
  const std::string text = qgis_project(project());
  EXPECT_THAT(text, HasSubstr("<title>Hang &lt;b&gt; &amp; &quot;Co&quot; </title>"));
  EXPECT_THAT(text, Not(HasSubstr("<b>")));
}

TEST(QgisProject, ShowsWhatIsToBeShown) {
  const std::string text = qgis_project(project());
  EXPECT_THAT(text, HasSubstr("id=\"sturz_layer_hazard_P_reached_tif_0\" name=\"Reached\" "
                              "checked=\"Qt::Checked\""));
  EXPECT_THAT(text,
              HasSubstr("id=\"sturz_layer_P_reached_1\" name=\"Areas\" checked=\"Qt::Unchecked\""));
}

TEST(QgisProject, OfAMapWithoutASystemHasNone) {
  QgisProject local = project();
  local.place.crs_wkt.clear();
  local.epsg.reset();
  EXPECT_THAT(qgis_project(local), HasSubstr("<projectCrs><spatialrefsys/></projectCrs>"));
}

StacItem item() {
  StacItem i;
  i.id = "sturz-1";
  i.title = "title";
  i.datetime = "2026-01-31T12:00:00Z";
  i.grid = {4, 3, 1000, 2000, 10, "WKT"};
  i.outline = {{15, 41}, {16, 41}, {16, 42}, {15, 41}};
  i.assets = {{"a.tif", "hazard/a.tif", "A", "image/tiff", {"data"}, "kPa", true},
              {"b.gpkg", "b.gpkg", "B", "application/geopackage+sqlite3", {"data"}, "", false}};
  return i;
}

TEST(StacItem, HasABoxWithAGeometryAndNeitherWithoutAPlace) {
  const auto placed = nlohmann::json::parse(stac_item(item()));
  EXPECT_EQ(placed["bbox"], (nlohmann::json{15, 41, 16, 42}));
  EXPECT_EQ(placed["geometry"]["coordinates"][0].size(), 4U);
  EXPECT_TRUE(placed["properties"]["proj:epsg"].is_null());
  StacItem local = item();
  local.outline.clear();
  const auto nowhere = nlohmann::json::parse(stac_item(local));
  EXPECT_TRUE(nowhere["geometry"].is_null());
  EXPECT_FALSE(nowhere.contains("bbox"));
}

TEST(StacItem, TellsUnitAndNodataOfRastersAlone) {
  const auto all = nlohmann::json::parse(stac_item(item()));
  EXPECT_EQ(all["assets"]["a.tif"]["raster:bands"][0]["unit"], "kPa");
  EXPECT_EQ(all["assets"]["a.tif"]["href"], "./hazard/a.tif");
  EXPECT_FALSE(all["assets"]["b.gpkg"].contains("raster:bands"));
  EXPECT_EQ(all["properties"]["proj:shape"], (nlohmann::json{3, 4}));
  EXPECT_EQ(all["properties"]["proj:transform"],
            (nlohmann::json{10, 0, 1000, 0, -10, 2000, 0, 0, 1}));
}

}  // namespace
}  // namespace sturz
