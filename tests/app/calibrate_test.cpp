// SPDX-License-Identifier: Apache-2.0
// calibrate, ensemble --posterior, sensitivity.
#include "tests/app/calibrate_fixture.hpp"

#include <sstream>

namespace sturz::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

TEST_F(Calibrate, FewMembersAreWeighed) {
  const Ended ended = calibrate({});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(ended.out, AllOf(HasSubstr("method weights (6 members for 2 uncertain values, fewer"),
                               HasSubstr("basal.friction_coefficient")));
  EXPECT_THAT(ended.err, HasSubstr("independent members, fewer than 30"));
  EXPECT_EQ(lines_of(read("out/weights.csv")), 7U);
  EXPECT_EQ(lines_of(read("out/posterior.csv")), 2003U);
  EXPECT_THAT(read("out/report.html"), HasSubstr("<section id=\"posterior\">"));
}

TEST_F(Calibrate, AnEmulatorWalksChecksItsBestAndComesOutTheSameTwice) {
  const Ended ended = calibrate({"-n", "24", "--json"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  const auto done = event(ended, "done");
  EXPECT_EQ(done.at("sample").at("method"), "emulator");
  EXPECT_EQ(done.at("sample").at("chains").at("acceptance").size(), 4U);
  EXPECT_EQ(done.at("found_at").at("formulation"), "depth_averaged");
  const auto& friction = done.at("keys").at(0);
  EXPECT_EQ(friction.at("key"), "basal.friction_coefficient");
  EXPECT_LT(
      friction.at("posterior").at("p95").get<double>() -
          friction.at("posterior").at("p5").get<double>(),
      friction.at("prior").at("p95").get<double>() - friction.at("prior").at("p5").get<double>());
  EXPECT_EQ(done.at("held_out").at("quantities").size(), done.at("observed").size());
  EXPECT_TRUE(done.at("best_fit").at(0).contains("computed"));
  const std::string first = read("out/posterior.csv"), numbers = read("out/posterior.json");
  const Ended again = calibrate({"-n", "24", "--json"});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(read("out/posterior.csv"), first);
  EXPECT_EQ(read("out/posterior.json"), numbers);
  EXPECT_EQ(sturz({"report", path("out")}).exit_code, 0);
  EXPECT_THAT(read("out/report.html"), HasSubstr("<section id=\"posterior\">"));
}

TEST_F(Calibrate, RoundsAddMembersThatAreKept) {
  const Ended ended = calibrate({"-n", "16", "--active", "1", "--active-members", "3", "--no-check",
                                 "--discrepancy", "0.02", "--json"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_EQ(event(ended, "done").at("sample").at("members_chosen"), 3);
  EXPECT_EQ(n_members("out/active/1"), 3U);
  EXPECT_FALSE(exists("out/best"));
  const std::string first = read("out/posterior.json");
  ASSERT_EQ(calibrate({"-n", "16", "--active", "1", "--active-members", "3", "--no-check",
                       "--discrepancy", "0.02"})
                .exit_code,
            0);
  EXPECT_EQ(read("out/posterior.json"), first);
}

/// They are kept, whichever command reads the folder again, and said where they cannot be used.
TEST_F(Calibrate, ChosenMembersAreNotForgotten) {
  ASSERT_EQ(calibrate({"-n", "16", "--active", "2", "--active-members", "3", "--no-check",
                       "--discrepancy", "0.02"})
                .exit_code,
            0);
  const std::string first = read("out/posterior.json");
  ASSERT_EQ(n_members("out/active/2"), 3U);
  const Ended again = calibrate(
      {"-n", "16", "--method", "emulator", "--no-check", "--discrepancy", "0.02", "--json"});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(event(again, "done").at("sample").at("members_chosen"), 6);
  EXPECT_EQ(read("out/posterior.json"), first);
  ASSERT_EQ(
      calibrate({"-n", "16", "--active", "1", "--no-check", "--discrepancy", "0.02"}).exit_code, 0);
  EXPECT_EQ(read("out/posterior.json"), first);  // the second round is there
  const Ended folder =
      sturz({"calibrate", path("out"), "--discrepancy", "0.02", "--method", "emulator", "--json"});
  ASSERT_EQ(folder.exit_code, 0) << folder.err;
  EXPECT_EQ(event(folder, "done").at("sample").at("members_chosen"), 6);
  const Ended weighed = calibrate({"-n", "16", "--method", "weights", "--json"});
  ASSERT_EQ(weighed.exit_code, 0) << weighed.err;
  EXPECT_EQ(event(weighed, "done").at("sample").at("members_chosen"), 0);
  EXPECT_THAT(weighed.out, HasSubstr("6 members that earlier --active rounds chose have no say"));
  EXPECT_THAT(read("out/report.html"), HasSubstr("--active rounds chose have no say"));
}

TEST_F(Calibrate, AKeyThatThePosteriorDoesNotKnowKeepsItsPrior) {
  ASSERT_EQ(calibrate({}).exit_code, 0);
  std::string more = slide;
  const std::string was = "thickness_m: 2\n";
  more.replace(more.find(was), was.size(), "thickness_m: {uniform: [1.5, 2.5]}\n");
  write("more.yaml", more);
  const Ended ended = sturz(
      {"ensemble", path("more.yaml"), "--posterior", path("out"), "-o", path("a"), "-n", "4"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(ended.err, AllOf(HasSubstr("drawn from its own distribution, independently of the "
                                         "rest: release.thickness_m"),
                               HasSubstr("posterior.csv")));
  EXPECT_THAT(read("a/report.html"), HasSubstr("independently of the rest"));
  EXPECT_THAT(read("a/design.csv"), HasSubstr("release.thickness_m"));
  // The same rows go on, and a folder of the posterior's keys alone has no such words.
  ASSERT_EQ(
      sturz({"ensemble", path("more.yaml"), "--posterior", path("out"), "-o", path("a"), "-n", "6"})
          .exit_code,
      0);
  EXPECT_EQ(n_members("a"), 6U);
}

TEST_F(Calibrate, AnEnsembleOfThePosteriorHasItsValuesAndWarnsOfAnotherSpacing) {
  ASSERT_EQ(calibrate({}).exit_code, 0);
  const Ended same = sturz(
      {"ensemble", path("plain.yaml"), "--posterior", path("out"), "-o", path("a"), "-n", "4"});
  ASSERT_EQ(same.exit_code, 0) << same.err;
  EXPECT_THAT(same.err, Not(HasSubstr("the posterior was found")));
  std::istringstream lines(read("a/design.csv"));
  const std::string posterior = read("out/posterior.csv");
  std::string line;
  int rows = 0;
  while (std::getline(lines, line)) {
    if (line.empty() || line[0] < '0' || line[0] > '9') continue;
    EXPECT_THAT(posterior, HasSubstr(line.substr(line.find(',') + 1)));
    ++rows;
  }
  EXPECT_EQ(rows, 4);
  const Ended other = sturz({"ensemble", path("plain.yaml"), "--posterior", path("out"), "-o",
                             path("b"), "-n", "2", "--set", "numerics.spacing_m=1.2"});
  ASSERT_EQ(other.exit_code, 0) << other.err;
  EXPECT_THAT(other.err,
              HasSubstr("the posterior was found at a spacing of 1 m, this scene has 1.2"));
}

/// What was observed changes no member, and maps are made anew: a posterior of another observation
/// does not belong to them.
TEST_F(Calibrate, AnotherObservationTakesThePosteriorOffThePageAndIsTold) {
  ASSERT_EQ(calibrate({}).exit_code, 0);
  const std::vector<std::string> again{"ensemble", path("scene.yaml"), "-o", path("out")};
  ASSERT_EQ(sturz(again).exit_code, 0);
  EXPECT_THAT(read("out/report.html"), HasSubstr("<section id=\"posterior\">"));
  std::vector<std::string> other = again;
  for (const char* word : {"--set", "observation.runout_m.value=90"}) other.emplace_back(word);
  const Ended changed = sturz(other);
  ASSERT_EQ(changed.exit_code, 0) << changed.err;
  EXPECT_THAT(read("out/report.html"), Not(HasSubstr("<section id=\"posterior\">")));
  const Ended of_it = sturz(
      {"ensemble", path("plain.yaml"), "--posterior", path("out"), "-o", path("a"), "-n", "2"});
  EXPECT_THAT(of_it.err, HasSubstr("is not what its posterior was found with"));
}

TEST_F(Calibrate, ADamagedPosteriorIsToldAndStopsNoMaps) {
  ASSERT_EQ(calibrate({}).exit_code, 0);
  write("out/posterior.json", "{");
  const Ended maps = sturz({"ensemble", path("scene.yaml"), "-o", path("out")});
  EXPECT_EQ(maps.exit_code, 0) << maps.err;
  EXPECT_THAT(maps.err, AllOf(HasSubstr("is damaged"), HasSubstr("The page is without it")));
  const Ended report = sturz({"report", path("out")});
  EXPECT_EQ(report.exit_code, 0) << report.err;
  EXPECT_THAT(read("out/report.html"), Not(HasSubstr("<section id=\"posterior\">")));
}

/// The folder's name would be a comment and the end of a text if it were not quoted.
TEST_F(Calibrate, FewIndependentMembersAreSaidOfMapsOfManyRows) {
  const std::string odd = path("it's #1: x");
  ASSERT_EQ(sturz({"calibrate", path("scene.yaml"), "-o", odd}).exit_code, 0);
  const Ended ended =
      sturz({"ensemble", path("plain.yaml"), "--posterior", odd, "-o", path("a"), "-n", "8"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(ended.err, AllOf(HasSubstr("independent members and 8 are asked of it"),
                               HasSubstr("the others are copies")));
}

TEST_F(Calibrate, ThePosteriorStandsWhenItsBestMemberCannotBeComputed) {
  ASSERT_EQ(calibrate({"-n", "24", "--no-check"}).exit_code, 0);
  write("out/best", "a file where the folder should be");
  std::filesystem::remove(path("out/posterior.json"));
  const Ended ended = calibrate({"-n", "24"});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(ended.err, HasSubstr("nothing confirms the best fit"));
  EXPECT_TRUE(exists("out/posterior.json"));
}

TEST_F(Calibrate, CorrelatedValuesAreToldAndHaveNoShares) {
  const std::string correlation =
      "ensemble.correlation={basal.friction_coefficient/basal.pore_pressure_ratio: 0.8}";
  const Ended ended = calibrate({"-n", "24", "--no-check", "--json", "--set", correlation});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  const auto found = event(ended, "done").at("identifiability").at("correlation");
  EXPECT_GT(found.at(0).at(1).get<double>(), 0.4);  // the prior's, at least
  const Ended shares = sturz({"sensitivity", path("out"), "--result", "front_travel_m", "--json"});
  ASSERT_EQ(shares.exit_code, 0) << shares.err;
  const auto result = event(shares, "done").at("results").at(0);
  EXPECT_THAT(result.at("no_indices").get<std::string>(), HasSubstr("ensemble.correlation is set"));
  EXPECT_FALSE(result.at("keys").at(0).contains("sobol_first"));
}

TEST_F(Calibrate, SaysWhatIsMissing) {
  const Ended nothing = sturz({"calibrate", path("plain.yaml"), "-o", path("out")});
  EXPECT_EQ(nothing.exit_code, 1);
  EXPECT_THAT(nothing.err, HasSubstr("no `observation` block"));
  EXPECT_FALSE(exists("out"));
  const Ended table = calibrate({"--set", "ensemble.design=morris"});
  EXPECT_THAT(table.err, HasSubstr("ensemble.design = morris"));
  const Ended both = calibrate({"--method", "weights", "--active", "1"});
  EXPECT_THAT(both.err, HasSubstr("--active with --method weights"));
  const Ended posterior = sturz({"ensemble", path("plain.yaml"), "--posterior", path(".")});
  EXPECT_THAT(posterior.err, HasSubstr("holds no posterior"));
}

class Sensitivity : public App {
 protected:
  Sensitivity() { write("scene.yaml", slide); }
  nlohmann::json of(const std::string& design, const std::string& members) const {
    EXPECT_EQ(sturz({"ensemble", path("scene.yaml"), "-o", path(design), "-n", members, "--set",
                     "ensemble.design=" + design})
                  .exit_code,
              0);
    const Ended ended =
        sturz({"sensitivity", path(design), "--result", "front_travel_m", "--json"});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_TRUE(exists(design + "/sensitivity.csv"));
    return event(ended, "done").at("results").at(0);
  }
};

/// Friction brakes, and over a range of 0.4 it does so more than 0.3 of pore pressure pushes.
TEST_F(Sensitivity, EveryDesignFindsThatFrictionBrakes) {
  const auto morris = of("morris", "12");
  EXPECT_LT(morris.at("keys").at(0).at("morris").at("mu").get<double>(), 0);
  EXPECT_GT(morris.at("keys").at(0).at("morris").at("mu_star").get<double>(),
            morris.at("keys").at(1).at("morris").at("mu_star").get<double>());
  const auto saltelli = of("saltelli", "40");
  EXPECT_EQ(saltelli.at("sobol_method"), "direct");
  EXPECT_EQ(saltelli.at("sobol_sets"), 10);
  EXPECT_GT(saltelli.at("keys").at(0).at("sobol_total").at("value").get<double>(),
            saltelli.at("keys").at(1).at("sobol_total").at("value").get<double>());
  const auto sobol = of("sobol", "24");
  EXPECT_EQ(sobol.at("sobol_method"), "emulator");
  EXPECT_GT(sobol.at("emulator_q2").get<double>(), 0.5);
  EXPECT_LT(sobol.at("keys").at(0).at("kendall_tau").get<double>(), 0);
}

TEST_F(Sensitivity, RefusesSetsThatAreNotWholeAndUnknownResults) {
  const Ended sets = sturz({"describe", path("scene.yaml"), "--set", "ensemble.design=morris",
                            "--set", "ensemble.members=10"});
  EXPECT_EQ(sets.exit_code, 1);
  EXPECT_THAT(sets.err, HasSubstr("takes sets of 3 members for 2 uncertain values). Use 12."));
  ASSERT_EQ(sturz({"ensemble", path("scene.yaml"), "-o", path("six")}).exit_code, 0);
  const Ended unknown = sturz({"sensitivity", path("six"), "--result", "front_travel"});
  EXPECT_EQ(unknown.exit_code, 1);
  EXPECT_THAT(unknown.err, HasSubstr("front_travel_m"));
}

TEST_F(Calibrate, MapsTheEnsembleUnderItsPosterior) {
  ASSERT_EQ(calibrate({}).exit_code, 0);
  const std::string hash = hazard_hash("out");
  const Ended merged = sturz({"merge", path("out"), "--posterior", path("out")});
  ASSERT_EQ(merged.exit_code, 0) << merged.err;
  EXPECT_THAT(merged.out,
              HasSubstr("6 valid members, weighted by posterior, effective members = "));
  EXPECT_THAT(merged.err, HasSubstr("fewer than 20"));
  EXPECT_TRUE(exists("out/weighted/hazard.nc"));
  EXPECT_TRUE(exists("out/weighted/hazard/index.csv"));
  EXPECT_THAT(read("out/weighted/report.html"), HasSubstr("weighted by posterior"));
  EXPECT_EQ(hazard_hash("out"), hash);
  const Ended json = sturz({"merge", path("out"), "--posterior", path("out"), "--json"});
  const auto done = event(json, "done");
  EXPECT_GE(done.value("effective_members", 0.0), 1);
  EXPECT_NE(done.value("hazard_hash", ""), hash);
  // The same calibration leaves them; by one of other weights they are no maps.
  ASSERT_EQ(calibrate({}).exit_code, 0);
  EXPECT_TRUE(exists("out/weighted/hazard.nc"));
  EXPECT_TRUE(exists("out/weighted/hazard.qgz"));
  ASSERT_EQ(calibrate({"--discrepancy", "0.4"}).exit_code, 0);
  for (const char* file : {"hazard.nc", "report.html", "hazard.qgz", "hazard.gpkg",
                           "hazard/index.csv", "hazard/P_reached.tif", "hazard/P_reached.qml"})
    EXPECT_FALSE(exists(std::string("out/weighted/") + file)) << file;
}

TEST_F(Calibrate, RefusesWeightsOfOtherMembers) {
  ASSERT_EQ(calibrate({}).exit_code, 0);
  const Ended none = sturz({"merge", path("out"), "--posterior", path("nowhere")});
  EXPECT_EQ(none.exit_code, 1);
  EXPECT_THAT(none.err, HasSubstr("holds no weights of members"));
  ASSERT_EQ(sturz({"ensemble", path("plain.yaml"), "-n", "4", "-o", path("other")}).exit_code, 0);
  const Ended other = sturz({"merge", path("other"), "--posterior", path("out")});
  EXPECT_EQ(other.exit_code, 1);
  EXPECT_THAT(other.err, HasSubstr("weighs other members"));
  EXPECT_FALSE(exists("other/weighted"));
}

TEST_F(Calibrate, SensitivityMapsNeedSets) {
  ASSERT_EQ(sturz({"ensemble", path("plain.yaml"), "-o", path("sets"), "-n", "40", "--set",
                   "ensemble.design=saltelli"})
                .exit_code,
            0);
  const Ended maps = sturz({"sensitivity", path("sets"), "--maps"});
  ASSERT_EQ(maps.exit_code, 0) << maps.err;
  EXPECT_TRUE(exists("sets/sensitivity.nc"));
  ASSERT_EQ(sturz({"sensitivity", path("sets")}).exit_code, 0);
  EXPECT_FALSE(exists("sets/sensitivity.nc")) << "the table is new, and the maps are not";
  EXPECT_THAT(maps.out, HasSubstr("Maps of the shares in"));
  ASSERT_EQ(sturz({"ensemble", path("plain.yaml"), "-o", path("plain")}).exit_code, 0);
  EXPECT_THAT(sturz({"sensitivity", path("plain"), "--maps"}).err, HasSubstr("saltelli"));
}

TEST_F(Calibrate, TheShippedEventGivesItsKnownFrictionAndLeavesTheThicknessOpen) {
  ASSERT_EQ(sturz({"cases", "mapped_event", "-o", path("mapped")}).exit_code, 0);
  const Ended ended =
      sturz({"calibrate", path("mapped/scenario.yaml"), "-o", path("mapped_out"), "--json"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  for (const auto& key : event(ended, "done").at("keys")) {
    const bool friction = key.at("key") == "basal.friction_coefficient";
    const double truth = friction ? 0.31 : 6.5;
    EXPECT_LE(key.at("posterior").at("p5").get<double>(), truth) << key.dump();
    EXPECT_GE(key.at("posterior").at("p95").get<double>(), truth) << key.dump();
    if (friction)
      EXPECT_GE(key.at("variance_removed").get<double>(), 0.8) << key.dump();
    else
      EXPECT_LE(key.at("variance_removed").get<double>(), 0.2) << key.dump();
  }
}

}  // namespace
}  // namespace sturz::test
