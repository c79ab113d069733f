// SPDX-License-Identifier: Apache-2.0
#include "io/site/scene_inputs.hpp"

#include "io/gdal/cog.hpp"
#include "tests/io/io_fixture.hpp"

#include <cmath>
#include <numbers>
#include <numeric>

namespace sturz::test {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::StartsWith;

double integral(const Raster<double>& r) {
  return std::accumulate(r.values.begin(), r.values.end(), 0.0) * r.grid.cell_m * r.grid.cell_m;
}

/// By place: a release is held on the cells around it only.
double value_at(const Raster<double>& r, double x, double y) {
  return r.at(r.grid.row_of(y), r.grid.col_of(x));
}

class LoadSceneInputs : public IoTest {
 protected:
  LoadSceneInputs() {
    scene.directory = folder().string();
    scene.terrain.raster = "bed.tif";
    scene.release.thickness_m = Uncertain(4);
    write_geotiff(path("bed.tif"), plane(50, 40, 10, 500000, 4600400), {});
  }
  std::string refusal() const {
    return message_of([&] { load_scene_inputs(scene); });
  }
  Scenario scene;
};

TEST_F(LoadSceneInputs, BoxesCoverExactly) {
  scene.release.box = ReleaseBox{{500103, 500151.5}, {4600111, 4600147}};
  const SceneInputs in = load_scene_inputs(scene);
  EXPECT_EQ(in.pattern, ReleasePattern::cover);
  EXPECT_NEAR(in.source_area_m2, 48.5 * 36, 1e-9);
  EXPECT_NEAR(integral(*in.release), 48.5 * 36, 1e-6);
  EXPECT_EQ(in.source_volume_m3, 0);  // follows from thickness_m
  EXPECT_THAT(in.notes, Contains(AllOf(HasSubstr("release.box: area 1746 m2"),
                                       HasSubstr("x 4 m = 6984 m3, laid out 6984 m3"))));
}

TEST_F(LoadSceneInputs, ThicknessNormalToTheSlopeHoldsForFieldsRastersAndShapes) {
  Raster<double> steep(Grid{40, 40, 500000, 4600400, 10, utm33_wkt()});
  for (int r = 0; r < 40; ++r)
    for (int c = 0; c < 40; ++c) steep.at(r, c) = 10.0 * r;  // 45 degrees, down to the north
  write_geotiff(path("bed.tif"), steep, {});
  write("src.geojson",
        collection(feature("Polygon", "[" + square(100, 100, 100) + "]", R"({"h": 1})")));
  Raster<double> h(Grid{20, 20, 500100, 4600200, 5, utm33_wkt()}, 1.0);
  write_geotiff(path("h.tif"), h, {});
  scene.release.thickness = ThicknessDirection::normal;
  Scenario field = scene, raster = scene, box = scene;
  field.release.thickness_m.reset();
  field.release.polygon = "src.geojson";
  field.release.thickness_attribute = "h";
  raster.release.thickness_m.reset();
  raster.release.thickness_raster = "h.tif";
  box.release.thickness_m = Uncertain(1);
  box.release.box = ReleaseBox{{500100, 500200}, {4600100, 4600200}};
  for (const Scenario& s : {field, raster, box}) {
    const SceneInputs in = load_scene_inputs(s);
    EXPECT_NEAR(integral(*in.release), 1e4 * std::numbers::sqrt2, 1e-3);
    EXPECT_THAT(in.notes, Contains(HasSubstr("10000 m3 with vertical thicknesses, 14142 m3 with")));
  }
  EXPECT_NEAR(load_scene_inputs(field).source_volume_m3, 1e4 * std::numbers::sqrt2, 1e-3);
}

TEST_F(LoadSceneInputs, CylindersCoverExactly) {
  scene.release.cylinder = ReleaseCylinder{{500203.3, 4600188.8}, 33.3};
  const SceneInputs in = load_scene_inputs(scene);
  const double exact = std::numbers::pi * 33.3 * 33.3;
  EXPECT_NEAR(in.source_area_m2, exact, 1e-9);
  EXPECT_NEAR(integral(*in.release) / exact, 1, 1e-9);
  EXPECT_NEAR(value_at(*in.release, 500205, 4600185), 1, 1e-12);
}

TEST_F(LoadSceneInputs, ParaboloidsHoldTheirVolumeAndShape) {
  scene.release.paraboloid = ReleaseParaboloid{{500205, 4600195}, {80, 45}};
  const SceneInputs in = load_scene_inputs(scene);
  EXPECT_NEAR(in.source_area_m2, std::numbers::pi * 80 * 45, 1e-9);
  EXPECT_NEAR(integral(*in.release), std::numbers::pi * 80 * 45 / 2, 1e-6);
  // The central cell's mean: 1 - cell^2/12 (1/a^2 + 1/b^2).
  EXPECT_NEAR(value_at(*in.release, 500205, 4600195), 1 - 100.0 / 12 * (1.0 / 6400 + 1.0 / 2025),
              1e-3);
}

TEST_F(LoadSceneInputs, SourcesBeyondTheTerrainAreRefused) {
  scene.release.box = ReleaseBox{{500400, 500520}, {4600111, 4600147}};
  EXPECT_THAT(refusal(), StartsWith("release.box: reaches 20 m beyond the terrain (source x 500400 "
                                    "to 500520"));
  scene.release.box.reset();
  scene.release.cylinder = ReleaseCylinder{{500010, 4600188}, 33};
  EXPECT_THAT(refusal(), StartsWith("release.cylinder: reaches 23 m beyond the terrain"));
  scene.release.cylinder.reset();
  scene.release.paraboloid = ReleaseParaboloid{{500205, 4600395}, {80, 45}};
  EXPECT_THAT(refusal(), StartsWith("release.paraboloid: reaches 40 m beyond the terrain"));
}

TEST_F(LoadSceneInputs, NodataUnderTheReleaseIsRefused) {
  Raster<double> bed = plane(50, 40, 10, 500000, 4600400);
  bed.at(25, 12) = bed.at(25, 13) = nan_d;
  write_geotiff(path("bed.tif"), bed, {});
  scene.release.box = ReleaseBox{{500100, 500150}, {4600100, 4600200}};
  EXPECT_EQ(refusal(),
            "release.box: lies on 2 nodata cells of terrain.raster = bed.tif, the first at row 25, "
            "column 12 (x 500125, y 4600145). Fill the terrain there or move the release.");
}

TEST_F(LoadSceneInputs, HazardGridsHaveTheTerrainsExtent) {
  scene.release.box = ReleaseBox{{500103, 500151.5}, {4600111, 4600147}};
  EXPECT_TRUE(load_scene_inputs(scene).hazard_grid.same_place({50, 40, 500000, 4600400, 10, ""}));
  scene.hazard.cell_size_m = 5;
  EXPECT_TRUE(load_scene_inputs(scene).hazard_grid.same_place({100, 80, 500000, 4600400, 5, ""}));
  scene.hazard.cell_size_m = 30;  // does not divide 500: one cell more
  const Grid grid = load_scene_inputs(scene).hazard_grid;
  EXPECT_TRUE(grid.same_place({17, 14, 500000, 4600400, 30, ""}));
  EXPECT_THAT(grid.crs_wkt, HasSubstr("UTM zone 33N"));
}

TEST_F(LoadSceneInputs, IdentitiesNameEveryFileAndFollowItsValues) {
  Raster<double> h = plane(10, 10, 10, 500100, 4600300);
  write_geotiff(path("h.tif"), h, {});
  scene.release.thickness_raster = "h.tif";
  scene.release.thickness_m.reset();
  const auto first = load_scene_inputs(scene).identities;
  ASSERT_EQ(first.size(), 2U);
  EXPECT_EQ(first[0].file, "bed.tif");
  EXPECT_EQ(first[0].role, "terrain.raster");
  EXPECT_EQ(first[1].file, "h.tif");
  EXPECT_EQ(first[1].role, "release.thickness_raster");
  h.values[0] += 1;
  write_geotiff(path("h.tif"), h, {});
  const auto second = load_scene_inputs(scene).identities;
  EXPECT_EQ(second[0], first[0]);
  EXPECT_NE(second[1], first[1]);
}

TEST_F(LoadSceneInputs, ThicknessRastersKeepTheirVolume) {
  write_geotiff(path("h.tif"), plane(10, 10, 7.7, 500101.1, 4600301.1), {});
  scene.release.thickness_raster = "h.tif";
  scene.release.thickness_m.reset();
  const SceneInputs in = load_scene_inputs(scene);
  EXPECT_EQ(in.pattern, ReleasePattern::thickness);
  EXPECT_NEAR(integral(*in.release) / in.source_volume_m3, 1, 1e-9);
}

TEST_F(LoadSceneInputs, PolygonsSayAreaAndLaidOutVolume) {
  write("source.geojson",
        R"({"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"EPSG:32633"}},
"features":[{"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":
[[[500103,4600103],[500203,4600103],[500203,4600203],[500103,4600103]]]}}]})");
  scene.release.polygon = "source.geojson";
  const SceneInputs in = load_scene_inputs(scene);
  EXPECT_NEAR(in.source_area_m2, 5000, 1e-6);
  EXPECT_THAT(in.notes, Contains(HasSubstr("x 4 m = 20000 m3, laid out 20000 m3")));
  EXPECT_THAT(in.notes, Contains(HasSubstr("m2 (+0 %)"))) << "what rounding leaves is none";
}

