// SPDX-License-Identifier: Apache-2.0
// The exit code and the words never claim more than what was done.
#include "tests/app/app_fixture.hpp"

#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>

namespace sturz::test {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::Not;
namespace fs = std::filesystem;

class Ends : public App {
 protected:
  Ends() {
    write("scene.yaml",
          replaced(tiny_scene(), "formulation: full_stress", "formulation: depth_averaged"));
  }
  /// `sturz` with redirections and limits of a shell around it; "$S" is the program.
  Ended shell(const std::string& line) const {
    return run_process(
        {"/bin/sh", "-c", "S=" + command({}).front() + "; cd " + path("") + " && " + line},
        path(""), environment());
  }
  std::vector<std::string> part_files() const {
    std::vector<std::string> found;
    for (const auto& entry : fs::recursive_directory_iterator(path("")))
      if (entry.path().extension() == ".part") found.push_back(entry.path().string());
    return found;
  }
};

TEST_F(Ends, AFullOutputIsAnError) {
  for (const char* words : {"describe scene.yaml", "cases", "--help", "--version", "schema"}) {
    const Ended ended = shell(std::string("\"$S\" ") + words + " > /dev/full");
    EXPECT_EQ(ended.exit_code, 1) << words;
    EXPECT_THAT(ended.err, HasSubstr("output could not be written")) << words;
  }
}

TEST_F(Ends, AnEnsembleIsFinishedAllTheSame) {
  const Ended ended = shell("\"$S\" ensemble scene.yaml -o out > /dev/full");
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.err, HasSubstr("Files in the results folder are whole"));
  EXPECT_TRUE(exists("out/report.html"));
}

TEST_F(Ends, AClosedOutputDoesNotGoIntoOtherFiles) {
  const Ended ended = shell("\"$S\" ensemble scene.yaml -o out --json >&-");
  EXPECT_EQ(ended.exit_code, 1);
  for (const auto& entry : fs::recursive_directory_iterator(path("out")))
    if (entry.is_regular_file()) {
      EXPECT_THAT(read(fs::relative(entry.path(), path("")).string()), Not(HasSubstr("{\"event\"")))
          << entry.path();
    }
  const Ended silent = shell("\"$S\" ensemble scene.yaml -o two 2>&- <&-");
  EXPECT_EQ(silent.exit_code, 0);
  EXPECT_THAT(silent.out, HasSubstr("6 of 6 members are valid"));
}

TEST_F(Ends, ALimitOnFileSizesIsSaidAndLeavesNoHalfFiles) {
  const Ended ended = shell("ulimit -f 8; \"$S\" ensemble scene.yaml -o out");
  EXPECT_EQ(ended.exit_code, 1) << ended.signal;
  EXPECT_THAT(ended.err, HasSubstr("ulimit -f"));
  EXPECT_THAT(part_files(), ::testing::IsEmpty());
  const Ended again = sturz({"ensemble", path("scene.yaml"), "-o", path("out")});
  EXPECT_EQ(again.exit_code, 0) << again.err;
}

TEST_F(Ends, ABadFolderIsSaidInPlainWords) {
  fs::create_symlink("loop", path("loop"));
  fs::create_symlink("b", path("a"));
  fs::create_symlink("a", path("b"));
  const std::string long_name(256, 'x');
  for (const std::string& out :
       {std::string("loop"), std::string("a/below"), long_name, "below/" + long_name,
        std::string("scene.yaml/below"), std::string("/proc/none")}) {
    const Ended ended =
        sturz({"ensemble", path("scene.yaml"), "-o", out.front() == '/' ? out : path(out)});
    EXPECT_EQ(ended.exit_code, 1) << out;
    EXPECT_THAT(ended.err, Not(HasSubstr("should not have happened"))) << out;
    EXPECT_THAT(ended.err, HasSubstr(out.substr(0, 40))) << out;
  }
  for (const std::string& folder : {std::string("loop"), long_name}) {
    for (const char* verb : {"merge", "report"}) {
      const Ended ended = sturz({verb, path(folder)});
      EXPECT_EQ(ended.exit_code, 1);
      EXPECT_THAT(ended.err, Not(HasSubstr("should not have happened"))) << verb << folder;
    }
    const Ended described = sturz({"describe", path(folder)});
    EXPECT_EQ(described.exit_code, 1);
    EXPECT_THAT(described.err, Not(HasSubstr("should not have happened"))) << folder;
  }
}

TEST_F(Ends, AFolderOfOthersIsSaidInPlainWords) {
  if (geteuid() == 0) GTEST_SKIP() << "root may do everything";
  fs::create_directory(path("shut"));
  fs::permissions(path("shut"), fs::perms::owner_read | fs::perms::owner_exec);
  const Ended ended = sturz({"ensemble", path("scene.yaml"), "-o", path("shut")});
  fs::permissions(path("shut"), fs::perms::owner_all);
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.err, HasSubstr("Give yourself the right to write there"));
}

