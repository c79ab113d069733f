// SPDX-License-Identifier: Apache-2.0
// What an ensemble leaves for a GIS on a scene that lies nowhere on the earth; tests/gis opens that
// of one that does.
#include "ensemble/workflow/results/gis/gis_files.hpp"

#include "ensemble/workflow/members/member_stack.hpp"
#include "ensemble/workflow/members/single_run.hpp"
#include "io/features/cell_polygons.hpp"
#include "io/netcdf/netcdf_file.hpp"
#include "tests/workflow/workflow_fixture.hpp"

#include <cmath>

namespace sturz::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class GisWorkflow : public Workflow {
 protected:
  GisWorkflow() {
    write("scene.yaml",
          replaced(tiny_scene(), "formulation: full_stress", "formulation: depth_averaged"));
    Recorder silent;
    whole(request("out"), silent);
  }
};

TEST_F(GisWorkflow, FilesAreMadeWithoutAPlaceOnTheEarth) {
  for (const char* file : {"hazard.gpkg", "hazard.qgz", "ground.tif", "ground.qml"})
    EXPECT_TRUE(exists(std::string("out/") + file)) << file;
  EXPECT_THAT(read("out/stac_item.json"), HasSubstr("\"geometry\": null"));
  EXPECT_THAT(read("out/stac_item.json"), Not(HasSubstr("\"bbox\"")));
  EXPECT_THAT(read("out/stac_item.json"), HasSubstr("Maps of 6 simulations"));
}

TEST_F(GisWorkflow, NothingOfOursStaysWhereItIsRemoved) {
  write("out/mine.qgz", "mine");
  workflow::remove_gis_files({path("out")});
  for (const char* file :
       {"hazard.gpkg", "hazard.qgz", "ground.tif", "ground.qml", "stac_item.json"})
    EXPECT_FALSE(exists(std::string("out/") + file)) << file;
  EXPECT_TRUE(exists("out/mine.qgz"));
}

TEST_F(GisWorkflow, AKeyLeavesThemOutAndTakesThemAway) {
  write("scene.yaml",
        replaced(replaced(tiny_scene(), "formulation: full_stress", "formulation: depth_averaged"),
                 "hazard: {", "hazard: {gis_files: false, "));
  Recorder heard;
  whole(request("out"), heard);
  EXPECT_TRUE(heard.members.empty()) << "no member is computed for it";
  for (const char* file : {"hazard.gpkg", "hazard.qgz", "ground.tif", "stac_item.json",
                           "hazard/index.csv", "hazard/P_reached.tif", "hazard/P_reached.qml"})
    EXPECT_FALSE(exists(std::string("out/") + file)) << file;
  EXPECT_TRUE(exists("out/hazard.nc"));
}

TEST_F(GisWorkflow, ARunHasAProjectOfItsOwn) {
  Recorder heard;
  workflow::SingleRun run = workflow::prepare_run({scene(), path("run"), 1, {}, "test"}, heard);
  workflow::store_run(run, workflow::compute_run(run, heard, heard.cancel));
  for (const char* file : {"peaks.gpkg", "peaks.qgz", "ground.tif", "peaks/peak_thickness_m.tif",
                           "peaks/peak_thickness_m.qml", "peaks/index.csv"})
    EXPECT_TRUE(exists(std::string("run/") + file)) << file;
  EXPECT_FALSE(exists("run/hazard.qgz"));
  EXPECT_THAT(read("run/stac_item.json"), HasSubstr("peaks.nc"));
}

TEST_F(GisWorkflow, StoppedOutlinesLeaveNoPackage) {
  Recorder heard;
  const std::atomic<bool> stop{true};
  const Raster<std::uint8_t> cells{
      {.n_cols = 40, .n_rows = 40, .west_m = 0, .north_m = 0, .cell_m = 1, .crs_wkt = ""}, 1};
  EXPECT_THROW(classes_as_polygons(cells, stop), Cancelled);
  EXPECT_EQ(classes_as_polygons(cells).size(), 1U);
}

TEST_F(GisWorkflow, MembersAreStackedWithoutDegrees) {
  Recorder heard;
  const workflow::StackMade made =
      stack_members({path("out"), path("stack.nc"), "energy", 0.5}, heard);
  EXPECT_EQ(made.units, "kJ m-2");
  EXPECT_EQ(made.written.members, n_tiny);
  EXPECT_FALSE(made.written.has_place);
  const NetcdfReader file(path("stack.nc"));
  EXPECT_FALSE(file.has("latitude"));
  EXPECT_THAT(file.dimensions("intensity"), ::testing::ElementsAre("member", "y", "x"));
  const auto frequencies = file.doubles("frequency");
  ASSERT_EQ(frequencies.size(), 6U);
  EXPECT_DOUBLE_EQ(frequencies[5], 0.5 / 6);
}

TEST_F(GisWorkflow, AStoppedStackLeavesNothing) {
  Recorder heard;
  const std::atomic<bool> stop{true};
  EXPECT_THROW(stack_members({path("out"), path("stack.nc"), "thickness", 1}, heard, stop),
               Cancelled);
  for (const auto& entry : std::filesystem::directory_iterator(path(".")))
    EXPECT_THAT(entry.path().filename().string(), Not(HasSubstr("stack")));
}

}  // namespace
}  // namespace sturz::test
