// SPDX-License-Identifier: Apache-2.0
// Interruptions, shards and growth leave no trace in the maps.
#include "tests/app/app_fixture.hpp"

#include <signal.h>

#include <chrono>
#include <fstream>
#include <thread>

namespace sturz::test {
namespace {

using ::testing::HasSubstr;

class Resume : public App {
 protected:
  /// The hash of an ensemble that ran undisturbed.
  std::string undisturbed(const std::string& scene = "scene.yaml") {
    const Ended ended = sturz({"ensemble", path(scene), "-o", path("undisturbed")});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    return hazard_hash("undisturbed");
  }
  /// Starts an ensemble with one worker and waits for its first finished member.
  std::unique_ptr<Process> started(const std::string& results) {
    auto process = std::make_unique<Process>(
        command({"ensemble", path("scene.yaml"), "-o", path(results), "--workers", "1"}), path(""),
        environment());
    while (process->running() && n_members(results) == 0)
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    return process;
  }
};

TEST_F(Resume, FinishedMembersAreNotComputedAgain) {
  ASSERT_EQ(sturz({"ensemble", path("scene.yaml"), "-o", path("out")}).exit_code, 0);
  const auto before = std::filesystem::last_write_time(path("out/members/000003.nc"));
  const std::string hash = hazard_hash("out");
  const Ended again = sturz({"ensemble", path("scene.yaml"), "-o", path("out"), "--json"});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(event(again, "start").value("finished_before", -1), 6);
  EXPECT_EQ(std::filesystem::last_write_time(path("out/members/000003.nc")), before);
  EXPECT_EQ(hazard_hash("out"), hash);
}

TEST_F(Resume, AfterKillNineGivesTheSameMaps) {
  write("scene.yaml", replaced(tiny_scene(), "members: 6", "members: 12"));
  auto process = started("out");
  process->send(SIGKILL);
  EXPECT_EQ(process->wait().signal, SIGKILL);
  const std::size_t finished = n_members("out");
  EXPECT_GE(finished, 1u);
  EXPECT_LT(finished, 12u) << "killed too late to show anything";
  const Ended again = sturz({"ensemble", path("scene.yaml"), "-o", path("out")});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(n_members("out"), 12u);
  EXPECT_EQ(hazard_hash("out"), undisturbed());
}

TEST_F(Resume, CtrlCEndsCleanlyWithThreeAndTheSameCommandGoesOn) {
  write("scene.yaml", replaced(tiny_scene(), "members: 6", "members: 12"));
  auto process = started("out");
  process->send(SIGINT);
  const Ended ended = process->wait();
  EXPECT_EQ(ended.signal, 0);
  EXPECT_EQ(ended.exit_code, 3) << ended.err;
  EXPECT_THAT(ended.err, HasSubstr("same command"));
  EXPECT_LT(n_members("out"), 12u) << "interrupted too late to show anything";
  EXPECT_FALSE(exists("out/hazard.nc"));
  ASSERT_EQ(sturz({"ensemble", path("scene.yaml"), "-o", path("out")}).exit_code, 0);
  EXPECT_EQ(hazard_hash("out"), undisturbed());
}

TEST_F(Resume, ShardsAndMergeEqualOneRun) {
  for (const char* shard : {"3/3", "1/3", "2/3"}) {
    const Ended ended =
        sturz({"ensemble", path("scene.yaml"), "-o", path("out"), "--shard", shard});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.out,
                HasSubstr(std::string("Shard ") + shard + " is finished (2 members computed: 2 "));
    EXPECT_FALSE(exists("out/hazard.nc")) << "a shard made maps";
  }
  const Ended merged = sturz({"merge", path("out")});
  ASSERT_EQ(merged.exit_code, 0) << merged.err;
  EXPECT_EQ(hazard_hash("out"), undisturbed());
}

TEST_F(Resume, MergeNamesWhatIsMissingUnlessToldToGoOn) {
  ASSERT_EQ(sturz({"ensemble", path("scene.yaml"), "-o", path("out"), "--shard", "1/2"}).exit_code,
            0);
  const Ended refused = sturz({"merge", path("out")});
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_THAT(refused.err, HasSubstr("3 of 6 members are missing (1, 3, 5)"));
  EXPECT_FALSE(exists("out/hazard.nc"));
  const Ended partial = sturz({"merge", path("out"), "--partial"});
  EXPECT_EQ(partial.exit_code, 0) << partial.err;
  EXPECT_THAT(partial.err, HasSubstr("3 of 6 members are missing"));
  EXPECT_TRUE(exists("out/hazard.nc"));
}

TEST_F(Resume, AnotherSceneIsRefusedAndTheDifferenceNamed) {
  ASSERT_EQ(sturz({"ensemble", path("scene.yaml"), "-o", path("out")}).exit_code, 0);
  const std::string hash = hazard_hash("out");
  const Ended other = sturz(
      {"ensemble", path("scene.yaml"), "-o", path("out"), "--set", "grains.friction_angle_deg=35"});
  EXPECT_EQ(other.exit_code, 1);
  EXPECT_THAT(other.err, HasSubstr("grains.friction_angle_deg: 30 -> 35"));
  EXPECT_EQ(hazard_hash("out"), hash);
}

TEST_F(Resume, ZonesGoOnWithTheSameFilesAndValuesOnly) {
  const std::string corners = "[[[-20,-10],[20,-10],[20,10],[-20,10],[-20,-10]]]";
  write("plate.geojson", R"({"type":"Feature","properties":{},"geometry":{"type":"Polygon",)"
                         R"("coordinates":)" +
                             corners + "}}");
  const auto begun = [&](const std::string& value) {
    return sturz({"ensemble", path("scene.yaml"), "-o", path("out"), "-n", "2", "--set",
                  "basal.zones=[{polygon: plate.geojson, friction_coefficient: " + value + "}]"});
  };
  ASSERT_EQ(begun("0.2").exit_code, 0);
  EXPECT_THAT(read("out/scenario.yaml"), HasSubstr("polygon: \"../plate.geojson\""));
  const Ended again = begun("0.2");
  EXPECT_EQ(again.exit_code, 0) << again.err;
  const Ended other = begun("0.3");
  EXPECT_EQ(other.exit_code, 1);
  EXPECT_THAT(other.err, HasSubstr("basal.zones: [{polygon: "));
  write("plate.geojson", read("plate.geojson") + "\n");  // the same polygon
  EXPECT_EQ(begun("0.2").exit_code, 0);
  std::string other_corner = read("plate.geojson");
  write("plate.geojson", other_corner.replace(other_corner.find("[20,-10]"), 8, "[21,-10]"));
  const Ended moved = begun("0.2");
  EXPECT_EQ(moved.exit_code, 1);
  EXPECT_THAT(moved.err, HasSubstr("input basal.zones[0].polygon = plate.geojson: other polygons"));
  auto manifest = nlohmann::ordered_json::parse(read("out/manifest.json"));
  manifest["inputs"] = {{{"file", "plate.geojson"}, {"checksum", "sha256:85944171f73967e8"}}};
  write("out/manifest.json", manifest.dump());
  const Ended older = begun("0.2");
  EXPECT_EQ(older.exit_code, 1);
  EXPECT_THAT(older.err, HasSubstr("input plate.geojson: is known by the bytes of its file only"));
}

TEST_F(Resume, ThresholdsMayChangeWithoutComputingAgain) {
  ASSERT_EQ(sturz({"ensemble", path("scene.yaml"), "-o", path("out")}).exit_code, 0);
  const Ended again = sturz({"ensemble", path("scene.yaml"), "-o", path("out"), "--json", "--set",
                             "hazard.thickness_m=[0.25, 0.75]"});
  ASSERT_EQ(again.exit_code, 0) << again.err << again.out;
  EXPECT_EQ(event(again, "start").value("finished_before", -1), 6);
}

TEST_F(Resume, MapsOfOldThresholdsDoNotStay) {
  ASSERT_EQ(sturz({"ensemble", path("scene.yaml"), "-o", path("out")}).exit_code, 0);
  const std::string map = "out/hazard/P_thickness_gt_";
  ASSERT_TRUE(exists(map + "0.5m.tif"));
  ASSERT_EQ(sturz({"ensemble", path("scene.yaml"), "-o", path("out"), "--set",
                   "hazard.thickness_m=[0.75]"})
                .exit_code,
            0);
  EXPECT_FALSE(exists(map + "0.5m.tif"));
  EXPECT_TRUE(exists(map + "0.75m.tif"));
}

TEST_F(Resume, MembersWithoutTheirSceneAreNotAdopted) {
  ASSERT_EQ(sturz({"ensemble", path("scene.yaml"), "-o", path("out")}).exit_code, 0);
  std::filesystem::remove(path("out/scenario.yaml"));
  const Ended ended = sturz({"ensemble", path("scene.yaml"), "-o", path("out")});
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.err, HasSubstr("no scenario.yaml"));
}

