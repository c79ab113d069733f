// SPDX-License-Identifier: Apache-2.0
// calibrate with folders of finished ensembles, one event or two.
#include "tests/app/calibrate_fixture.hpp"

namespace sturz::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// Two releases on the same ground, each with what was measured of it.
class TwoEvents : public Calibrate {
 protected:
  TwoEvents() {
    write("north.yaml", read("scene.yaml"));
    write("south.yaml", replaced(replaced(slide, "thickness_m: 2", "thickness_m: 3"),
                                 "title: small", "title: thick") +
                            "observation:\n  runout_m: {value: 110, sd: 2}\n");
  }
  Ended ensemble(const std::string& scene, const std::string& out,
                 std::vector<std::string> more = {}) const {
    std::vector<std::string> all{"ensemble", path(scene), "-o", path(out)};
    all.insert(all.end(), more.begin(), more.end());
    return sturz(all);
  }
};

TEST_F(TwoEvents, TellTogetherAndPredictEachOther) {
  ASSERT_EQ(ensemble("north.yaml", "north").exit_code, 0);
  ASSERT_EQ(ensemble("south.yaml", "south").exit_code, 0);
  const Ended ended = sturz({"calibrate", path("north"), path("south"), "-o", path("both")});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(ended.out, AllOf(HasSubstr("event, by the others"), HasSubstr("north/runout_m"),
                               HasSubstr("south/runout_m"), Not(HasSubstr("report.html"))));
  const auto found = nlohmann::json::parse(read("both/posterior.json"));
  EXPECT_EQ(found.at("events").size(), 2u);
  EXPECT_EQ(found.at("held_out_events").size(), 2u);
  EXPECT_EQ(lines_of(read("both/weights.csv")), 7U);
  // The joint weights belong to the members of each event.
  for (const char* event : {"north", "south"}) {
    const Ended map = sturz({"merge", path(event), "--posterior", path("both")});
    EXPECT_EQ(map.exit_code, 0) << map.err;
    EXPECT_TRUE(exists(std::string(event) + "/weighted/hazard.nc"));
  }
  // Its rows are a design for a third scene.
  EXPECT_EQ(ensemble("plain.yaml", "third", {"--posterior", path("both"), "-n", "2"}).exit_code, 0);
}

TEST_F(TwoEvents, OneFinishedFolderKeepsItsPosteriorOnItsPage) {
  ASSERT_EQ(ensemble("north.yaml", "north").exit_code, 0);
  const Ended ended = sturz({"calibrate", path("north")});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(read("north/report.html"), HasSubstr("<section id=\"posterior\">"));
  const Ended of_it = ensemble("plain.yaml", "third", {"--posterior", path("north"), "-n", "2"});
  ASSERT_EQ(of_it.exit_code, 0) << of_it.err;
  EXPECT_THAT(of_it.err, Not(HasSubstr("Calibrate again")));
  // Another observation is another posterior.
  ASSERT_EQ(ensemble("north.yaml", "north", {"--set", "observation.runout_m.value=90"}).exit_code,
            0);
  EXPECT_THAT(read("north/report.html"), Not(HasSubstr("<section id=\"posterior\">")));
}

/// What is told of correlated values does not depend on which way the members came.
TEST_F(TwoEvents, KnowThatValuesAreCorrelated) {
  const std::vector<std::string> correlated{
      "-n", "24", "--set",
      "ensemble.correlation={basal.friction_coefficient/basal.pore_pressure_ratio: 0.8}"};
  std::vector<std::string> at_once{"--no-check"};
  at_once.insert(at_once.end(), correlated.begin(), correlated.end());
  ASSERT_EQ(calibrate(at_once).exit_code, 0);
  const auto told = [&](const std::string& folder) {
    return nlohmann::json::parse(read(folder + "/posterior.json")).at("identifiability");
  };
  const auto expected = told("out");
  ASSERT_EQ(sturz({"calibrate", path("out")}).exit_code, 0);
  EXPECT_EQ(told("out"), expected);
  ASSERT_EQ(ensemble("south.yaml", "south", correlated).exit_code, 0);
  const Ended both = sturz({"calibrate", path("out"), path("south"), "-o", path("both")});
  ASSERT_EQ(both.exit_code, 0) << both.err;
  EXPECT_GT(told("both").at("correlation").at(0).at(1).get<double>(), 0.4);  // the prior's
}

TEST_F(TwoEvents, AreRefusedWhereTheirValuesDiffer) {
  ASSERT_EQ(ensemble("north.yaml", "north").exit_code, 0);
  ASSERT_EQ(ensemble("south.yaml", "south", {"--set", "ensemble.seed=9"}).exit_code, 0);
  const Ended seed = sturz({"calibrate", path("north"), path("south"), "-o", path("both")});
  EXPECT_EQ(seed.exit_code, 1);
  EXPECT_THAT(seed.err, AllOf(HasSubstr("do not share their uncertain values"),
                              HasSubstr("ensemble.seed: 1 -> 9")));
  ASSERT_EQ(
      ensemble("south.yaml", "wide", {"--set", "basal.pore_pressure_ratio={uniform: [0, 0.5]}"})
          .exit_code,
      0);
  EXPECT_THAT(sturz({"calibrate", path("north"), path("wide"), "-o", path("both")}).err,
              HasSubstr("basal.pore_pressure_ratio: "));
  EXPECT_FALSE(exists("both"));
}

TEST_F(TwoEvents, NeedAFolderAndAnObservationAndNoOptionsOfMembers) {
  ASSERT_EQ(ensemble("north.yaml", "north").exit_code, 0);
  ASSERT_EQ(ensemble("plain.yaml", "plain").exit_code, 0);
  EXPECT_THAT(sturz({"calibrate", path("north"), path("plain"), "-o", path("both")}).err,
              HasSubstr("no `observation` block"));
  EXPECT_THAT(sturz({"calibrate", path("north"), path("plain")}).err, HasSubstr("--out"));
  EXPECT_THAT(sturz({"calibrate", path("north"), path("north"), "-o", path("both")}).err,
              HasSubstr("given twice"));
  EXPECT_THAT(sturz({"calibrate", path("north"), path("north.yaml"), "-o", path("both")}).err,
              HasSubstr("north.yaml is no folder"));
  EXPECT_THAT(sturz({"calibrate", path("north"), "-n", "9"}).err, HasSubstr("computes no members"));
}

TEST_F(TwoEvents, OneFinishedFolderIsCalibratedWhereItLies) {
  ASSERT_EQ(ensemble("north.yaml", "north").exit_code, 0);
  const Ended ended = sturz({"calibrate", path("north")});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(read("north/report.html"), HasSubstr("id=\"posterior\""));
  ASSERT_EQ(calibrate({}).exit_code, 0);  // the same from the scenario
  EXPECT_EQ(read("north/weights.csv"), read("out/weights.csv"));
}

}  // namespace
}  // namespace sturz::test
