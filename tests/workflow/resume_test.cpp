// SPDX-License-Identifier: Apache-2.0
// Whatever stopped an ensemble, the same request goes on and leaves no trace in the maps.
#include "engine/core/error.hpp"
#include "tests/workflow/workflow_fixture.hpp"

#include <stdexcept>

namespace sturz::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class ResumeWorkflow : public Workflow {};

TEST_F(ResumeWorkflow, ACancelledRunGoesOnToTheSameMaps) {
  Recorder first;
  first.cancel_after = 2;
  const workflow::MembersRun stopped = run(request("out"), first);
  EXPECT_TRUE(stopped.interrupted);
  EXPECT_EQ(stopped.finished, 2);
  EXPECT_EQ(stopped.total, n_tiny);
  EXPECT_EQ(n_members("out"), 2u);

  Recorder second;
  const workflow::MapsMade made = whole(request("out"), second);
  EXPECT_THAT(second.members, ElementsAre(2, 3, 4, 5));
  EXPECT_EQ(made.hazard_hash, undisturbed());
}

TEST_F(ResumeWorkflow, ACancelFromTheStartComputesNothing) {
  Recorder heard;
  heard.cancel = true;
  const workflow::MembersRun stopped = run(request("out"), heard);
  EXPECT_TRUE(stopped.interrupted);
  EXPECT_EQ(stopped.finished, 0);
  EXPECT_EQ(n_members("out"), 0u);
}

TEST_F(ResumeWorkflow, ADamagedMemberIsToldAndComputedAgain) {
  Recorder first;
  const std::string hash = whole(request("out"), first).hazard_hash;
  damage("out", 3);
  Recorder second;
  const workflow::MapsMade made = whole(request("out"), second);
  ASSERT_EQ(second.warnings.size(), 1u);
  EXPECT_THAT(second.warnings[0], HasSubstr("000003.nc"));
  EXPECT_THAT(second.members, ElementsAre(3));
  EXPECT_EQ(made.hazard_hash, hash);
}

TEST_F(ResumeWorkflow, AFolderOfAnotherSceneIsRefusedUntouched) {
  Recorder first;
  whole(request("out"), first);
  const std::string before = read("out/scenario.yaml");
  workflow::EnsembleRequest other = request("out");
  other.scene = scene({"basal.friction_coefficient=0.9"});
  Recorder second;
  try {
    workflow::prepare_ensemble(other, second);
    FAIL() << "members of two scenes in one folder";
  } catch (const SetupError& refused) {
    EXPECT_THAT(refused.what(), HasSubstr("basal.friction_coefficient"));
  }
  EXPECT_TRUE(second.order.empty()) << "the folder was called ready";
  EXPECT_EQ(read("out/scenario.yaml"), before);
}

TEST_F(ResumeWorkflow, AnEnsembleGrowsByItsNewMembersOnly) {
  workflow::EnsembleRequest four = request("out");
  four.members = 4;
  Recorder first, second;
  EXPECT_EQ(whole(four, first).planned, 4);
  EXPECT_EQ(whole(request("out"), second).hazard_hash, undisturbed());
  EXPECT_THAT(second.members, ElementsAre(4, 5));
}

TEST_F(ResumeWorkflow, AListenerThatThrowsStopsTheRunAndLosesNoMember) {
  struct Thrower : Recorder {
    void member_stored(const MemberResult& result) override {
      Recorder::member_stored(result);
      if (members.size() == 2) throw std::runtime_error("the observer is gone");
    }
  };
  Thrower first;
  const workflow::MembersRun stopped = run(request("out"), first);
  EXPECT_THAT(stopped.stop_error, HasSubstr("the observer is gone"));
  EXPECT_FALSE(stopped.interrupted);
  EXPECT_EQ(n_members("out"), 2u);
  Recorder second;
  EXPECT_EQ(whole(request("out"), second).hazard_hash, undisturbed());
}

}  // namespace
}  // namespace sturz::test