TEST_F(Resume, SobolGrowsAndEqualsTheLargerEnsemble) {
  ASSERT_EQ(sturz({"ensemble", path("scene.yaml"), "-o", path("out"), "-n", "4"}).exit_code, 0);
  const Ended grown =
      sturz({"ensemble", path("scene.yaml"), "-o", path("out"), "-n", "6", "--json"});
  ASSERT_EQ(grown.exit_code, 0) << grown.err;
  EXPECT_EQ(event(grown, "start").value("finished_before", -1), 4);
  EXPECT_EQ(hazard_hash("out"), undisturbed());
}

TEST_F(Resume, LatinHypercubeDoesNotGrow) {
  write("scene.yaml", replaced(tiny_scene(), "design: sobol", "design: latin_hypercube"));
  ASSERT_EQ(sturz({"ensemble", path("scene.yaml"), "-o", path("out"), "-n", "4"}).exit_code, 0);
  const Ended grown = sturz({"ensemble", path("scene.yaml"), "-o", path("out"), "-n", "6"});
  EXPECT_EQ(grown.exit_code, 1);
  EXPECT_THAT(grown.err, HasSubstr("latin_hypercube"));
  EXPECT_EQ(n_members("out"), 4u);
}

TEST_F(Resume, ADamagedMemberFileIsComputedAgain) {
  ASSERT_EQ(sturz({"ensemble", path("scene.yaml"), "-o", path("out")}).exit_code, 0);
  const std::string hash = hazard_hash("out");
  const std::string whole = read("out/members/000002.nc");
  write("out/members/000002.nc", whole.substr(0, whole.size() / 2));
  const Ended again = sturz({"ensemble", path("scene.yaml"), "-o", path("out")});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_THAT(again.err, HasSubstr("000002.nc"));
  EXPECT_EQ(hazard_hash("out"), hash);
}

}  // namespace
}  // namespace sturz::test
