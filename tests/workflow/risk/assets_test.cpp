// SPDX-License-Identifier: Apache-2.0
// Assets of an ensemble: table, GeoPackage and page, made anew without computing.
#include "ensemble/workflow/results/report_page.hpp"
#include "tests/workflow/workflow_fixture.hpp"

#include <sstream>

namespace sturz::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// On the tiny plane: a field around the release, a hut uphill of it where nothing comes, a place
/// beyond the terrain.
constexpr const char* layer = R"({"type": "FeatureCollection", "features": [
  {"type": "Feature", "properties": {"id": "field", "kind": "road", "worth": 1000},
   "geometry": {"type": "Polygon",
     "coordinates": [[[-48, -4], [-40, -4], [-40, 4], [-48, 4], [-48, -4]]]}},
  {"type": "Feature", "properties": {"id": "hut", "kind": "road", "worth": 50},
   "geometry": {"type": "Point", "coordinates": [-57, 20]}},
  {"type": "Feature", "properties": {"id": "away", "kind": "road", "worth": 7},
   "geometry": {"type": "Point", "coordinates": [5000, 0]}}]})";

constexpr const char* block =
    "assets:\n"
    "  features: assets.geojson\n"
    "  name_attribute: id\n"
    "  class_attribute: kind\n"
    "  vulnerability: curves.yaml\n"
    "  value_attribute: worth\n"
    "  value_unit: CHF\n";

class AssetsWorkflow : public Workflow {
 protected:
  static std::string columns() {
    return replaced(tiny_scene(), "formulation: full_stress", "formulation: depth_averaged");
  }
  AssetsWorkflow() {
    write("assets.geojson", layer);
    write("curves.yaml", "road: {thickness_m: [[0, 0], [10, 1]]}\n");
  }
};

TEST_F(AssetsWorkflow, TableGeoPackageAndPageAreWritten) {
  write("scene.yaml", columns() + block);
  Recorder heard;
  whole(request("out"), heard);
  std::istringstream csv(read("out/assets.csv"));
  std::string header, field, hut, away;
  for (std::string* line : {&header, &field, &hut, &away}) std::getline(csv, *line);
  EXPECT_THAT(header, HasSubstr("expected_loss_CHF"));
  EXPECT_THAT(field, HasSubstr("field,inside,road,1000,6,6,"));
  EXPECT_THAT(hut, HasSubstr("hut,inside,road,50,6,0,"));
  EXPECT_THAT(away, HasSubstr("away,outside,road,7,6,0,6,0,,"));
  EXPECT_TRUE(exists("out/assets.gpkg"));
  EXPECT_THAT(read("out/report.html"), HasSubstr("<section id=\"assets\">"));
  EXPECT_THAT(read("out/report.html"), HasSubstr("nothing is said of them: away"));
}

TEST_F(AssetsWorkflow, APageMadeAnewAndItsTableAreOfTheSameAssets) {
  write("scene.yaml", columns() + block);
  Recorder heard;
  whole(request("out"), heard);
  write("assets.geojson", replaced(layer, "\"hut\"", "\"barn\""));
  workflow::rewrite_page(path("out"), heard);
  EXPECT_THAT(read("out/report.html"), HasSubstr("barn"));
  EXPECT_THAT(read("out/assets.csv"), HasSubstr("\nbarn,inside,"));
}

TEST_F(AssetsWorkflow, TheBlockComesLaterAndGoesWithoutNewMembers) {
  write("scene.yaml", columns());
  Recorder first, second, third;
  const std::string hash = whole(request("out"), first).hazard_hash;
  EXPECT_FALSE(exists("out/assets.csv"));
  write("scene.yaml", columns() + block);
  EXPECT_EQ(whole(request("out"), second).hazard_hash, hash);
  EXPECT_TRUE(second.members.empty());
  EXPECT_TRUE(exists("out/assets.csv"));
  write("scene.yaml", columns());
  whole(request("out"), third);
  EXPECT_TRUE(third.members.empty());
  EXPECT_FALSE(exists("out/assets.csv"));
  EXPECT_FALSE(exists("out/assets.gpkg"));
  EXPECT_THAT(read("out/report.html"), Not(HasSubstr("<section id=\"assets\">")));
}

}  // namespace
}  // namespace sturz::test
