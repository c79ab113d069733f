// SPDX-License-Identifier: Apache-2.0
// Bad input: one clear message, exit code 1, nothing computed, no results folder.
#include "tests/app/app_fixture.hpp"

namespace sturz::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class BadInput : public App {
 protected:
  /// `sturz ensemble` on a changed scene; checks everything that all bad input has in common.
  std::string message(const std::string& scene) {
    write("bad.yaml", scene);
    const Ended ended = sturz({"ensemble", path("bad.yaml"), "-o", path("out")});
    EXPECT_EQ(ended.exit_code, 1) << ended.err;
    EXPECT_FALSE(exists("out")) << "a results folder was made";
    EXPECT_THAT(ended.err, Not(HasSubstr("terminate called")));
    EXPECT_EQ(ended.out, "");
    return ended.err;
  }
};

TEST_F(BadInput, AMissingScenarioFileIsNamed) {
  const Ended ended = sturz({"ensemble", path("nowhere.yaml")});
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.err, HasSubstr("nowhere.yaml"));
}

TEST_F(BadInput, AnUnknownKeyIsNamedWithItsPlaceAndItsNeighbour) {
  const std::string text = message(replaced(tiny_scene(), "spacing_m", "spacing_mm"));
  EXPECT_THAT(text, HasSubstr("bad.yaml:11:12: numerics.spacing_mm (unknown key)"));
  EXPECT_THAT(text, HasSubstr("spacing_m?"));
}

TEST_F(BadInput, AUnitMistakeIsExplained) {
  const std::string text =
      message(replaced(tiny_scene(), "friction_angle_deg: 30", "friction_angle_deg: 240"));
  EXPECT_THAT(text, HasSubstr("bad.yaml:7:"));
  EXPECT_THAT(text, HasSubstr("grains.friction_angle_deg = 240"));
}

TEST_F(BadInput, ANegativeThicknessIsRefused) {
  EXPECT_THAT(message(replaced(tiny_scene(), "thickness_m: 3", "thickness_m: -3")),
              HasSubstr("release.thickness_m = -3"));
}

TEST_F(BadInput, AllProblemsAreToldTogether) {
  std::string scene = replaced(tiny_scene(), "thickness_m: 3", "thickness_m: -3");
  scene = replaced(scene, "friction_angle_deg: 30", "friction_angle_deg: 240");
  const std::string text = message(replaced(scene, "design: sobol", "design: sobel"));
  EXPECT_THAT(text, HasSubstr("release.thickness_m"));
  EXPECT_THAT(text, HasSubstr("grains.friction_angle_deg"));
  EXPECT_THAT(text, HasSubstr("ensemble.design"));
}

TEST_F(BadInput, AMissingRasterIsNamedWithItsKey) {
  const std::string text =
      message(replaced(tiny_scene(),
                       "synthetic: {plane: {cell_size_m: 2, slope_deg: 30, length_m: 120, "
                       "width_m: 50}}",
                       "raster: no_such_bed.tif"));
  EXPECT_THAT(text, HasSubstr("terrain.raster"));
  EXPECT_THAT(text, HasSubstr("no_such_bed.tif"));
}

TEST_F(BadInput, RawVirtualRastersNeedTheWordOfTheUser) {
  std::string bytes;  // 60 x 60 bytes that fall from 240 to 3 along x
  for (int row = 0; row < 60; ++row)
    for (int col = 0; col < 60; ++col) bytes += static_cast<char>(240 - 4 * col);
  write("raw.bin", bytes);
  write("raw.vrt",
        "<VRTDataset rasterXSize='60' rasterYSize='60'><SRS>EPSG:32633</SRS>"
        "<GeoTransform>-60,2,0,60,0,-2</GeoTransform>"
        "<VRTRasterBand dataType='Byte' band='1' subClass='VRTRawRasterBand'>"
        "<SourceFilename relativetoVRT='1'>raw.bin</SourceFilename><ImageOffset>0</ImageOffset>"
        "<PixelOffset>1</PixelOffset><LineOffset>60</LineOffset></VRTRasterBand></VRTDataset>");
  write("raw.yaml", replaced(tiny_scene(),
                             "synthetic: {plane: {cell_size_m: 2, slope_deg: 30, length_m: 120, "
                             "width_m: 50}}",
                             "raster: raw.vrt"));
  const Ended refused = sturz({"describe", path("raw.yaml")});
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_THAT(refused.err, HasSubstr("takes the bytes of raw.bin for values"));
  EXPECT_THAT(refused.err, HasSubstr("--allow-remote-inputs"));
  const Ended allowed = sturz({"describe", path("raw.yaml"), "--allow-remote-inputs"});
  EXPECT_EQ(allowed.exit_code, 0) << allowed.err;
}

TEST_F(BadInput, AReleaseOutsideTheTerrainIsRefused) {
  EXPECT_THAT(message(replaced(tiny_scene(), "x_m: [-50, -40]", "x_m: [-500, -490]")),
              HasSubstr("release"));
}

TEST_F(BadInput, AnOverrideOfAnUnknownKeyIsRefused) {
  const Ended ended = sturz({"ensemble", path("scene.yaml"), "-o", path("out"), "--set",
                             "basal.friction_coeficient=0.3"});
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.err, HasSubstr("basal.friction_coeficient"));
  EXPECT_THAT(ended.err, HasSubstr("basal.friction_coefficient?"));
  EXPECT_FALSE(exists("out"));
}

TEST_F(BadInput, AnOverrideOutOfRangeIsRefused) {
  const Ended ended = sturz(
      {"run", path("scene.yaml"), "-o", path("out"), "--set", "grains.friction_angle_deg=240"});
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.err, HasSubstr("grains.friction_angle_deg = 240"));
  EXPECT_FALSE(exists("out"));
}

TEST_F(BadInput, AShardThatCannotBeIsRefused) {
  for (const char* shard : {"0/2", "3/2", "1", "a/b", "1/0"}) {
    const Ended ended =
        sturz({"ensemble", path("scene.yaml"), "-o", path("out"), "--shard", shard});
    EXPECT_EQ(ended.exit_code, 1) << shard;
    EXPECT_THAT(ended.err, HasSubstr("shard")) << shard;
  }
  EXPECT_FALSE(exists("out"));
}

TEST_F(BadInput, AFolderOfSomethingElseIsLeftAlone) {
  std::filesystem::create_directory(path("out"));
  write("out/thesis.tex", "precious");
  const Ended ended = sturz({"ensemble", path("scene.yaml"), "-o", path("out")});
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.err, HasSubstr("thesis.tex"));
  EXPECT_FALSE(exists("out/scenario.yaml"));
}

TEST_F(BadInput, UsageErrorsEndWithOne) {
  EXPECT_EQ(sturz({}).exit_code, 1);
  EXPECT_EQ(sturz({"dance"}).exit_code, 1);
  EXPECT_EQ(sturz({"ensemble"}).exit_code, 1);
  EXPECT_EQ(sturz({"ensemble", path("scene.yaml"), "--members", "none"}).exit_code, 1);
}

}  // namespace
}  // namespace sturz::test
