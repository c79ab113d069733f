// SPDX-License-Identifier: Apache-2.0
// Maps, table and page from members that were stored earlier.
#include "ensemble/workflow/results/maps.hpp"

#include "engine/core/cancel.hpp"
#include "engine/core/error.hpp"
#include "ensemble/hazard/stack_hash.hpp"
#include "ensemble/workflow/folder/finished_folder.hpp"
#include "ensemble/workflow/folder/folder_members.hpp"
#include "ensemble/workflow/folder/saved_design.hpp"
#include "ensemble/workflow/results/report_page.hpp"
#include "io/netcdf/netcdf_layers.hpp"
#include "tests/workflow/workflow_fixture.hpp"

#include <atomic>
#include <chrono>
#include <thread>

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
  const MemberStore store = workflow::members_of(found.folder, found.manifest, design);
  const workflow::MapsMade made = workflow::make_maps(
      {found.folder, found.manifest, found.scenario, design, *found.inputs}, store, silent);
  EXPECT_EQ(made.hazard_hash, hash);
  EXPECT_EQ(made.folder.root, path("out"));
  for (const char* file : {"out/hazard.nc", "out/members.csv", "out/report.html"})
    EXPECT_TRUE(exists(file)) << file;
  EXPECT_EQ(workflow::Manifest::read(found.folder.manifest()).hazard_hash, hash);
}

TEST_F(MapsWorkflow, FollowNewThresholdsWithoutNewMembers) {
  Recorder first, second;
  whole(request("out"), first);
  const std::string map = "out/hazard/P_thickness_gt_";
  ASSERT_TRUE(exists(map + "0.5m.tif"));
  workflow::EnsembleRequest other = request("out");
  other.scene = scene({"hazard.thickness_m=[0.75]"});
  whole(other, second);
  EXPECT_TRUE(second.members.empty());
  EXPECT_FALSE(exists(map + "0.5m.tif"));
  EXPECT_TRUE(exists(map + "0.75m.tif"));
}

TEST_F(MapsWorkflow, LeaveFilesOfOthersAlone) {
  Recorder silent;
  whole(request("out"), silent);
  write("out/hazard/mine.tif", "mine");
  write("out/hazard/index_of_mine.csv", "mine");
  workflow::EnsembleRequest other = request("out");
  other.scene = scene({"hazard.thickness_m=[0.75]"});
  whole(other, silent);
  EXPECT_EQ(read("out/hazard/mine.tif"), "mine");
  EXPECT_TRUE(exists("out/hazard/index_of_mine.csv"));
}

TEST_F(MapsWorkflow, AnEditedListRemovesNothingElsewhere) {
  Recorder silent;
  whole(request("out"), silent);
  write("out/keep.tif", "mine");
  write("out/hazard/index.csv", read("out/hazard/index.csv") + "../keep.tif,x,x,x,x,x,x,x,x\n" +
                                    path("out/keep.tif").string() + ",x,x,x,x,x,x,x,x\n");
  whole(request("out"), silent);
  EXPECT_EQ(read("out/keep.tif"), "mine");
}

TEST_F(MapsWorkflow, EveryMapHasItsStyleAndItsLine) {
  Recorder silent;
  whole(request("out"), silent);
  std::size_t n_maps = 0;
  const std::string index = read("out/hazard/index.csv");
  for (const auto& entry : std::filesystem::recursive_directory_iterator(path("out/hazard"))) {
    if (entry.path().extension() != ".tif") continue;
    ++n_maps;
    EXPECT_TRUE(
        std::filesystem::exists(std::filesystem::path(entry.path()).replace_extension("qml")))
        << entry.path();
    EXPECT_THAT(index, HasSubstr(entry.path().filename().string() + ","));
  }
  EXPECT_GT(n_maps, 20U);
  EXPECT_TRUE(exists("out/hazard/P_reached.tif"));
  EXPECT_TRUE(exists("out/hazard/bounds/P_reached_upper.tif"));
}

/// Names of everything below the folder that is not finished.
std::vector<std::string> parts(const std::filesystem::path& folder) {
  std::vector<std::string> found;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".part") found.push_back(entry.path().string());
  return found;
}

TEST_F(MapsWorkflow, StopWhenToldLeaveNoPartsAndGiveTheSameBitsLater) {
  const std::string hash = undisturbed();
  Recorder heard;
  EXPECT_EQ(run(request("out"), heard).finished, n_tiny);
  write("out/hazard.nc.0123456789abcdef.part", "of a killed process");
  workflow::EnsembleJob job = workflow::prepare_ensemble(request("out"), heard);
  int stopped = 0;
  for (int wait_ms = 0; wait_ms < 400; wait_ms += wait_ms < 20 ? 2 : 40) {
    std::atomic<bool> stop{false};
    std::thread later([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(wait_ms));
      stop = true;
    });
    try {
      workflow::make_maps(job, heard, stop);
    } catch (const Cancelled&) {
      ++stopped;
      EXPECT_EQ(workflow::Manifest::read(job.folder.manifest()).hazard_hash, "");
    }
    later.join();
    EXPECT_THAT(parts(path("out")), ::testing::IsEmpty());
  }
  EXPECT_GT(stopped, 2);
  EXPECT_EQ(workflow::make_maps(job, heard).hazard_hash, hash);
}

TEST_F(MapsWorkflow, APageOverMapsOfFewerMembersIsRefused) {
  Recorder silent;
  whole(request("out"), silent);
  std::filesystem::remove(path("out/members/000005.nc"));
  try {
    workflow::rewrite_page(path("out"), silent);
    ADD_FAILURE() << "not refused";
  } catch (const SetupError& refused) {
    EXPECT_THAT(refused.what(),
                HasSubstr("its maps were made from other members than it holds now"));
  }
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
