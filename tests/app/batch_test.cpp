// SPDX-License-Identifier: Apache-2.0
// sturz batch: what is computed, why, and what of it fails alone.
#include "tests/app/batch_fixture.hpp"

#include <chrono>
#include <filesystem>
#include <thread>

namespace sturz::test {
namespace {

using ::testing::AllOf;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
namespace fs = std::filesystem;

class Batch : public BatchApp {
 protected:
  /// Time stamps are trusted from two seconds on.
  static void age() { std::this_thread::sleep_for(std::chrono::milliseconds(2100)); }
};

TEST_F(Batch, OneBrokenJobFailsAloneAndTheSecondCallComputesNothing) {
  write("list.yaml", eight());
  const Ended first = batch();
  EXPECT_EQ(first.exit_code, 2) << first.err;
  EXPECT_THAT(first.err, HasSubstr("broken: "));
  EXPECT_THAT(first.err, HasSubstr("broken.yaml:2:"));
  EXPECT_THAT(first.err, HasSubstr("terrain.raster = broken.asc: cannot be opened"));
  EXPECT_THAT(first.out, HasSubstr("8 jobs: 7 computed, 0 unchanged, 1 failed"));
  EXPECT_THAT(column("state"), ElementsAre("computed", "computed", "computed", "computed",
                                           "computed", "computed", "computed", "failed"));
  EXPECT_EQ(column("why")[0], "never computed");
  EXPECT_THAT(summary()[7].at("message"), HasSubstr("broken.asc"));
  for (const char* file : {"out/summary.html", "out/outlines.gpkg", "out/a1/report.html"})
    EXPECT_TRUE(exists(file)) << file << " (a1 is a link to its results)";
  const auto hashes = column("hazard_hash");
  for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(hashes[i].size(), 16u) << i;

  batch();  // stamps of files that were just written are not trusted the first time
  age();
  batch();
  const auto begin = std::chrono::steady_clock::now();
  const Ended second = batch();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(2));
  EXPECT_EQ(second.exit_code, 2);
  EXPECT_THAT(second.out, HasSubstr("0 computed, 7 unchanged, 1 failed"));
  EXPECT_EQ(column("hazard_hash"), hashes);
}

TEST_F(Batch, AChangedInputComputesWhatDependsOnIt) {
  write("list.yaml", eight());
  batch();
  const auto folders = column("folder");
  write("b.asc", slope(0.66));
  const Ended second = batch();
  EXPECT_THAT(second.out, HasSubstr("3 computed, 4 unchanged, 1 failed"));
  EXPECT_THAT(column("state"), ElementsAre("unchanged", "unchanged", "unchanged", "unchanged",
                                           "computed", "computed", "computed", "failed"));
  EXPECT_EQ(column("why")[4], "b.asc changed (terrain.raster)");
  EXPECT_NE(column("folder")[4], folders[4]);
  EXPECT_TRUE(exists("out/" + folders[4] + "/hazard.nc")) << "results of before stay";

  write("b.asc", slope(0.62));
  const Ended back = batch();
  EXPECT_THAT(back.out, HasSubstr("0 computed, 7 unchanged"));
  EXPECT_EQ(column("folder"), folders) << "what was computed once is found again";
  EXPECT_EQ(fs::read_symlink(path("out/b1")).string(), folders[4]);
}

TEST_F(Batch, TheReasonNamesWhatChanged) {
  write("list.yaml", "jobs:\n  - {name: a, scenario: a.yaml}\n");
  ASSERT_EQ(batch().exit_code, 0);
  write("list.yaml", "jobs:\n  - {name: a, scenario: a.yaml, set: {numerics.end_time_s: 1.5}}\n");
  ASSERT_EQ(batch().exit_code, 0);
  EXPECT_THAT(column("why"), ElementsAre("numerics.end_time_s 2 -> 1.5"));
  write("list.yaml",
        "jobs:\n  - {name: a, scenario: a.yaml, members: 4, set: {numerics.end_time_s: 1.5}}\n");
  ASSERT_EQ(batch().exit_code, 0);
  EXPECT_THAT(column("why"), ElementsAre("ensemble.members 2 -> 4"));
  EXPECT_THAT(column("valid"), ElementsAre("4"));
  write("list.yaml",
        "jobs:\n  - {name: a, scenario: a.yaml, members: 4, set: {numerics.end_time_s: 1.5, "
        "title: other}}\n");
  ASSERT_EQ(batch().exit_code, 0);
  EXPECT_THAT(column("why"), ElementsAre("title tiny slide -> other"));
  write("list.yaml",
        "jobs:\n  - {name: a, scenario: a.yaml, mode: run, set: {numerics.end_time_s: 1.5}}\n");
  ASSERT_EQ(batch().exit_code, 0);
  EXPECT_THAT(column("why")[0], HasSubstr("mode ensemble -> run"));
  EXPECT_TRUE(exists("out/a/peaks.nc"));
}

TEST_F(Batch, EverythingWrongIsSaidBeforeAnythingIsComputed) {
  write("list.yaml", R"(jobs:
  - {name: a, scenario: a.yaml, set: {basal.friction: 0.3}}
  - {name: b, scenario: absent.yaml}
  - {name: c, scenario: a.yaml, set: {numerics.spacing_m: -1}}
nice: 90
)");
  const Ended ended = batch();
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.err, HasSubstr("list.yaml:2:55: basal.friction (unknown key)"));
  EXPECT_THAT(ended.err, HasSubstr("list.yaml:3:25: jobs[1].scenario = absent.yaml"));
  EXPECT_THAT(ended.err, HasSubstr("list.yaml:4:59: numerics.spacing_m = -1"));
  EXPECT_THAT(ended.err, HasSubstr("list.yaml:5:7: nice = 90"));
  EXPECT_FALSE(exists("out"));
}

