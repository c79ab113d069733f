// SPDX-License-Identifier: Apache-2.0
#include "io/batch/scene_files.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>

namespace sturz {
namespace {

namespace fs = std::filesystem;

class SceneFiles : public ::testing::Test {
 protected:
  SceneFiles() {
    std::string name = (fs::temp_directory_path() / "sturz-stamps-XXXXXX").string();
    folder_ = mkdtemp(name.data());
    write("dem.asc", "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2\n3 4\n");
    scenario_.directory = folder_.string();
    scenario_.terrain.raster = "dem.asc";
  }
  ~SceneFiles() override { fs::remove_all(folder_); }
  SceneFiles(const SceneFiles&) = delete;
  SceneFiles& operator=(const SceneFiles&) = delete;
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }
  bool unchanged(const std::vector<FileStamp>& before) const {
    constexpr std::int64_t later_ns = 3'000'000'000;
    return are_unchanged(scenario_, before, now_ns() + later_ns);
  }

  fs::path folder_;
  Scenario scenario_;
};

TEST_F(SceneFiles, AnyChangeIsSeen) {
  const auto before = stamps_of(scenario_);
  ASSERT_TRUE(before);
  ASSERT_EQ(before->size(), 1u);
  EXPECT_TRUE(unchanged(*before));
  const auto time = fs::last_write_time(folder_ / "dem.asc");
  write("dem.asc", "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2\n3 5\n");
  fs::last_write_time(folder_ / "dem.asc", time);
  EXPECT_FALSE(unchanged(*before)) << "the same size and time of writing";
}

TEST_F(SceneFiles, ACompanionThatAppearsIsSeen) {
  const auto before = stamps_of(scenario_);
  ASSERT_TRUE(before);
  write("other.prj", "x");
  EXPECT_TRUE(unchanged(*before));
  write("dem.prj", "x");
  EXPECT_FALSE(unchanged(*before));
}

TEST_F(SceneFiles, AFreshFileIsNotTrusted) {
  const auto before = stamps_of(scenario_);
  ASSERT_TRUE(before);
  EXPECT_FALSE(are_unchanged(scenario_, *before, now_ns()));
}

TEST_F(SceneFiles, WhatIsNoFileCannotBeTold) {
  scenario_.terrain.raster = "/vsizip/dem.zip/dem.asc";
  EXPECT_FALSE(stamps_of(scenario_));
}

TEST_F(SceneFiles, PartsOfAVirtualRasterBelongToIt) {
  fs::create_directory(folder_ / "tiles");
  fs::rename(folder_ / "dem.asc", folder_ / "tiles" / "part.asc");
  write("all.vrt",
        "<VRTDataset rasterXSize=\"2\" rasterYSize=\"2\"><GeoTransform>0,1,0,2,0,-1"
        "</GeoTransform><VRTRasterBand dataType=\"Float32\" band=\"1\"><SimpleSource>"
        "<SourceFilename relativeToVRT=\"1\">tiles/part.asc</SourceFilename></SimpleSource>"
        "</VRTRasterBand></VRTDataset>");
  scenario_.terrain.raster = "all.vrt";
  const auto before = stamps_of(scenario_);
  ASSERT_TRUE(before);
  EXPECT_EQ(before->size(), 2u);
  EXPECT_TRUE(unchanged(*before));
  write("tiles/part.asc", "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2\n3 9\n");
  EXPECT_FALSE(unchanged(*before));
}

}  // namespace
}  // namespace sturz
