// SPDX-License-Identifier: Apache-2.0
// sturz batch: who may work in a folder, what ends a batch, and that it goes on with the same bits.
#include "tests/app/batch_fixture.hpp"

#include <chrono>
#include <csignal>
#include <ctime>
#include <filesystem>
#include <random>
#include <regex>
#include <thread>

namespace sturz::test {
namespace {

using ::testing::Each;
using ::testing::HasSubstr;
namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// "HH:MM-HH:MM" from so many minutes from now on.
std::string window(int from_min, int to_min) {
  const auto text = [](int shift) {
    const std::time_t at = std::time(nullptr) + 60 * shift;
    std::tm local{};
    localtime_r(&at, &local);
    return fmt::format("{:02}:{:02}", local.tm_hour, local.tm_min);
  };
  return text(from_min) + "-" + text(to_min);
}

class BatchEnds : public BatchApp {
 protected:
  BatchEnds() { write("list.yaml", three()); }
  static std::string three() {
    std::string list =
        "min_free_disk_gb: 0\nstop_file: STOP\ndefaults: {scenario: a.yaml, members: 4}\njobs:\n";
    for (const char* end : {"2", "2.5", "3"})
      list += fmt::format("  - {{name: t{0}, set: {{numerics.end_time_s: {0}}}}}\n", end);
    return list;
  }
  std::vector<std::string> words() const {
    return command({"batch", path("list.yaml"), "-o", path("out"), "--workers", "1"});
  }
  /// Bytes of all GeoTIFFs of today's results, without when they were begun.
  std::map<std::string, std::string> all_maps() const {
    std::map<std::string, std::string> maps;
    for (const std::string& folder : column("folder"))
      for (const auto& entry : fs::directory_iterator(path("out/" + folder + "/hazard")))
        if (entry.path().extension() == ".tif") {
          const std::string name = folder + "/hazard/" + entry.path().filename().string();
          maps[name] = std::regex_replace(read("out/" + name),
                                          std::regex("[0-9]{4}-[0-9]{2}-[0-9]{2}T[0-9:]{8}Z"), "");
        }
    return maps;
  }
  /// All that is a function of the results: without what tells of the calls.
  std::vector<std::map<std::string, std::string>> results() const {
    auto rows = summary();
    for (auto& row : rows)
      for (const char* name : {"state", "why", "message", "core_s", "utilisation"}) row.erase(name);
    return rows;
  }
};

TEST_F(BatchEnds, TwoProcessesOneWorksTheOtherSaysWho) {
  Process first(words(), path(""), environment());
  while (!exists("out/lock.json") && first.running())
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  fs::create_directory(path("second"));
  const Ended second = run_process(words(), path("second"), environment());
  EXPECT_EQ(second.exit_code, 1);
  EXPECT_THAT(second.err, HasSubstr("another sturz works there, process "));
  EXPECT_THAT(second.err, ::testing::ContainsRegex("since 20[0-9-]+T[0-9:]+Z \\(batch "));
  const Ended ended = first.wait();
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(column("state"), Each("computed"));
  EXPECT_FALSE(exists("out/lock.json"));
}

TEST_F(BatchEnds, KillsAtRandomInstantsLeaveNoTrace) {
  const auto begin = Clock::now();
  ASSERT_EQ(run_process(words(), path(""), environment()).exit_code, 0);
  const std::chrono::duration<double> whole = Clock::now() - begin;
  const auto undisturbed = results();
  const std::string outlines = read("out/outlines.gpkg");
  const auto maps = all_maps();
  fs::remove_all(path("out"));
  std::mt19937 random(20261130);
  for (int i = 0; i < 8; ++i) {
    Process process(words(), path(""), environment());
    std::this_thread::sleep_for(whole * std::uniform_real_distribution<>(0.05, 0.7)(random));
    process.send(i % 4 == 3 ? SIGTERM : SIGKILL);
    process.wait(60);
  }
  const Ended last = run_process(words(), path(""), environment());
  ASSERT_EQ(last.exit_code, 0) << last.err;
  EXPECT_EQ(results(), undisturbed);
  EXPECT_EQ(read("out/outlines.gpkg"), outlines);
  EXPECT_GT(maps.size(), 10u);
  EXPECT_TRUE(all_maps() == maps);
  for (const auto& entry : fs::recursive_directory_iterator(path("out")))
    EXPECT_NE(entry.path().extension(), ".part") << entry.path();
}

TEST_F(BatchEnds, OutsideOfItsTimeItEndsAndGoesOnWithin) {
  const Ended closed = batch({"--between", window(60, 120)});
  EXPECT_EQ(closed.exit_code, 3) << closed.err;
  EXPECT_THAT(closed.err, HasSubstr("it is not within"));
  EXPECT_THAT(closed.err, HasSubstr("3 jobs are to come. The same command goes on."));
  EXPECT_THAT(column("state"), Each("waiting"));
  const Ended open = batch({"--between", window(-60, 60)});
  EXPECT_EQ(open.exit_code, 0) << open.err;
  EXPECT_THAT(column("state"), Each("computed"));
  EXPECT_EQ(batch({"--between", window(60, 120)}).exit_code, 0) << "nothing is to do";
  EXPECT_EQ(batch({"--between", "20-06"}).exit_code, 1);
}

TEST_F(BatchEnds, WaitingForItsTimeHeedsASignal) {
  auto waiting = words();
  waiting.insert(waiting.end(), {"--between", window(60, 120), "--wait"});
  Process process(waiting, path(""), environment());
  while (!exists("out/lock.json") && process.running())
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  std::this_thread::sleep_for(std::chrono::milliseconds(600));
  EXPECT_TRUE(process.running());
  process.send(SIGTERM);
  const Ended ended = process.wait(20);
  EXPECT_EQ(ended.exit_code, 3) << ended.out << ended.err;
}

TEST_F(BatchEnds, AStopFileEndsItAndItGoesOnWithout) {
  write("STOP", "");
  const Ended stopped = batch();
  EXPECT_EQ(stopped.exit_code, 3);
  EXPECT_THAT(stopped.err, HasSubstr("STOP is there"));
  EXPECT_THAT(column("state"), Each("waiting"));
  fs::remove(path("STOP"));
  EXPECT_EQ(batch().exit_code, 0);
}

TEST_F(BatchEnds, AStopFileThatComesLaterKeepsWhatIsFinished) {
  write("list.yaml", replaced(three(), "members: 4", "members: 256"));
  Process process(words(), path(""), environment());
  while (process.running() && n_members("out/t2") < 2) {
    if (!exists("out")) continue;
    for (const auto& entry : fs::directory_iterator(path("out")))
      if (entry.is_directory() && n_members("out/" + entry.path().filename().string()) >= 2)
        write("STOP", "");
    if (exists("STOP")) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  const Ended ended = process.wait(60);
  EXPECT_EQ(ended.exit_code, 3) << ended.out << ended.err;
  EXPECT_EQ(column("state")[0], "interrupted");
  EXPECT_THAT(summary()[0].at("message"), HasSubstr(" of 256 members finished"));
}

TEST_F(BatchEnds, AFullDiskEndsItWithTheReason) {
  write("list.yaml", replaced(three(), "min_free_disk_gb: 0", "min_free_disk_gb: 1e8"));
  const Ended ended = batch();
  EXPECT_EQ(ended.exit_code, 3);
  EXPECT_THAT(ended.err, HasSubstr("less than min_free_disk_gb = 1e+08"));
  EXPECT_THAT(column("state"), Each("waiting"));
  write("list.yaml", three());
  EXPECT_EQ(batch().exit_code, 0);
}

TEST_F(BatchEnds, AJobBeyondTheMemoryLimitFails) {
  write("list.yaml", replaced(three(), "min_free_disk_gb: 0", "max_memory_gb: 0.05"));
  const Ended ended = batch();
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_THAT(ended.err, HasSubstr("more than max_memory_gb = 0.05"));
}

}  // namespace
}  // namespace sturz::test
