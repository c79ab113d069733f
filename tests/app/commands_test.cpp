// SPDX-License-Identifier: Apache-2.0
// run, describe, terrain, schema, report.
#include "tests/app/app_fixture.hpp"

#include <fstream>
#include <sstream>

namespace sturz::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class Commands : public App {};

TEST_F(Commands, VersionNamesCommitAndCompiler) {
  const Ended ended = sturz({"--version"});
  EXPECT_EQ(ended.exit_code, 0);
  EXPECT_THAT(ended.out, ::testing::MatchesRegex("sturz [0-9.]+ \\(.+, .+, .+\\)\n"));
}

TEST_F(Commands, RunTakesMediansAndLeavesPeaksAndAReport) {
  const Ended ended = sturz({"run", path("scene.yaml"), "-o", path("one"), "--json"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  for (const char* file : {"scenario.yaml", "manifest.json", "peaks.nc", "report.html", "log.txt"})
    EXPECT_TRUE(exists(std::string("one/") + file)) << file;
  EXPECT_THAT(read("one/scenario.yaml"), HasSubstr("friction_coefficient: 0.5"));
  const auto done = event(ended, "done");
  EXPECT_GT(done.at("scalars").value("front_travel_m", 0.0), 1.0);
  EXPECT_EQ(done.at("scalars").value("n_particles", 0.0), 300.0);
}

TEST_F(Commands, RunGivesTheSameStateAtOneAndTwoThreads) {
  const Ended one = sturz({"run", path("scene.yaml"), "-o", path("a"), "--json", "--threads", "1"});
  const Ended two = sturz({"run", path("scene.yaml"), "-o", path("b"), "--json", "--threads", "2"});
  EXPECT_EQ(event(one, "done").value("state_hash", "a"),
            event(two, "done").value("state_hash", "b"));
}

TEST_F(Commands, RunHonoursOverrides) {
  const Ended ended = sturz({"run", path("scene.yaml"), "-o", path("one"), "--set",
                             "basal.friction_coefficient=0.31", "--set", "numerics.end_time_s=1"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(read("one/scenario.yaml"), HasSubstr("friction_coefficient: 0.31"));
  EXPECT_THAT(read("one/scenario.yaml"), HasSubstr("end_time_s: 1"));
}

TEST_F(Commands, RunTellsTheStatesOfItsGrainsOrWhatItLeftOut) {
  const Ended dense = sturz({"run", path("scene.yaml"), "-o", path("dense")});
  ASSERT_EQ(dense.exit_code, 0) << dense.err;
  EXPECT_THAT(dense.out, ::testing::ContainsRegex(
                             "dilated +[0-9.]+ % of mass and time .states not asked for."));
  EXPECT_THAT(read("dense/report.html"), HasSubstr("grains.states was not asked for"));
  const Ended loose = sturz({"run", path("scene.yaml"), "-o", path("loose"), "--set",
                             "grains.states.dilute.restitution=0.8"});
  ASSERT_EQ(loose.exit_code, 0) << loose.err;
  EXPECT_THAT(loose.out, ::testing::ContainsRegex("states +dense [0-9.]+ %.*.mass x time."));
  EXPECT_THAT(loose.out, HasSubstr("of the largest speed squared"));
  EXPECT_THAT(loose.out, Not(HasSubstr("dilated")));
  EXPECT_THAT(read("loose/report.html"), HasSubstr("Share of the mass by state"));
  const Ended columns = sturz(
      {"run", path("scene.yaml"), "-o", path("columns"), "--set", "formulation=depth_averaged"});
  ASSERT_EQ(columns.exit_code, 0) << columns.err;
  EXPECT_THAT(columns.out, Not(::testing::AnyOf(HasSubstr("dilated"), HasSubstr("states"))));
}

TEST_F(Commands, RunTellsWhereItsTimeWent) {
  const Ended ended = sturz({"run", path("scene.yaml"), "-o", path("one"), "--json"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  const auto done = event(ended, "done");
  double sum = 0;
  for (const auto& [name, seconds] : done.at("pass_seconds").items()) sum += seconds.get<double>();
  EXPECT_TRUE(done.at("pass_seconds").contains("pair sweep"));
  EXPECT_NEAR(sum, done.at("scalars").value("wall_s", 0.0), 1e-6);
  EXPECT_THAT(read("one/report.html"), HasSubstr(">pair sweep</th>"));
  double effects = 0;
  for (const auto& [name, seconds] : done.at("effect_seconds").items())
    effects += seconds.get<double>();
  EXPECT_NEAR(effects, sum, 1e-6);
  EXPECT_THAT(read("one/report.html"), HasSubstr(">grain stress</th>"));
  EXPECT_FALSE(done.at("effect_seconds").contains("states of the grains"));
  const Ended words = sturz({"run", path("scene.yaml"), "-o", path("two")});
  EXPECT_THAT(words.out, ::testing::ContainsRegex("where the time went +[a-z ]+[0-9.]+ %, "));
}

TEST_F(Commands, RunWritesParticleFrames) {
  const Ended ended = sturz({"run", path("scene.yaml"), "-o", path("one"), "--particles", "1"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  std::size_t frames = 0, indices = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(path("one"))) {
    frames += entry.path().extension() == ".vtp";
    indices += entry.path().extension() == ".pvd";
  }
  EXPECT_GE(frames, 3u);
  EXPECT_EQ(indices, 1u);
}

TEST_F(Commands, DescribeComputesNothingAndSaysWhatWillBe) {
  const Ended words = sturz({"describe", path("scene.yaml")});
  ASSERT_EQ(words.exit_code, 0) << words.err;
  EXPECT_THAT(words.out, HasSubstr("particles"));
  EXPECT_THAT(words.out, HasSubstr("layers"));
  EXPECT_FALSE(exists("out"));
  const Ended json = sturz({"describe", path("scene.yaml"), "--json"});
  ASSERT_EQ(json.exit_code, 0) << json.err;
  const auto said = nlohmann::json::parse(json.out);
  EXPECT_EQ(said.value("n_particles", 0), 300);
  EXPECT_NEAR(said.value("layers", 0.0), 3.0, 0.01);
  EXPECT_GT(said.value("predicted_seconds", 0.0), 0.0);
}

TEST_F(Commands, DescribeForecastsMembersAndMapsWithRanges) {
  const Ended json = sturz({"describe", path("scene.yaml"), "--json"});
  ASSERT_EQ(json.exit_code, 0) << json.err;
  const auto f = nlohmann::json::parse(json.out).at("forecast");
  EXPECT_EQ(f.at("members"), 6);
  EXPECT_EQ(f.at("tried"), true);
  EXPECT_EQ(f.at("tried_members"), 6);
  for (const char* key :
       {"median_cpu_s", "median_steps", "member_cpu_s", "members_cpu_s", "maps_cpu_s",
        "total_cpu_s", "elapsed_s", "memory_bytes", "members_disk_bytes", "maps_disk_bytes"}) {
    EXPECT_GT(f.at(key).at("low"), 0) << key;
    EXPECT_LE(f.at(key).at("low"), f.at(key).at("likely")) << key;
    EXPECT_GT(f.at(key).at("high"), f.at(key).at("likely")) << key;
  }
  const Ended words = sturz({"describe", path("scene.yaml")});
  EXPECT_THAT(words.out, ::testing::ContainsRegex("predicted for 6 members, . at a time: .* to "));
  EXPECT_THAT(words.out, ::testing::ContainsRegex("maps: .* of computing, .*B to .*B. on disk"));
}

TEST_F(Commands, DescribeOfASceneWithoutMembersForecastsTheMedianAlone) {
  const Ended json =
      sturz({"describe", path("scene.yaml"), "--json", "--set", "ensemble=null", "--set",
             "basal.friction_coefficient=0.3", "--set", "basal.pore_pressure_ratio=0"});
  ASSERT_EQ(json.exit_code, 0) << json.err;
  const auto f = nlohmann::json::parse(json.out).at("forecast");
  EXPECT_GT(f.at("median_cpu_s").at("likely"), 0.0);
  EXPECT_TRUE(f.at("members_cpu_s").is_null());
  EXPECT_TRUE(f.at("maps_cpu_s").is_null());
}

TEST_F(Commands, DescribeWarnsWhereTheFlowIsThin) {
  const Ended ended = sturz({"describe", path("scene.yaml"), "--set", "release.thickness_m=2"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(ended.err, HasSubstr("layers"));
}

TEST_F(Commands, TerrainWritesRasters) {
  const Ended ended = sturz({"terrain", "plane", "-o", path("ground"), "--set", "slope_deg=20"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_TRUE(exists("ground/elevation.tif"));
  EXPECT_EQ(sturz({"terrain", "plane", "-o", path("g2"), "--set", "slope=20"}).exit_code, 1);
  EXPECT_EQ(sturz({"terrain", "plain", "-o", path("g2")}).exit_code, 1);
  const Ended scene = sturz({"terrain", path("scene.yaml"), "-o", path("ground2")});
  ASSERT_EQ(scene.exit_code, 0) << scene.err;
  EXPECT_TRUE(exists("ground2/elevation.tif"));
  EXPECT_TRUE(exists("ground2/release.tif"));
}

TEST_F(Commands, SchemaIsJsonAndKnowsTheKeys) {
  const Ended ended = sturz({"schema"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_TRUE(nlohmann::json::parse(ended.out).at("properties").contains("basal"));
}

/// Dotted paths of all keys below a schema object; a shape's own numbers are not keys.
void collect(const nlohmann::json& object, const std::string& path,
             std::vector<std::string>& keys) {
  for (const auto& [name, value] : object.at("properties").items()) {
    const std::string here = path.empty() ? name : path + "." + name;
    if (value.contains("properties") && here != "terrain.synthetic")
      collect(value, here, keys);
    else
      keys.push_back(here);
  }
}

TEST_F(Commands, TheUserGuideNamesEveryKeyOfTheSchema) {
  std::ostringstream guide;
  guide << std::ifstream(STURZ_SOURCE_DIR "/docs/user_guide.md").rdbuf();
  std::vector<std::string> keys;
  collect(nlohmann::json::parse(sturz({"schema"}).out), "", keys);
  EXPECT_GT(keys.size(), 40u);
  for (const std::string& key : keys) EXPECT_THAT(guide.str(), HasSubstr("`" + key + "`"));
}

TEST_F(Commands, ReportIsWrittenAgain) {
  ASSERT_EQ(sturz({"ensemble", path("scene.yaml"), "-o", path("out"), "-n", "2"}).exit_code, 0);
  std::filesystem::remove(path("out/report.html"));
  const Ended ended = sturz({"report", path("out")});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_TRUE(exists("out/report.html"));
  EXPECT_EQ(sturz({"report", path("nowhere")}).exit_code, 1);
}

TEST_F(Commands, ReportOfARunIsTheSamePageAgain) {
  ASSERT_EQ(sturz({"run", path("scene.yaml"), "-o", path("one"), "--set",
                   "grains.states.dilute.restitution=0.8"})
                .exit_code,
            0);
  const std::string before = read("one/report.html");
  EXPECT_THAT(before, HasSubstr("Motion over time"));
  std::filesystem::remove(path("one/report.html"));
  ASSERT_EQ(sturz({"report", path("one")}).exit_code, 0);
  EXPECT_TRUE(read("one/report.html") == before) << "history and computing times come from files";
}

}  // namespace
}  // namespace sturz::test
