// SPDX-License-Identifier: Apache-2.0
// sturz cost, as its users meet it.
#include "tests/app/app_fixture.hpp"

namespace sturz::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class Cost : public App {
 protected:
  Cost() { write("scene.yaml", scene()); }
  /// Columns that come to rest.
  static std::string scene() {
    std::string text =
        replaced(tiny_scene(), "formulation: full_stress", "formulation: depth_averaged");
    text = replaced(text, "{uniform: [0.3, 0.7]}", "{uniform: [0.7, 0.9]}");
    text = replaced(text, "{uniform: [0.0, 0.3]}", "{uniform: [0.0, 0.05]}");
    return replaced(text, "end_time_s: 3", "end_time_s: 30");
  }
  Ended cost(const std::vector<std::string>& more) const {
    std::vector<std::string> all{"cost", path("scene.yaml"), "-n", "4", "-o", path("out")};
    all.insert(all.end(), more.begin(), more.end());
    return sturz(all);
  }
};

TEST_F(Cost, TellsErrorsSecondsAndTheThreeParts) {
  const Ended ended = cost({"--variant", "numerics.jitter=0.1"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("5 ensembles of 4 members"));
  for (const char* words : {"CPU s a member", "runout_m", "Within 5 %", "Best for", "sampling",
                            "numerics.jitter=0.1 in depth_averaged at 1.5 m"})
    EXPECT_THAT(ended.out, HasSubstr(words));
  EXPECT_TRUE(exists("out/cost.csv"));
  const auto study = nlohmann::json::parse(read("out/cost.json"));
  const auto& ladder = study.at("ladders").at(0);
  const auto& spacings = ladder.at("spacings_m");
  ASSERT_EQ(spacings.size(), 3U);
  EXPECT_NEAR(spacings[0].get<double>(), 2 * spacings[2].get<double>(), 1e-9);
  EXPECT_EQ(ladder.at("results").at(0).value("name", ""), "runout_m");
  EXPECT_EQ(ladder.at("results").at(0).at("means").size(), 3U);
  EXPECT_EQ(study.at("variants").at(0).value("set", ""), "numerics.jitter=0.1");
}

TEST_F(Cost, ASceneWithoutANumberOfMembersTakesThoseOfTheStudy) {
  write("scene.yaml", replaced(scene(), "members: 6, ", ""));
  const Ended ended = cost({});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("as many members as the study has, 4 (ensemble.members is"));
  EXPECT_THAT(ended.out, HasSubstr("Best for"));
  const auto study = nlohmann::json::parse(read("out/cost.json"));
  EXPECT_EQ(study.at("planned_members"), 4);
  EXPECT_EQ(study.at("planned_members_given"), false);
  const auto& ladder = study.at("ladders").at(0);
  EXPECT_GT(ladder.at("core_s").get<double>(), 0);
  EXPECT_TRUE(ladder.at("certainty_at_finest").at(0).at("sampling_90").is_number());
}

TEST_F(Cost, GoesOnWhereItStopped) {
  ASSERT_EQ(cost({}).exit_code, 0);
  const std::string first = read("out/cost.csv");
  const Ended again = cost({});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  // Seconds too: no member was computed again.
  EXPECT_EQ(read("out/cost.csv"), first);
}

