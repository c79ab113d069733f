// SPDX-License-Identifier: Apache-2.0
// sturz ensemble --until-converged, as its users meet it.
#include "tests/app/app_fixture.hpp"

namespace sturz::test {
namespace {

using ::testing::HasSubstr;

class StopRule : public App {
 protected:
  StopRule() {
    write("scene.yaml",
          replaced(tiny_scene(), "formulation: full_stress", "formulation: depth_averaged"));
  }
  Ended until(const std::string& half_width, const std::vector<std::string>& more) const {
    std::vector<std::string> all{"ensemble",  path("scene.yaml"),  "-o",
                                 path("out"), "--until-converged", half_width};
    all.insert(all.end(), more.begin(), more.end());
    return sturz(all);
  }
};

TEST_F(StopRule, SaysWhereItStopped) {
  const Ended ended = until("0.14", {"--at-most", "200"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("P(reached) is 0.14 or less, at most 200 members"));
  EXPECT_THAT(ended.out, HasSubstr("Sure enough after 64 members"));
  EXPECT_EQ(n_members("out"), 64u);
  EXPECT_THAT(read("out/manifest.json"), HasSubstr("\"stop_rule\""));
}

TEST_F(StopRule, LooksAreLinesOfJson) {
  const Ended ended = until("0.14", {"--at-most", "200", "--json"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  const auto look = event(ended, "look");
  EXPECT_EQ(look.value("look", 0), 1);
  EXPECT_EQ(look.value("members", 0), 32);
  EXPECT_EQ(look.value("looked_at", ""), "uncertain_cells");
  EXPECT_GT(look.value("half_width", 0.0), 0.14);
  const auto done = event(ended, "done").at("stop_rule");
  EXPECT_EQ(done.value("members", 0), 64);
  EXPECT_EQ(done.value("looks", 0), 2);
  EXPECT_TRUE(done.value("reached", false));
  EXPECT_EQ(event(ended, "start").value("at_most", 0), 200);
}

TEST_F(StopRule, TheScenariosNumberIsTheMostAndThatIsSaid) {
  const Ended ended = until("0.02", {});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_EQ(n_members("out"), 6u);
  EXPECT_THAT(ended.err, HasSubstr("not as sure as was asked for"));
  EXPECT_THAT(ended.err, HasSubstr("certain from 2398"));
}

TEST_F(StopRule, RefusesWhatItCannotDo) {
  EXPECT_THAT(until("0.1", {"--shard", "1/2"}).err, HasSubstr("a shard sees"));
  const Ended latin = until("0.1", {"--set", "ensemble.design=latin_hypercube"});
  EXPECT_EQ(latin.exit_code, 1);
  EXPECT_THAT(latin.err, HasSubstr("--set ensemble.design=sobol"));
  EXPECT_EQ(sturz({"ensemble", path("scene.yaml"), "--at-most", "9"}).exit_code, 1);
  EXPECT_THAT(until("0.1", {"--asset", "house"}).err, HasSubstr("the scene has no `assets`"));
  EXPECT_EQ(sturz({"ensemble", path("scene.yaml"), "--asset", "house"}).exit_code, 1);
  EXPECT_THAT(until("0.1", {"--at-most", "9", "-n", "12"}).err, HasSubstr("--at-most"));
  EXPECT_FALSE(exists("out"));
}

}  // namespace
}  // namespace sturz::test
