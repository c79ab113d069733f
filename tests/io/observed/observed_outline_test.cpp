// SPDX-License-Identifier: Apache-2.0
// The outline of a mapped event, from its file to the terrain's system.
#include "io/site/observed/observed_outline.hpp"

#include "io/site/scene_inputs.hpp"
#include "tests/io/io_fixture.hpp"

#include <algorithm>

namespace sturz::test {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class ObservedInputs : public SceneOnAPlane {
 protected:
  SceneInputs load(const std::string& text) {
    write("mapped.geojson", text);
    scene.hazard.observed_polygon = "mapped.geojson";
    return load_scene_inputs(scene);
  }
};

TEST_F(ObservedInputs, RingsAreThoseOfTheFileHolesToo) {
  const std::string ring = "[" + square(50, 60, 200) + "," + square(100, 100, 30) + "]";
  const SceneInputs in = load(collection(feature("Polygon", ring)));
  ASSERT_EQ(in.observed.size(), 2U);
  const auto& outer = in.observed[0];
  ASSERT_EQ(outer.size(), 5U);
  EXPECT_EQ(outer.front(), outer.back());
  EXPECT_TRUE(std::count(outer.begin(), outer.end(), Vec2(500250, 4600260)) > 0);
  EXPECT_THAT(in.notes, Contains("hazard.observed_polygon = mapped.geojson: area 39100 m2"));
  EXPECT_EQ(in.identities.back().role, "hazard.observed_polygon");
}

TEST_F(ObservedInputs, AnotherSystemIsReprojected) {
  // The same place in degrees; without a system GeoJSON is WGS84.
  const std::string ring =
      "[[[15.001,41.5525],[15.003,41.5525],[15.003,41.5535],[15.001,41.5535],[15.001,41.5525]]]";
  const SceneInputs in = load(collection(feature("Polygon", ring), ""));
  ASSERT_EQ(in.observed.size(), 1U);
  for (const Vec2& p : in.observed[0]) {
    EXPECT_GT(p.x(), 500080);
    EXPECT_LT(p.x(), 500255);
    EXPECT_GT(p.y(), 4600000);
    EXPECT_LT(p.y(), 4600400);
  }
  EXPECT_THAT(in.notes, Contains(AllOf(StartsWith("hazard.observed_polygon"),
                                       HasSubstr("reprojected from WGS 84"))));
}

TEST_F(ObservedInputs, MembersDoNotDependOnIt) {
  const SceneInputs without = load_scene_inputs(scene);
  EXPECT_TRUE(without.observed.empty());
  const SceneInputs with = load(collection(feature("Polygon", "[" + square(0, 0, 90) + "]")));
  EXPECT_EQ(with.release_hash, without.release_hash);
  EXPECT_EQ(with.identities.size(), without.identities.size() + 1);
}

TEST_F(ObservedInputs, WhatCannotBeDrawnIsRefusedWithTheOtherProblems) {
  EXPECT_THAT(
      message_of([&] { load(collection(feature("Polygon", "[" + square(9000, 0, 90) + "]"))); }),
      AllOf(HasSubstr("hazard.observed_polygon = mapped.geojson: lies beyond the terrain"),
            HasSubstr("Is its coordinate system right?")));
  const std::string line = feature("LineString", "[[500010,4600010],[500090,4600010]]");
  scene.basal.zones.push_back({"missing.gpkg", "", 0.3, {}, {}});
  EXPECT_THAT(message_of([&] { load(collection(line)); }),
              AllOf(HasSubstr("Draw the observed outline as polygons"),
                    HasSubstr("basal.zones[0].polygon = missing.gpkg")));
  scene.terrain.raster = "none.tif";
  EXPECT_THAT(message_of([&] { load(collection(line)); }),
              AllOf(HasSubstr("terrain.raster = none.tif"),
                    HasSubstr("Draw the observed outline as polygons")));
}

}  // namespace
}  // namespace sturz::test
