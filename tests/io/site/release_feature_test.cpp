// SPDX-License-Identifier: Apache-2.0
// One feature of a polygon layer as the source.
#include "io/gdal/gdal_vector.hpp"
#include "io/scenario/scenario_file.hpp"
#include "scenarios/catalogue.hpp"
#include "scenarios/checks/validate.hpp"
#include "scenarios/placement_seed.hpp"
#include "tests/io/io_fixture.hpp"

#include <algorithm>

namespace sturz::test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// One ring as the corners of a polygon.
std::string ring(const std::string& corners) {
  std::string text = "[";
  text += corners;
  return text += ']';
}

class ReleaseFeature : public IoTest {
 protected:
  void SetUp() override {
    IoTest::SetUp();
    write("source.geojson",
          collection(
              feature("Polygon", ring(square(0, 0, 20)), R"({"name": "scarp", "n": 7})") + "," +
              feature("Polygon", ring(square(50, 10, 30)), R"({"name": "cliff", "n": 9})") + "," +
              feature("Polygon", ring(square(10, 90, 40)), R"({"name": "twin", "n": 9})")));
    request.path = "source.geojson";
    request.directory = folder().string();
  }
  static Grid terrain() { return {40, 40, 499983.3, 4600211.7, 7, utm33_wkt()}; }
  PolygonRelease read(const std::string& name, const std::string& field) {
    request.feature = name;
    request.feature_field = field;
    return read_release_polygons(request, terrain());
  }
  std::string refusal(const std::string& name, const std::string& field) {
    return message_of([&] { read(name, field); });
  }

  PolygonRequest request;
};

TEST_F(ReleaseFeature, IsFoundByItsNumberOrByAField) {
  EXPECT_NEAR(read("", "").area_m2, 400 + 900 + 1600, 1e-6);
  EXPECT_NEAR(read("1", "").area_m2, 900, 1e-6);
  const PolygonRelease cliff = read("cliff", "name");
  EXPECT_NEAR(cliff.area_m2, 900, 1e-6);
  EXPECT_LT(cliff.pattern.grid.n_cells(), 50u) << "the pattern spans that feature alone";
  EXPECT_THAT(cliff.notes, IsEmpty());
  EXPECT_NEAR(read("7", "n").area_m2, 400, 1e-6) << "numbers are found by their text";
}

TEST_F(ReleaseFeature, OthersDoNotBelongToItsIdentity) {
  const std::string before = read("cliff", "name").identity.parts.at("features");
  EXPECT_NE(read("scarp", "name").identity.parts.at("features"), before);
  write("source.geojson",
        collection(feature("Polygon", ring(square(50, 10, 30)), R"({"name": "cliff"})")));
  EXPECT_EQ(read("cliff", "name").identity.parts.at("features"), before);
}

TEST_F(ReleaseFeature, AnUnknownOneIsToldWhatThereIs) {
  EXPECT_EQ(refusal("clif", "name"),
            "release.feature = clif: release.polygon = source.geojson has no feature with that "
            "name (did you mean cliff?). It has: scarp, cliff, twin.");
  EXPECT_THAT(refusal("9", ""), HasSubstr("no feature with that FID. It has: 0, 1, 2."));
  EXPECT_THAT(refusal("9", "n"), HasSubstr("features 1 and 2 of release.polygon = source.geojson "
                                           "both have that value of n"));
  EXPECT_THAT(refusal("cliff", "nam"), HasSubstr("release.feature_key = nam: release.polygon = "
                                                 "source.geojson has no such field. It has: name, "
                                                 "n."));
}

TEST_F(ReleaseFeature, ManyNamesAreNotAllListed) {
  std::string features;
  for (int i = 0; i < 40; ++i)
    features.append(i > 0 ? "," : "").append(feature("Polygon", ring(square(i, 0, 2))));
  write("source.geojson", collection(features));
  EXPECT_THAT(refusal("40", ""), HasSubstr("It has: 0, 1, 2, 3, 4, 5, 6, 7, ... (40 in all)."));
}

TEST_F(ReleaseFeature, PlacesOfParticlesDifferFromFeatureToFeature) {
  Scenario a, b;
  a.release.feature = "1";
  b.release.feature = "2";
  EXPECT_NE(placement_seed(a), placement_seed(b));
  EXPECT_EQ(placement_seed(Scenario{}), Scenario{}.ensemble.seed);
}

TEST_F(ReleaseFeature, IsOneOfAPolygonLayer) {
  Scenario s = pile();
  const auto messages = [&s] {
    std::string all;
    for (const auto& problem : validate(s)) all += problem.message + "\n";
    return all;
  };
  s.release.feature = "3";
  s.release.feature_key = "name";
  EXPECT_THAT(messages(), HasSubstr("release.feature (only release.polygon has"));
  s.release.feature.clear();
  EXPECT_THAT(messages(), HasSubstr("release.feature_key (says by what"));
  s.release = {};
  s.release.polygon = "a.gpkg";
  s.release.volume_attribute = "v";
  s.release.each_feature = true;
  EXPECT_EQ(messages(), "");
  s.release.feature = "3";
  EXPECT_THAT(messages(), HasSubstr("release.each_feature (release.feature names one"));
  s.release.thickness = ThicknessDirection::normal;
  EXPECT_THAT(messages(), HasSubstr("release.volume_attribute (its thickness is the volume over"));
}

TEST_F(ReleaseFeature, AVolumeOfItsOwnIsSpreadOverItsArea) {
  request.volume_attribute = "n";
  const PolygonRelease all = read("", "");
  EXPECT_TRUE(all.is_thickness);
  EXPECT_NEAR(all.volume_m3, 7 + 9 + 9, 1e-9);
  const PolygonRelease scarp = read("scarp", "name");
  EXPECT_NEAR(scarp.volume_m3, 7, 1e-12);
  EXPECT_NEAR(*std::max_element(scarp.pattern.values.begin(), scarp.pattern.values.end()),
              7.0 / 400, 1e-12);
  request.volume_attribute = "name";
  EXPECT_THAT(refusal("scarp", "name"), HasSubstr("(release.volume_attribute) holds no numbers"));
}

TEST_F(ReleaseFeature, ItsKeyIsText) {
  Scenario s = pile();
  s.release = {};
  s.release.polygon = "a.gpkg";
  s.release.thickness_m = Uncertain(2);
  s.release.feature = "007";
  s.release.feature_key = "no";
  write("s.yaml", write_scenario(s, folder()));
  EXPECT_EQ(read_scenario(path("s.yaml")).release.feature, "007") << "zeros at the front stay";
}

}  // namespace
}  // namespace sturz::test
