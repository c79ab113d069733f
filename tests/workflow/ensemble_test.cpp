// SPDX-License-Identifier: Apache-2.0
// One ensemble from request to maps: what the observer hears and what comes back.
#include "engine/core/error.hpp"
#include "ensemble/workflow/machine/cores.hpp"
#include "io/members/member_store.hpp"
#include "tests/workflow/workflow_fixture.hpp"

#include <algorithm>

namespace sturz::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class EnsembleWorkflow : public Workflow {};

TEST_F(EnsembleWorkflow, TellsEveryMemberOnceAndInOrder) {
  Recorder heard;
  whole(request("out"), heard);
  EXPECT_THAT(heard.order, ElementsAre("folder", "member", "member", "member", "member", "member",
                                       "member", "maps"));
  EXPECT_THAT(heard.members, ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_EQ(heard.last_progress.n_done, n_tiny);
  EXPECT_TRUE(heard.warnings.empty()) << heard.warnings.front();
}

TEST_F(EnsembleWorkflow, WorkersLeaveNoTraceInTheMaps) {
  workflow::EnsembleRequest three = request("three");
  three.workers = 3;
  Recorder heard;
  const workflow::MapsMade made = whole(three, heard);
  EXPECT_EQ(made.hazard_hash, undisturbed());
  std::sort(heard.members.begin(), heard.members.end());
  EXPECT_THAT(heard.members, ElementsAre(0, 1, 2, 3, 4, 5));
}

TEST_F(EnsembleWorkflow, SharesTheCoresOfTheMachine) {
  workflow::EnsembleRequest many = request("out");
  many.workers = 4096;
  Recorder silent;
  const workflow::EnsembleJob job = workflow::prepare_ensemble(many, silent);
  // Never more than there are members, nor than there are cores, and it says so.
  EXPECT_EQ(job.workers, std::min<int>(n_tiny, workflow::available_cores()));
  EXPECT_THAT(silent.warnings, ElementsAre(::testing::HasSubstr("--workers 4096 on ")));
  EXPECT_GE(job.threads, 1);
  EXPECT_LE(job.threads, std::max(1, workflow::available_cores() / job.workers));
}

TEST_F(EnsembleWorkflow, AMemberAloneIsTheStoredOne) {
  Recorder silent;
  const workflow::EnsembleJob job = workflow::prepare_ensemble(request("out"), silent);
  workflow::run_ensemble(job, silent, silent.cancel);
  const MemberStore store(job.folder.members());
  ASSERT_EQ(store.members().size(), static_cast<std::size_t>(n_tiny));
  const MemberResult alone = workflow::run_member(job, 4, silent.cancel);
  EXPECT_EQ(alone.state_hash, store.members()[4].state_hash);
  EXPECT_NE(alone.state_hash, store.members()[3].state_hash);
}

TEST_F(EnsembleWorkflow, AFailedMemberIsStoredWithItsReasonAndStopsNoOther) {
  // Row 1 is thinner than a fifth of a particle: none can stand for it.
  write("rows.csv", "release.thickness_m,basal.friction_coefficient\n2,0.4\n0.1,0.4\n2,0.5\n");
  std::string text = replaced(tiny_scene(), "thickness_m: 3", "thickness_m: {uniform: [0.1, 4]}");
  text = replaced(text, "end_time_s: 3", "end_time_s: 0.5");
  text = replaced(text, "pore_pressure_ratio: {uniform: [0.0, 0.3]}", "pore_pressure_ratio: 0");
  text = replaced(text, "{design: sobol, members: 6, seed: 1}", "{design: table, table: rows.csv}");
  write("scene.yaml", text);
  Recorder heard;
  workflow::EnsembleJob job = workflow::prepare_ensemble(request("out"), heard);
  const workflow::MembersRun run = workflow::run_ensemble(job, heard, heard.cancel);
  EXPECT_EQ(run.finished, 3);
  ASSERT_EQ(run.failed.size(), 1u);
  EXPECT_EQ(run.failed[0].member, 1);
  EXPECT_THAT(run.failed[0].reason, HasSubstr("release"));
  EXPECT_THAT(heard.outcomes, ::testing::Contains(Outcome::failed).Times(1));
  const workflow::MapsMade made = workflow::make_maps(job, heard);
  EXPECT_EQ(made.valid, 2);
  EXPECT_EQ(made.failed(), 1);
  EXPECT_TRUE(made.too_many_failed());  // a third, where a twentieth is accepted

  workflow::EnsembleRequest again = request("out");
  Recorder quiet;
  EXPECT_TRUE(workflow::prepare_ensemble(again, quiet).to_do.empty());
  again.retry_failed = true;
  EXPECT_THAT(workflow::prepare_ensemble(again, quiet).to_do, ElementsAre(1));
}

TEST_F(EnsembleWorkflow, AShardOutsideItsNumberIsRefusedBeforeAnythingIsWritten) {
  workflow::EnsembleRequest fourth = request("out");
  fourth.shard = {4, 3};
  Recorder silent;
  EXPECT_THROW(workflow::prepare_ensemble(fourth, silent), SetupError);
  EXPECT_FALSE(exists("out"));
}

}  // namespace
}  // namespace sturz::test