TEST_F(Ends, NamesThatAreNotUtf8WorkOrAreSaid) {
  const std::string name =
      "erg\xe4"
      "b";
  const Ended words = sturz({"ensemble", path("scene.yaml"), "-o", path(name), "-n", "2"});
  EXPECT_EQ(words.exit_code, 0) << words.err;
  const Ended json = sturz({"ensemble", path("scene.yaml"), "-o", path(name), "-n", "2", "--json"});
  EXPECT_EQ(json.exit_code, 0) << json.err;
  event(json, "done");  // each line is JSON
  for (const char* verb : {"merge", "report"})
    EXPECT_EQ(sturz({verb, path(name)}).exit_code, 0) << verb;
  fs::create_directory(
      path("fl\xe4"
           "che"));
  fs::copy_file(path("scene.yaml"), path("fl\xe4"
                                         "che/s\xfc.yaml"));
  const Ended run = sturz({"run",
                           path("fl\xe4"
                                "che/s\xfc.yaml"),
                           "-o", path("run"), "--json"});
  EXPECT_THAT(run.exit_code, AnyOf(0, 1));
  EXPECT_THAT(run.err + run.out, Not(HasSubstr("should not have happened")));
  events(run);
}

TEST_F(Ends, AllFailedIsNotCalledMapsOfTheOthers) {
  const Ended ended = sturz({"ensemble", path("scene.yaml"), "-o", path("out"), "--set",
                             "numerics.max_wall_time_s=1e-7"});
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_THAT(ended.err, HasSubstr("no member is valid"));
  EXPECT_THAT(ended.err, Not(HasSubstr("from the others")));
}

TEST_F(Ends, TwoScenesAtOnceHaveOneWinner) {
  write("other.yaml", replaced(read("scene.yaml"), "[0.3, 0.7]", "[0.2, 0.25]"));
  for (int i = 0; i < 4; ++i) {
    const std::string out = path("out" + std::to_string(i));
    Process first(command({"ensemble", path("scene.yaml"), "-o", out}), path(""), environment());
    Process second(command({"ensemble", path("other.yaml"), "-o", out}), path(""), environment());
    const int a = first.wait().exit_code, b = second.wait().exit_code;
    EXPECT_EQ(a + b, 1) << a << " and " << b;
    EXPECT_EQ(n_members("out" + std::to_string(i)), 6u);
    EXPECT_FALSE(fs::exists(out + "/lock.json"));
  }
}

TEST_F(Ends, ShardsOfTwoScenesAtOnceDoNotMix) {
  write("other.yaml", replaced(read("scene.yaml"), "[0.3, 0.7]", "[0.2, 0.25]"));
  Process first(command({"ensemble", path("scene.yaml"), "-o", path("out"), "--shard", "1/2"}),
                path(""), environment());
  Process second(command({"ensemble", path("other.yaml"), "-o", path("out"), "--shard", "2/2"}),
                 path(""), environment());
  const int a = first.wait().exit_code, b = second.wait().exit_code;
  EXPECT_EQ(a + b, 1) << a << " and " << b;
  EXPECT_EQ(n_members("out"), 3u);
}

TEST_F(Ends, ShardsOfOneSceneWorkTogether) {
  std::vector<std::unique_ptr<Process>> shards;
  for (const char* shard : {"1/3", "2/3", "3/3"})
    shards.push_back(std::make_unique<Process>(
        command({"ensemble", path("scene.yaml"), "-o", path("out"), "--shard", shard}), path(""),
        environment()));
  for (auto& shard : shards) {
    const Ended ended = shard->wait();
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
  }
  EXPECT_EQ(sturz({"merge", path("out")}).exit_code, 0);
}

TEST_F(Ends, ASignalEndsEveryCommandInTimeWithThree) {
  for (const int signal : {SIGTERM, SIGINT, SIGUSR1, SIGHUP}) {
    Process process(command({"run", path("scene.yaml"), "-o", path("run"), "--replace", "--set",
                             "formulation=full_stress", "--set", "numerics.spacing_m=0.25"}),
                    path(""), environment());
    while (process.running() && !exists("run/scenario.yaml"))
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    process.send(signal);
    const Ended ended = process.wait(30);
    EXPECT_EQ(ended.exit_code, 3) << signal << ended.err;
    EXPECT_THAT(ended.err, HasSubstr("interrupted")) << signal;
    EXPECT_FALSE(exists("run/lock.json")) << signal;
    fs::remove_all(path("run"));
  }
}

/// `top`, `pgrep` and `pkill` go by this name; the program starts itself once more on its way.
TEST_F(Ends, TheProcessHasTheNameOfTheProgram) {
  const Ended ended = shell(
      "{ \"$S\" ensemble scene.yaml -o out -n 4000 --workers 1 --json > said & p=$!; "
      "until [ -s said ]; do sleep 0.01; done; cat /proc/$p/comm; kill $p; wait $p; }");
  EXPECT_EQ(ended.out, "sturz\n");
}

}  // namespace
}  // namespace sturz::test
