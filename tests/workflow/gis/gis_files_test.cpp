// SPDX-License-Identifier: Apache-2.0
// What an ensemble leaves for a GIS on a scene that lies nowhere on the earth; tests/gis opens that
// of one that does.
#include "ensemble/workflow/results/gis_files.hpp"

#include "ensemble/workflow/members/member_stack.hpp"
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
