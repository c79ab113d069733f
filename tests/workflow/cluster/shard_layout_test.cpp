// SPDX-License-Identifier: Apache-2.0
// Which shards lack members, how lists of them are written, and what a shell makes of the words.
#include "ensemble/workflow/cluster/shard_layout.hpp"

#include "ensemble/members/shards.hpp"
#include "ensemble/workflow/cluster/shard_plan.hpp"
#include "tests/workflow/workflow_fixture.hpp"

#include <cstdio>

namespace sturz::test {
namespace {

using workflow::shard_states;
using workflow::ShardState;

MemberSummary member(std::int64_t number, Outcome outcome = Outcome::settled) {
  MemberSummary m;
  m.member = number;
  m.outcome = outcome;
  return m;
}

TEST(ShardLayout, CountsAsShardsAreDivided) {
  for (const std::int64_t planned : {1, 6, 7, 20})
    for (const int n : {1, 2, 3, 7, 9}) {
      const auto states = shard_states({}, planned, n);
      ASSERT_EQ(states.size(), static_cast<std::size_t>(n));
      for (const ShardState& s : states)
        EXPECT_EQ(s.members, std::ssize(shard_members(planned, s.k, n)))
            << planned << " members, shard " << s.k << " of " << n;
    }
}

TEST(ShardLayout, FailedMembersAreThereAndThoseBeyondTheDesignAreNot) {
  const std::vector<MemberSummary> members{member(0), member(1), member(3, Outcome::failed),
                                           member(9)};
  const auto states = shard_states(members, 6, 3);
  EXPECT_EQ(states[0].valid, 1);
  EXPECT_EQ(states[0].failed, 1);
  EXPECT_EQ(states[0].missing(), 0);
  EXPECT_EQ(states[1].missing(), 1);
  EXPECT_EQ(states[2].missing(), 2);
  EXPECT_THAT(workflow::missing_shards(states), ::testing::ElementsAre(2, 3));
}

TEST(ShardLayout, ListsAreShort) {
  const auto text = [](std::vector<int> numbers) { return workflow::ranges_text(numbers); };
  EXPECT_EQ(text({}), "");
  EXPECT_EQ(text({4}), "4");
  EXPECT_EQ(text({1, 2}), "1,2");
  EXPECT_EQ(text({1, 2, 3, 5, 9, 10, 11, 12}), "1-3,5,9-12");
}

TEST(ShardLayout, AShellGivesTheWordsBack) {
  for (const std::string word :
       {"plain.yaml", "with blank", "it's", "$HOME `date` \"x\"", "", "a;b", "--set=[1, 2]"}) {
    const std::string command = "printf %s " + workflow::shell_word(word);
    std::FILE* shell = popen(command.c_str(), "r");
    ASSERT_NE(shell, nullptr);
    std::string said;
    for (int c = std::fgetc(shell); c != EOF; c = std::fgetc(shell)) said += static_cast<char>(c);
    EXPECT_EQ(pclose(shell), 0);
    EXPECT_EQ(said, word) << command;
  }
  EXPECT_EQ(workflow::shell_word("out/a-1.yaml"), "out/a-1.yaml");
}

TEST(ShardPlanText, AsSchedulersWantIt) {
  EXPECT_EQ(workflow::time_limit_text(600), "00:10:00");
  EXPECT_EQ(workflow::time_limit_text(90061), "1-01:01:01");
  EXPECT_EQ(workflow::memory_text(399.5e6), "400M");
}

class Plan : public Workflow {};

TEST_F(Plan, ShardsTakeAtLeastTheWantedTime) {
  const workflow::Scene of = workflow::load_scene(scene({"ensemble.members=1000"}));
  workflow::PlanRequest request;
  request.shard_s = 1e-9;  // a second is the least
  request.most_shards = 7;
  const workflow::ShardPlan many = workflow::plan_shards(of, request);
  EXPECT_LE(many.shards, 7);
  EXPECT_EQ(many.most_members, (1000 + many.shards - 1) / many.shards);
  const double member_s = many.forecast.member_s.likely;
  EXPECT_GE(many.shard_s.likely, static_cast<double>(many.most_members) * member_s);
  EXPECT_GE(many.ask_s, 1.5 * many.shard_s.high);
  EXPECT_GT(many.ask_bytes, 148e6) << "the program alone takes that";
  request.shard_s = 1e6;
  EXPECT_EQ(workflow::plan_shards(of, request).shards, 1);
  request.shards = 5;
  EXPECT_EQ(workflow::plan_shards(of, request).shards, 5);
}

}  // namespace
}  // namespace sturz::test