TEST_F(Batch, ADryRunSaysCostAndDiskAndWritesNothing) {
  write("list.yaml",
        "jobs:\n  - {name: a, scenario: a.yaml}\n  - {name: x, scenario: "
        "broken.yaml}\n");
  const Ended ended = batch({"--dry-run", "--json"});
  EXPECT_EQ(ended.exit_code, 2) << ended.err;
  const auto job = event(ended, "job");
  EXPECT_EQ(job.value("why", ""), "never computed");
  EXPECT_GT(job.at("forecast").at("elapsed_s").value("likely", 0.0), 0.0);
  EXPECT_GT(event(ended, "dry_run").value("disk_bytes", 0.0), 1000.0);
  EXPECT_FALSE(exists("out"));
}

TEST_F(Batch, OldResultsGoOnlyWhenThatIsAskedFor) {
  std::vector<std::string> folders;
  for (const char* end : {"1", "1.2", "1.4"}) {
    write("list.yaml", fmt::format("jobs: [{{name: a, scenario: a.yaml, set: "
                                   "{{numerics.end_time_s: {}}}}}]\n",
                                   end));
    ASSERT_EQ(batch().exit_code, 0);
    folders.push_back("out/" + column("folder")[0]);
  }
  EXPECT_TRUE(exists(folders[0]) && exists(folders[1]) && exists(folders[2]));
  ASSERT_EQ(batch({"--keep", "2"}).exit_code, 0);
  EXPECT_FALSE(exists(folders[0]));
  EXPECT_TRUE(exists(folders[1]) && exists(folders[2]));
  ASSERT_EQ(batch({"--prune"}).exit_code, 0);
  EXPECT_FALSE(exists(folders[1]));
  EXPECT_TRUE(exists(folders[2] + "/hazard.nc"));
}

TEST_F(Batch, OnlyNamedJobsAreLookedAt) {
  write("list.yaml", eight());
  const Ended ended = batch({"--only", "b2"});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(column("state")[5], "computed");
  EXPECT_THAT(column("state")[0], "skipped");
  EXPECT_EQ(batch({"--only", "zz"}).exit_code, 1);
}

TEST_F(Batch, ListsAreNamedFromTheWorkingDirectory) {
  write("list.yaml",
        "jobs: [{name: a, scenario: a.yaml}, {name: b, scenario: b.yaml, folder: far}]\n");
  const auto there = [&](const std::string& list) {
    std::vector<std::string> words{"/bin/sh", "-c", "cd \"$0\" && exec \"$@\"", path("")};
    for (const std::string& word : command({"batch", list})) words.push_back(word);
    return run_process(words, path(""), environment());
  };
  const Ended first = there("list.yaml");
  ASSERT_EQ(first.exit_code, 0) << first.err;
  EXPECT_TRUE(exists("out/list/a/report.html") && exists("far/report.html"));
  const Ended again = there(path("list.yaml"));
  EXPECT_THAT(again.out, HasSubstr("0 computed, 2 unchanged"));
}

TEST_F(Batch, ALostFileIsMadeAgain) {
  write("list.yaml", "jobs: [{name: a, scenario: a.yaml}]\n");
  ASSERT_EQ(batch().exit_code, 0);
  const auto hash = column("hazard_hash");
  const std::string folder = "out/" + column("folder")[0];
  fs::remove(path(folder + "/members/000001.nc"));
  ASSERT_EQ(batch().exit_code, 0);
  EXPECT_THAT(column("why"), ElementsAre("interrupted at 1 of 2"));
  EXPECT_EQ(column("hazard_hash"), hash);
  fs::remove(path(folder + "/report.html"));
  ASSERT_EQ(batch().exit_code, 0);
  EXPECT_TRUE(exists(folder + "/report.html"));
}

}  // namespace
}  // namespace sturz::test
