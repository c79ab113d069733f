// SPDX-License-Identifier: Apache-2.0
// One member in a folder of its own.
#include "ensemble/workflow/members/single_run.hpp"

#include "engine/core/error.hpp"
#include "io/netcdf/netcdf_layers.hpp"
#include "tests/workflow/workflow_fixture.hpp"

namespace sturz::test {
namespace {

using ::testing::HasSubstr;

class RunWorkflow : public Workflow {
 protected:
  workflow::RunRequest run_request(const std::string& results) const {
    return {scene(), path(results), 1, {}, "test"};
  }
};

TEST_F(RunWorkflow, ComputesTheMediansAndKeepsThem) {
  Recorder heard;
  workflow::SingleRun run = workflow::prepare_run(run_request("out"), heard);
  const MemberResult result = workflow::compute_run(run, heard, heard.cancel);
  EXPECT_TRUE(is_valid(result.outcome)) << result.reason;
  EXPECT_FALSE(exists("out/peaks.nc")) << "computing alone stores nothing";
  workflow::store_run(run, result);
  for (const char* file : {"out/peaks.nc", "out/report.html", "out/members/000000.nc"})
    EXPECT_TRUE(exists(file)) << file;
  EXPECT_GT(workflow::Manifest::read(run.folder.manifest()).compute_s, 0);

  workflow::RunRequest moved = run_request("moved");
  moved.scene = scene({"basal.friction_coefficient=0.5", "basal.pore_pressure_ratio=0.15"});
  workflow::SingleRun medians = workflow::prepare_run(moved, heard);
  EXPECT_EQ(workflow::compute_run(medians, heard, heard.cancel).state_hash, result.state_hash);
}

TEST_F(RunWorkflow, WhatItWarnsOfStandsInFileAndPage) {
  Recorder heard;
  workflow::RunRequest early = run_request("out");
  early.scene = scene({"numerics.end_time_s=0.4"});
  workflow::SingleRun run = workflow::prepare_run(early, heard);
  const MemberResult result = workflow::compute_run(run, heard, heard.cancel);
  ASSERT_EQ(result.censoring, Censoring::still_moving);
  workflow::store_run(run, result);
  std::string said;
  const LayersFileReader peaks(path("out/peaks.nc"));
  for (const auto& [name, text] : peaks.about().attributes)
    if (name == "warnings") said = text;
  EXPECT_THAT(said, HasSubstr("longer numerics.end_time_s"));
  for (const std::string& warning : run.manifest.warnings) EXPECT_THAT(said, HasSubstr(warning));
  EXPECT_THAT(read("out/report.html"), HasSubstr("longer numerics.end_time_s"));
}

TEST_F(RunWorkflow, ACancelledOneSaysSo) {
  Recorder heard;
  heard.cancel = true;
  workflow::RunRequest seconds = run_request("out");  // long enough to be asked
  seconds.scene = scene({"formulation=full_stress", "numerics.spacing_m=0.5"});
  const workflow::SingleRun run = workflow::prepare_run(seconds, heard);
  EXPECT_EQ(workflow::compute_run(run, heard, heard.cancel).outcome, Outcome::cancelled);
  EXPECT_GE(heard.n_run_progress, 1);
}

TEST_F(RunWorkflow, FramesAreThereOnlyWhereWanted) {
  Recorder silent;
  workflow::RunRequest with_frames = run_request("out");
  with_frames.particles_every_s = 1;
  workflow::SingleRun first = workflow::prepare_run(with_frames, silent);
  workflow::compute_run(first, silent, silent.cancel);
  EXPECT_TRUE(exists("out/particles"));
  workflow::SingleRun second = workflow::prepare_run(run_request("out"), silent);
  workflow::compute_run(second, silent, silent.cancel);
  EXPECT_FALSE(exists("out/particles")) << "frames of an earlier run";
}

TEST_F(RunWorkflow, AnEnsemblesFolderIsRefused) {
  Recorder silent;
  workflow::prepare_ensemble(request("out"), silent);
  EXPECT_THROW(workflow::prepare_run(run_request("out"), silent), SetupError);
}

}  // namespace
}  // namespace sturz::test
