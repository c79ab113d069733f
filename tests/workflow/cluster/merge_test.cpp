// SPDX-License-Identifier: Apache-2.0
// Shards in any order, then one merge: the same bits as one run.
#include "ensemble/workflow/results/merge.hpp"

#include "engine/core/error.hpp"
#include "ensemble/workflow/members/single_run.hpp"
#include "tests/workflow/workflow_fixture.hpp"

namespace sturz::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class MergeWorkflow : public Workflow {
 protected:
  void run_shard(int k, int n, const std::string& results = "out") const {
    workflow::EnsembleRequest part = request(results);
    part.shard = {k, n};
    Recorder silent;
    const workflow::MembersRun done = run(part, silent);
    EXPECT_EQ(done.finished, done.total);
  }
  /// What the merge is refused with.
  std::string refusal(const std::string& results) const {
    Recorder silent;
    try {
      workflow::merge_members({path(results)}, silent);
    } catch (const SetupError& refused) {
      return refused.what();
    }
    return "not refused";
  }
};

TEST_F(MergeWorkflow, ShardsGiveTheBitsOfOneRun) {
  for (const int k : {3, 1, 2}) run_shard(k, 3);
  EXPECT_FALSE(exists("out/hazard.nc")) << "a shard made maps";
  Recorder heard;
  const workflow::MapsMade made = workflow::merge_members({path("out")}, heard);
  EXPECT_EQ(made.hazard_hash, undisturbed());
  EXPECT_THAT(heard.order, ElementsAre("folder", "maps"));
  EXPECT_TRUE(heard.warnings.empty());
}

TEST_F(MergeWorkflow, NamesWhatIsMissingUnlessToldToGoOn) {
  run_shard(1, 2);
  EXPECT_THAT(refusal("out"), HasSubstr("3 of 6 members are missing (1, 3, 5). Shard 2 of 2 is not "
                                        "finished. Resume with the command that computed them: "));
  EXPECT_THAT(refusal("out"), HasSubstr("out --shard 2/2; or make maps from the others"));
  EXPECT_FALSE(exists("out/hazard.nc"));
  Recorder heard;
  const workflow::MapsMade made = workflow::merge_members({path("out"), true}, heard);
  EXPECT_EQ(made.planned, 6);
  EXPECT_EQ(made.finished, 3);
  ASSERT_EQ(heard.warnings.size(), 1u);
  EXPECT_THAT(heard.warnings[0], HasSubstr("3 of 6 members are missing"));
  EXPECT_NE(made.hazard_hash, undisturbed()) << "three members make the maps of six";
}

TEST_F(MergeWorkflow, ADamagedMemberCountsAsMissing) {
  run_shard(1, 1);
  damage("out", 2);
  EXPECT_THAT(refusal("out"), HasSubstr("1 of 6 members are missing (2)"));
}

TEST_F(MergeWorkflow, AFolderWithoutAnEnsembleIsRefused) {
  std::filesystem::create_directory(path("empty"));
  EXPECT_THAT(refusal("empty"), HasSubstr("holds no results"));
  Recorder silent;
  workflow::prepare_run({scene(), path("single"), 1, {}, "test"}, silent);
  EXPECT_THAT(refusal("single"), HasSubstr("nothing to merge"));
}

}  // namespace
}  // namespace sturz::test
