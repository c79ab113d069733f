// SPDX-License-Identifier: Apache-2.0
// The shipped template with a terrain and an outline put beside it: what every newcomer does first.
#include "tests/app/app_fixture.hpp"

namespace sturz::test {
namespace {

using ::testing::HasSubstr;

/// 80 m x 80 m on the upper slope of the Zhangjiawan-like ground, as a GIS writes it.
constexpr const char* outline = R"({"type": "FeatureCollection",
"crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::32648"}},
"features": [{"type": "Feature", "properties": {}, "geometry": {"type": "Polygon", "coordinates":
[[[500020, 2899960], [500100, 2899960], [500100, 2900040], [500020, 2900040], [500020, 2899960]]]}}]})";

class Template : public App {
 protected:
  Template() { EXPECT_EQ(sturz({"cases", "template", "-o", path("mine")}).exit_code, 0); }
  /// The two files that the template asks for, the outline under another name.
  void bring_data() const {
    const Ended ended = sturz({"terrain", "zhangjiawan", "--cell", "20", "-o", path("mine")});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    write("mine/source.geojson", outline);
    write("mine/scenario.yaml",
          replaced(read("mine/scenario.yaml"), "polygon: source.gpkg", "polygon: source.geojson"));
  }
};

TEST_F(Template, WithoutDataItSaysWhichFileIsMissing) {
  const Ended ended = sturz({"describe", path("mine/scenario.yaml")});
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.err, HasSubstr("terrain.raster"));
  EXPECT_THAT(ended.err, HasSubstr("elevation.tif"));
}

TEST_F(Template, WithARasterAndAPolygonItIsDescribedAsColumns) {
  bring_data();
  const Ended ended = sturz({"describe", path("mine/scenario.yaml"), "--json"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  const auto said = nlohmann::json::parse(ended.out);
  EXPECT_EQ(said.value("formulation", ""), "depth_averaged");
  EXPECT_NEAR(said.value("release_area_m2", 0.0), 6400, 1);
  EXPECT_NEAR(said.value("release_volume_m3", 0.0), 6400 * 6, 10) << "the median of 4 to 8 m";
  EXPECT_EQ(said.at("uncertain").size(), 3u);
}

TEST_F(Template, ItsEnsembleEndsWithMaps) {
  bring_data();
  const Ended ended = sturz({"ensemble", path("mine/scenario.yaml"), "-n", "2", "-o", path("out"),
                             "--set", "numerics.end_time_s=5", "--json"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_EQ(n_members("out"), 2u);
  EXPECT_TRUE(exists("out/hazard.nc"));
  EXPECT_TRUE(exists("out/report.html"));
}

}  // namespace
}  // namespace sturz::test
