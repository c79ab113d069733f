// SPDX-License-Identifier: Apache-2.0
// Maps, table and page from members that were stored earlier.
#include "ensemble/workflow/results/maps.hpp"

#include "engine/core/error.hpp"
#include "ensemble/hazard/stack_hash.hpp"
#include "ensemble/workflow/folder/finished_folder.hpp"
#include "ensemble/workflow/folder/saved_design.hpp"
#include "ensemble/workflow/results/report_page.hpp"
#include "io/netcdf/netcdf_layers.hpp"
#include "tests/workflow/workflow_fixture.hpp"

namespace sturz::test {
namespace {

using ::testing::HasSubstr;

class MapsWorkflow : public Workflow {};

TEST_F(MapsWorkflow, AreMadeAgainFromTheFolderAlone) {
  Recorder silent;
  const std::string hash = whole(request("out"), silent).hazard_hash;
  std::filesystem::remove(path("scene.yaml"));
  for (const char* file : {"out/hazard.nc", "out/members.csv", "out/report.html"})
    ASSERT_TRUE(std::filesystem::remove(path(file))) << file;

  workflow::FinishedFolder found = workflow::open_finished(path("out"), silent);
  const DesignTable design = workflow::saved_design(found.folder, found.manifest, found.scenario);
  const workflow::MapsMade made = workflow::make_maps(found.folder, found.manifest, found.scenario,
                                                      design, found.elevation.get(), silent);
  EXPECT_EQ(made.hazard_hash, hash);
  EXPECT_EQ(made.folder.root, path("out"));
  for (const char* file : {"out/hazard.nc", "out/members.csv", "out/report.html"})
    EXPECT_TRUE(exists(file)) << file;
  EXPECT_EQ(workflow::Manifest::read(found.folder.manifest()).hazard_hash, hash);
}

TEST_F(MapsWorkflow, FollowNewThresholdsWithoutNewMembers) {
  Recorder first, second;
  whole(request("out"), first);
  const std::string map = "out/hazard/probability_of_peak_thickness_above_threshold_";
  ASSERT_TRUE(exists(map + "0.5.tif"));
  workflow::EnsembleRequest other = request("out");
  other.scene = scene({"hazard.thickness_m=[0.75]"});
  whole(other, second);
  EXPECT_TRUE(second.members.empty());
  EXPECT_FALSE(exists(map + "0.5.tif"));
  EXPECT_TRUE(exists(map + "0.75.tif"));
}

TEST_F(MapsWorkflow, NeedAMember) {
  Recorder heard;
  workflow::EnsembleJob job = workflow::prepare_ensemble(request("out"), heard);
  EXPECT_THROW(workflow::make_maps(job, heard), SetupError);
}

TEST_F(MapsWorkflow, ThePageIsWrittenAgain) {
  Recorder silent;
  EXPECT_EQ(run(request("out"), silent).finished, n_tiny);
  EXPECT_THROW(workflow::rewrite_page(path("out"), silent), SetupError);  // no maps yet
  whole(request("out"), silent);
  const std::string page = read("out/report.html");
  std::filesystem::remove(path("out/report.html"));
  EXPECT_EQ(workflow::rewrite_page(path("out"), silent), path("out/report.html"));
  EXPECT_EQ(read("out/report.html"), page);
}

TEST(MapsMade, AcceptsTheStatedShareOfFailures) {
  workflow::MapsMade made;
  made.max_failed_fraction = 0.05;
  EXPECT_TRUE(made.too_many_failed()) << "no member at all";
  made.finished = 20;
  made.valid = 19;
  EXPECT_FALSE(made.too_many_failed());
  made.valid = 18;
  EXPECT_TRUE(made.too_many_failed());
}

}  // namespace
}  // namespace sturz::test
