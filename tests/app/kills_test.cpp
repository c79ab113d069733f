// SPDX-License-Identifier: Apache-2.0
// TERM, INT and KILL at random instants, members, maps, page and merge included: out in time with
// the right code, and the same command ends with the same bits.
#include "tests/app/app_fixture.hpp"

#include <chrono>
#include <csignal>
#include <random>
#include <thread>

namespace sturz::test {
namespace {

using Clock = std::chrono::steady_clock;
namespace fs = std::filesystem;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

class Kills : public App {
 protected:
  Kills() {
    write("scene.yaml", replaced(replaced(tiny_scene(), "formulation: full_stress",
                                          "formulation: depth_averaged"),
                                 "members: 6", "members: 12"));
  }
  std::vector<std::string> ensemble(const std::string& out) const {
    std::vector<std::string> words{"ensemble", path("scene.yaml"), "-o",
                                   path(out),  "--workers",        "1"};
    if (packs_) words.emplace_back("--packs");
    return command(words);
  }
  /// Seconds of the program for nothing: what a busy machine adds to every answer.
  double start_seconds() const {
    const auto begin = Clock::now();
    EXPECT_EQ(sturz({"--version"}).exit_code, 0);
    return seconds_since(begin);
  }
  /// Runs, sends the signal after a share of the time that all of it takes, and looks at the end.
  void stop_at(const std::vector<std::string>& words, int signal, double after_s, double slack_s) {
    Process process(words, path(""), environment());
    std::this_thread::sleep_for(std::chrono::duration<double>(after_s));
    const bool was_running = process.running();
    const auto sent = Clock::now();
    process.send(signal);
    const Ended ended = process.wait(60);
    if (!was_running) return;
    if (signal == SIGKILL) {
      EXPECT_TRUE(ended.signal == SIGKILL || ended.exit_code == 0);
      return;
    }
    EXPECT_LT(seconds_since(sent), 2 + slack_s) << "after " << after_s << " s";
    // Before its own first instruction no program can catch anything.
    const bool not_begun = ended.signal == signal && after_s < 0.5 + slack_s;
    const bool was_over = ended.exit_code == 0 && seconds_since(sent) < 0.1;
    EXPECT_TRUE(ended.exit_code == 3 || not_begun || was_over)
        << "signal " << signal << " after " << after_s << " s: exit code " << ended.exit_code
        << ", by signal " << ended.signal << "\n"
        << ended.err;
    if (ended.exit_code == 3) {
      EXPECT_THAT(ended.err, ::testing::AnyOf(::testing::HasSubstr("interrupted"),
                                              ::testing::HasSubstr("a signal to stop")));
    }
  }
  /// Bytes of all that a result is: tables without computing times, and maps.
  void expect_same(const std::string& a, const std::string& b) const {
    EXPECT_EQ(hazard_hash(a), hazard_hash(b));
    EXPECT_EQ(read(a + "/design.csv"), read(b + "/design.csv"));
    EXPECT_EQ(read(a + "/scenario.yaml"), read(b + "/scenario.yaml"));
    std::size_t maps = 0;
    for (const auto& entry : fs::directory_iterator(path(a + "/hazard"))) {
      const std::string name = "/hazard/" + entry.path().filename().string();
      EXPECT_TRUE(exists(b + name)) << name;
      ++maps;
    }
    EXPECT_EQ(maps, static_cast<std::size_t>(std::distance(
                        fs::directory_iterator(path(b + "/hazard")), fs::directory_iterator())));
    for (const auto& entry : fs::recursive_directory_iterator(path(b)))
      EXPECT_NE(entry.path().extension(), ".part") << entry.path();
    EXPECT_FALSE(exists(b + "/lock.json"));
  }
  /// Members, then merges and pages, are stopped so often; the end must be that of a whole run.
  void leave_no_trace(int n_members_stopped, int n_maps_stopped);

  bool packs_ = false;
};

void Kills::leave_no_trace(int n_members_stopped, int n_maps_stopped) {
  const auto begin = Clock::now();
  ASSERT_EQ(run_process(ensemble("whole"), path(""), environment()).exit_code, 0);
  const double whole_s = seconds_since(begin), slack_s = 5 * start_seconds();
  const auto merging = Clock::now();
  ASSERT_EQ(sturz({"merge", path("whole")}).exit_code, 0);
  const double merge_s = seconds_since(merging);
  std::mt19937 random(20261129);
  const auto share = [&] { return std::uniform_real_distribution<>(0, 1)(random); };
  const int signals[] = {SIGTERM, SIGKILL, SIGINT};
  for (int i = 0; i < n_members_stopped; ++i) {
    if (i % 5 == 0) fs::remove_all(path("out"));  // from the start, and where the last one stopped
    stop_at(ensemble("out"), signals[i % 3], whole_s * share(), slack_s);
  }
  ASSERT_EQ(run_process(ensemble("out"), path(""), environment()).exit_code, 0);
  for (int i = 0; i < n_maps_stopped; ++i)
    stop_at(command({i % 6 < 4 ? "merge" : "report", path("out")}), signals[i % 3],
            merge_s * share(), slack_s);
  const Ended merged = sturz({"merge", path("out")});
  ASSERT_EQ(merged.exit_code, 0) << merged.err;
  expect_same("whole", "out");
  EXPECT_EQ(n_members("out"), packs_ ? 0U : 12U);
}

TEST_F(Kills, AtTwentyRandomInstantsLeaveNoTrace) { leave_no_trace(14, 6); }

TEST_F(Kills, OfAnEnsembleInPacksLeaveNoTrace) {
  packs_ = true;
  leave_no_trace(8, 3);
}

}  // namespace
}  // namespace sturz::test
