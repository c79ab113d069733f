// SPDX-License-Identifier: Apache-2.0
// sturz ensemble with few dear members and many cheap ones, as its users meet it.
#include "tests/app/app_fixture.hpp"

namespace sturz::test {
namespace {

using ::testing::HasSubstr;

class MultilevelEnsemble : public App {
 protected:
  /// Full stress and columns of a slide that comes to rest.
  MultilevelEnsemble() {
    std::string text = replaced(tiny_scene(), "{uniform: [0.3, 0.7]}", "{uniform: [0.7, 0.9]}");
    text = replaced(text, "{uniform: [0.0, 0.3]}", "{uniform: [0.0, 0.05]}");
    text = replaced(text, "end_time_s: 3", "end_time_s: 30");
    write("scene.yaml", replaced(text, "members: 6,",
                                 "estimator: multilevel, target: {relative_error: 0.3}, "
                                 "levels: full_stress 1.4 m, pilot: 8,"));
  }
  Ended ensemble(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> all{"ensemble", path("scene.yaml"), "-o", path("out")};
    all.insert(all.end(), more.begin(), more.end());
    return sturz(all);
  }
};

TEST_F(MultilevelEnsemble, SaysWhatItTriedDecidedAndFound) {
  const Ended ended = ensemble({"--set", "ensemble.levels=full_stress 1.4, depth_averaged 1.4"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  for (const char* words :
       {"Pilot of 8 shared draws", "members of full_stress_1m", "sampling (90 %)", "resolution",
        "model", "Share of the variance", "report.html"})
    EXPECT_THAT(ended.out, HasSubstr(words));
  const auto found = nlohmann::json::parse(read("out/multilevel.json"));
  const auto& runout = found.at("headlines").at(0);
  EXPECT_EQ(runout.value("name", ""), "runout_m");
  EXPECT_LT(runout.at("bounds_90").at(0).get<double>(), runout.at("mean").get<double>());
  EXPECT_FALSE(runout.at("resolution").is_null());
  EXPECT_FALSE(runout.at("model").is_null());
  EXPECT_THAT(read("out/report.html"), HasSubstr("Means, and by how much they may be off"));
}

TEST_F(MultilevelEnsemble, RefusesWhatDoesNotGoWithIt) {
  const Ended level = ensemble();
  EXPECT_EQ(level.exit_code, 1);
  EXPECT_THAT(level.err, HasSubstr("no spacing above 0 after the formulation"));
  for (const char* option : {"-n", "--until-converged"}) {
    const Ended ended = ensemble({option, option[1] == 'n' ? "20" : "0.1"});
    EXPECT_EQ(ended.exit_code, 1) << option;
    EXPECT_THAT(ended.err, HasSubstr(std::string(option) + " with ensemble.estimator"));
  }
  const Ended target = ensemble({"--set", "ensemble.target=null"});
  EXPECT_EQ(target.exit_code, 1);
  EXPECT_THAT(target.err, HasSubstr("ensemble.target (missing"));
  EXPECT_FALSE(exists("out"));
}

}  // namespace
}  // namespace sturz::test
