// SPDX-License-Identifier: Apache-2.0
// A whole ensemble: its files, its events, and what happens when members fail.
#include "tests/app/app_fixture.hpp"

#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <fstream>

namespace sturz::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class EnsembleCommand : public App {};

/// Twenty rows; in row `bad` the source is thinner than a fifth of a particle, so no particle can
/// stand for it.
std::string table_with_one_bad_member(int bad) {
  std::string text = "release.thickness_m,basal.friction_coefficient\n";
  for (int i = 0; i < 20; ++i)
    text += (i == bad ? std::string("0.1") : std::string("2")) + "," +
            std::to_string(0.3 + 0.01 * i) + "\n";
  return text;
}

std::string scene_with_table() {
  std::string scene = replaced(tiny_scene(), "thickness_m: 3", "thickness_m: {uniform: [0.1, 4]}");
  scene = replaced(scene, "pore_pressure_ratio: {uniform: [0.0, 0.3]}", "pore_pressure_ratio: 0");
  scene = replaced(scene, "end_time_s: 3", "end_time_s: 1");
  return replaced(scene, "{design: sobol, members: 6, seed: 1}",
                  "{design: table, table: rows.csv, seed: 1}");
}

TEST_F(EnsembleCommand, LeavesEverythingThatTheGuidePromises) {
  const Ended ended = sturz({"ensemble", path("scene.yaml"), "-o", path("out")});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  for (const char* file : {"scenario.yaml", "design.csv", "manifest.json", "log.txt", "members.csv",
                           "hazard.nc", "report.html", "hazard"})
    EXPECT_TRUE(exists(std::string("out/") + file)) << file;
  EXPECT_EQ(n_members("out"), 6u);
  EXPECT_FALSE(std::filesystem::is_empty(path("out/hazard")));
  EXPECT_THAT(ended.out, HasSubstr("report.html"));
  EXPECT_THAT(ended.err, Not(HasSubstr("\r"))) << "a bar was drawn although this is no terminal";
}

TEST_F(EnsembleCommand, SpeaksJsonLinesWhenAsked) {
  const Ended ended = sturz({"ensemble", path("scene.yaml"), "-o", path("out"), "--json"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_EQ(event(ended, "start").value("members", 0), 6);
  std::size_t members = 0;
  for (const auto& e : events(ended)) members += e.value("event", "") == "member";
  EXPECT_EQ(members, 6u);
  const auto done = event(ended, "done");
  EXPECT_EQ(done.value("valid", 0), 6);
  EXPECT_EQ(done.value("hazard_hash", ""), hazard_hash("out"));
}

TEST_F(EnsembleCommand, WorkersLeaveNoTraceInTheMaps) {
  ASSERT_EQ(sturz({"ensemble", path("scene.yaml"), "-o", path("a"), "--workers", "1"}).exit_code,
            0);
  ASSERT_EQ(sturz({"ensemble", path("scene.yaml"), "-o", path("b"), "--workers", "3"}).exit_code,
            0);
  EXPECT_EQ(hazard_hash("a"), hazard_hash("b"));
}

TEST_F(EnsembleCommand, OneBadMemberOfTwentyIsRecordedAndTheOthersMakeTheMap) {
  write("rows.csv", table_with_one_bad_member(7));
  write("scene.yaml", scene_with_table());
  const Ended ended = sturz({"ensemble", path("scene.yaml"), "-o", path("out"), "--json"});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;  // 1 of 20 is the accepted share, 0.05
  const auto done = event(ended, "done");
  EXPECT_EQ(done.value("valid", 0), 19);
  EXPECT_EQ(done.value("failed", 0), 1);
  EXPECT_EQ(n_members("out"), 20u);
  EXPECT_TRUE(exists("out/hazard.nc"));

  std::istringstream table(read("out/members.csv"));
  std::string line;
  bool found = false;
  while (std::getline(table, line))
    if (line.starts_with("7,")) {
      found = true;
      EXPECT_THAT(line, HasSubstr("failed"));
      EXPECT_THAT(line, HasSubstr("release"));  // the reason
    }
  EXPECT_TRUE(found) << "member 7 has no row";
}

TEST_F(EnsembleCommand, FailedMembersAreComputedAgainOnlyWhenAsked) {
  write("rows.csv", table_with_one_bad_member(7));
  write("scene.yaml", scene_with_table());
  const std::vector<std::string> words{"ensemble", path("scene.yaml"), "-o", path("out"), "--json"};
  ASSERT_EQ(sturz(words).exit_code, 0);
  EXPECT_EQ(event(sturz(words), "start").value("to_do", -1), 0);
  std::vector<std::string> retry = words;
  retry.push_back("--retry-failed");
  const Ended again = sturz(retry);
  EXPECT_EQ(event(again, "start").value("to_do", -1), 1);
  EXPECT_EQ(event(again, "member").value("member", -1), 7);
}

TEST_F(EnsembleCommand, MoreFailuresThanAcceptedEndWithTwoAndStillMakeTheMap) {
  write("rows.csv", table_with_one_bad_member(7));
  write("scene.yaml",
        replaced(scene_with_table(), "seed: 1}", "seed: 1, max_failed_fraction: 0.04}"));
  const Ended ended = sturz({"ensemble", path("scene.yaml"), "-o", path("out")});
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_THAT(ended.err, HasSubstr("1 of 20 members failed"));
  EXPECT_THAT(ended.err, HasSubstr("max_failed_fraction"));
  EXPECT_TRUE(exists("out/hazard.nc"));
}

TEST_F(EnsembleCommand, AFullDiskIsToldOnceAndLosesNoFinishedMember) {
  ASSERT_EQ(sturz({"ensemble", path("scene.yaml"), "-o", path("out"), "-n", "2"}).exit_code, 0);
  ASSERT_EQ(n_members("out"), 2u);
  const std::string first = read("out/members/000000.nc");

  // Files of a member's size can no longer be written; small ones still can.
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  rlimit small = before;
  small.rlim_cur = first.size() / 2;
  std::signal(SIGXFSZ, SIG_IGN);  // inherited: the write fails instead of the process
  setrlimit(RLIMIT_FSIZE, &small);
  Process process(command({"ensemble", path("scene.yaml"), "-o", path("out"), "-n", "6"}), path(""),
                  environment());
  setrlimit(RLIMIT_FSIZE, &before);
  const Ended ended = process.wait();
  std::signal(SIGXFSZ, SIG_DFL);

  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.err, HasSubstr("error:"));
  EXPECT_EQ(ended.err.find("error:"), ended.err.rfind("error:")) << ended.err;
  EXPECT_THAT(ended.err, HasSubstr("resume"));
  EXPECT_EQ(n_members("out"), 2u);
  EXPECT_EQ(read("out/members/000000.nc"), first);

  ASSERT_EQ(sturz({"ensemble", path("scene.yaml"), "-o", path("out"), "-n", "6"}).exit_code, 0);
  ASSERT_EQ(sturz({"ensemble", path("scene.yaml"), "-o", path("whole")}).exit_code, 0);
  EXPECT_EQ(hazard_hash("out"), hazard_hash("whole"));
}

}  // namespace
}  // namespace sturz::test