TEST_F(Cost, AFormulationBesideAnotherIsADifferenceOfModels) {
  const Ended ended =
      cost({"--formulations", "depth_averaged,full_stress", "--spacings", "1.4,1,0.7", "--json"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  const auto study = event(ended, "done").at("cost");
  ASSERT_EQ(study.at("ladders").size(), 2U);
  EXPECT_EQ(study.at("models").at(0).value("to", ""), "full_stress");
  EXPECT_TRUE(study.at("multilevel").empty());  // four members tell no correlation
  EXPECT_FALSE(study.at("ladders").at(0).at("certainty_at_finest").at(0).at("model").is_null());
}

TEST_F(Cost, ForecastsWhatCheapMembersWouldSave) {
  const Ended ended = sturz({"cost", path("scene.yaml"), "-n", "12", "-o", path("out")});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  const auto forecast = nlohmann::json::parse(read("out/cost.json")).at("multilevel").at(0);
  EXPECT_EQ(forecast.at("levels").at(0), "depth_averaged_1m");
  EXPECT_EQ(forecast.at("results").at(0).at("squared_correlations").at(0), 1.0);
  EXPECT_GE(forecast.at("gain").get<double>(), 1.0);
}

TEST_F(Cost, IsCheckedByAFinerSpacing) {
  const Ended ended = cost({"--spacings", "2,1.5,1", "--check", "0.75"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("Checked by members at 0.75 m that no estimate knew"));
  const auto study = nlohmann::json::parse(read("out/cost.json"));
  const auto& ladder = study.at("ladders").at(0);
  EXPECT_EQ(ladder.at("spacings_m").size(), 3U);
  EXPECT_GE(ladder.at("checked").size(), 3U);
  EXPECT_THAT(read("out/cost.html"), HasSubstr("Checked by members at"));
}

TEST_F(Cost, AThresholdThatNobodyReachesIsNoMissedPrediction) {
  write("scene.yaml", replaced(scene(), "thickness_m: [0.5, 1]", "thickness_m: [0.5, 5000]"));
  const Ended ended = cost({"--spacings", "2,1.5,1", "--check", "0.75"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(ended.out, Not(HasSubstr("nan")));
  const auto study = nlohmann::json::parse(read("out/cost.json"));
  int told = 0, untold = 0;
  for (const auto& row : study.at("ladders").at(0).at("checked"))
    ++(row.at("met").is_null() ? untold : told);
  EXPECT_EQ(untold, 3);
  EXPECT_THAT(ended.out, HasSubstr("at all spacings"));
  EXPECT_THAT(ended.out, HasSubstr(" of " + std::to_string(told) + ".\n"));
}

TEST_F(Cost, SaysWhatIsWrongBeforeItComputes) {
  const Ended coarse = cost({"--spacings", "2,1", "--check", "1"});
  EXPECT_EQ(coarse.exit_code, 1);
  EXPECT_THAT(coarse.err, HasSubstr("no finer than the finest spacing, 1 m"));
  const Ended one = cost({"--spacings", "2"});
  EXPECT_EQ(one.exit_code, 1);
  EXPECT_THAT(one.err, HasSubstr("two or more different ones"));
  const Ended no_result = cost({"--for", "run_out"});
  EXPECT_EQ(no_result.exit_code, 1);
  EXPECT_THAT(no_result.err, HasSubstr("run_out is no column of members.csv"));
  const Ended no_key = cost({"--variant", "basal.frictions=0.3"});
  EXPECT_EQ(no_key.exit_code, 1);
  EXPECT_THAT(no_key.err, HasSubstr("basal.frictions"));
  const Ended no_pairs = cost({"--variant", "basal.friction_coefficient=0.3"});
  EXPECT_EQ(no_pairs.exit_code, 1);
  EXPECT_THAT(no_pairs.err, HasSubstr("members are no pairs"));
  const Ended morris = cost({"--set", "ensemble.design=morris"});
  EXPECT_EQ(morris.exit_code, 1);
  EXPECT_THAT(morris.err, HasSubstr("ensemble.design=sobol"));
}

TEST_F(Cost, MembersThatAreCutOffTellNothingAndThatIsSaid) {
  write("scene.yaml", replaced(scene(), "end_time_s: 30", "end_time_s: 1"));
  const Ended ended = cost({});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("Not told: run-out"));
  EXPECT_THAT(ended.out, Not(HasSubstr("Best for")));
}

TEST_F(Cost, WithNothingUncertainTheLatticesDiffer) {
  write("scene.yaml", replaced(replaced(scene(), "{uniform: [0.7, 0.9]}", "0.8"),
                               "{uniform: [0.0, 0.05]}", "0.1"));
  const Ended ended = cost({});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("3 ensembles"));
  EXPECT_THAT(ended.out, Not(HasSubstr("displaced")));
}

}  // namespace
}  // namespace sturz::test