TEST_F(LoadSceneInputs, SyntheticTerrainsBringTheirOwnSource) {
  Scenario synthetic;
  synthetic.terrain.synthetic = SyntheticTerrain{"zhangjiawan", 10, {}};
  const SceneInputs in = load_scene_inputs(synthetic);
  EXPECT_EQ(in.pattern, ReleasePattern::thickness);
  EXPECT_GT(in.source_volume_m3, 1e5);
  EXPECT_NEAR(integral(*in.release), in.source_volume_m3, 1e-6 * in.source_volume_m3);
  EXPECT_TRUE(in.release->grid.same_place(in.elevation->grid));
  EXPECT_TRUE(in.identities.empty());
  synthetic.terrain.crs = "EPSG:32648";
  EXPECT_THAT(load_scene_inputs(synthetic).hazard_grid.crs_wkt, HasSubstr("UTM zone 48N"));
}

TEST_F(LoadSceneInputs, NoSourceIsRefused) {
  EXPECT_THAT(refusal(), StartsWith("release: names no source"));
}

TEST_F(LoadSceneInputs, RealSceneWithoutSystemsTakesTheOneGiven) {
  const auto bed = shared("data/s1000_sthelens/pre_runout_DEM.asc");
  if (bed.empty()) GTEST_SKIP() << "shared data s1000_sthelens is not there";
  scene.terrain.raster = bed.string();
  scene.release.thickness_raster = shared("data/s1000_sthelens/landslide_depth.asc").string();
  scene.release.thickness_factor = -1;  // the file counts depths downwards
  scene.release.thickness_m.reset();
  EXPECT_THAT(refusal(), HasSubstr("has no coordinate system"));
  scene.terrain.crs = "EPSG:32149";
  const SceneInputs in = load_scene_inputs(scene);
  EXPECT_NEAR(in.source_volume_m3, 22481, 1);
  EXPECT_NEAR(integral(*in.release), 22481, 1);
  EXPECT_THAT(in.hazard_grid.crs_wkt, HasSubstr("32149"));
}

TEST_F(LoadSceneInputs, RealSceneWithAPolygonLosesNoArea) {
  const auto bed = shared("data/marsicano_tinitaly/marsicano_10m.tif");
  if (bed.empty()) GTEST_SKIP() << "shared data marsicano_tinitaly is not there";
  scene.directory = bed.parent_path().string();
  scene.terrain.raster = "marsicano_10m.tif";
  scene.release.polygon = "release_250m.geojson";
  const SceneInputs in = load_scene_inputs(scene);
  EXPECT_NEAR(in.source_area_m2, 62500, 1e-6);
  EXPECT_NEAR(integral(*in.release), 62500, 62500e-6);
  EXPECT_EQ(in.identities[0].file, "marsicano_10m.tif");
}

}  // namespace
}  // namespace sturz::test
