// SPDX-License-Identifier: Apache-2.0
// An ensemble given to a Slurm that this test plays: what is submitted, what is not, what is left.
#include "ensemble/workflow/cluster/submit.hpp"

#include "engine/core/error.hpp"
#include "ensemble/workflow/cluster/folder_state.hpp"
#include "ensemble/workflow/results/merge.hpp"
#include "tests/workflow/workflow_fixture.hpp"

#include <algorithm>
#include <map>

namespace sturz::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using workflow::Ran;
using workflow::Submitted;

/// Jobs with their names and tasks; a command may be told to fail.
struct PlayedSlurm {
  struct Job {
    std::string name, tasks;
    bool held = false;
  };
  std::map<int, Job> jobs;
  std::vector<std::string> submitted;  ///< text of each script
  std::string fails;                   ///< script whose submission is refused
  bool there = true, dies = false;     ///< dies: nothing works any more after the first sbatch

  static std::string value(const std::string& script, const std::string& option) {
    const std::size_t at = script.find("--" + option + "=\"");
    if (at == std::string::npos) return "";
    const std::size_t begin = at + option.size() + 4;
    return script.substr(begin, script.find('"', begin) - begin);
  }
  /// One digit each: "1-3" and "1,2,3" are "123"; "N" for a job that is no array.
  static std::string tasks_of(const Job& job) {
    std::string all;
    for (std::size_t i = 0; i < job.tasks.size(); ++i) {
      if (job.tasks[i] == '-')
        for (char c = job.tasks[i - 1]; ++c < job.tasks[i + 1];) all += c;
      else if (job.tasks[i] != ',')
        all += job.tasks[i];
    }
    return all.empty() ? "N" : all;
  }
  Ran sbatch(const std::vector<std::string>& words, const std::string& text) {
    if (!fails.empty() && words.back().ends_with(fails)) return {true, 1, "", "refused by test\n"};
    const int number = 100 + static_cast<int>(submitted.size());
    submitted.push_back(text);
    jobs[number] = {value(text, "job-name"), value(text, "array"),
                    std::find(words.begin(), words.end(), "--hold") != words.end()};
    return {true, 0, std::to_string(number) + "\n", ""};
  }
  Ran operator()(const std::vector<std::string>& words, const Workflow*, const std::string& text) {
    if (!there) return {false, 127, "", ""};
    if (words[0] == "sbatch" && words.back() == "--version") return {};
    if (dies && !submitted.empty()) throw std::runtime_error("the machine stops here");
    if (words[0] == "sbatch") return sbatch(words, text);
    if (words[0] == "scontrol" && words[1] == "show") return {true, 0, "MaxArraySize = 11\n", ""};
    if (words[0] == "scontrol") jobs.at(std::stoi(words[2])).held = false;
    if (words[0] == "scancel")
      for (std::size_t i = 1; i < words.size(); ++i) jobs.erase(std::stoi(words[i]));
    if (words[0] != "squeue") return {};
    std::string lines;
    for (const auto& [number, job] : jobs)
      if (words.back().find(job.name) != std::string::npos)
        for (const char c : tasks_of(job))
          lines += std::to_string(number) + "|" + c + "|" + job.name + "|PENDING\n";
    return {true, 0, lines, ""};
  }
};

class Submit : public Workflow {
 protected:
  workflow::SubmitRequest ask(int shards) const {
    workflow::SubmitRequest r;
    r.ensemble = request("out");
    r.plan.shards = shards;
    r.asked = {1, 600, 1e9, 600, 1e9};
    r.work_folder = path("").string();
    r.program = "/usr/bin/sturz";
    r.words = {"scene.yaml"};
    return r;
  }
  Submitted submit(int shards = 2) { return submit(ask(shards)); }
  Submitted submit(const workflow::SubmitRequest& request) {
    const auto run = [this](const std::vector<std::string>& words) {
      const std::string& last = words.back();
      return slurm(words, this, last.ends_with(".sh") ? text_of(last) : "");
    };
    return workflow::submit(request, run, heard);
  }
  std::string text_of(const std::string& file) const {
    return read(std::filesystem::relative(file, path("")).string());
  }
  std::string refusal(int shards) {
    try {
      submit(shards);
    } catch (const SetupError& refused) {
      return refused.what();
    }
    return "not refused";
  }
  void compute(int k, int n) const {
    workflow::EnsembleRequest part = request("out");
    part.shard = {k, n};
    Recorder silent;
    run(part, silent);
  }
  PlayedSlurm slurm;
  Recorder heard;
};

TEST_F(Submit, AnArrayIsReleasedOnceTheMergeStandsBehindIt) {
  const Submitted done = submit();
  ASSERT_EQ(slurm.jobs.size(), 2u);
  EXPECT_EQ(slurm.jobs[100].tasks, "1,2");
  EXPECT_FALSE(slurm.jobs[100].held);
  EXPECT_EQ(slurm.jobs[101].name, slurm.jobs[100].name + "-maps");
  EXPECT_THAT(done.shards, ElementsAre(1, 2));
  EXPECT_THAT(slurm.submitted[0], HasSubstr("#SBATCH --requeue"));
  EXPECT_THAT(slurm.submitted[0], HasSubstr("#SBATCH --signal=B:USR1@60"));
  EXPECT_THAT(slurm.submitted[0], HasSubstr("--shard auto/2)"));
  EXPECT_THAT(slurm.submitted[1], HasSubstr("/usr/bin/sturz merge "));
  EXPECT_TRUE(exists("out/scenario.yaml")) << "the folder is begun";
}

TEST_F(Submit, OnlyMissingShardsThatAreNotQueuedAreSubmittedAgain) {
  submit(3);
  Submitted again = submit(0);
  EXPECT_TRUE(again.nothing_to_do);
  EXPECT_THAT(again.queued, ElementsAre(1, 2, 3));
  slurm.jobs.erase(100);  // the array is over: shards 1 and 3 have come to their end
  compute(1, 3);
  compute(3, 3);
  again = submit(0);
  EXPECT_THAT(again.shards, ElementsAre(2));
  EXPECT_EQ(slurm.jobs[102].tasks, "2");
  EXPECT_EQ(slurm.jobs.count(101), 0u) << "the merge of before would find gaps";
  EXPECT_THAT(refusal(2), HasSubstr("still compute the folder in 3"));
  slurm.jobs.clear();
  compute(2, 3);
  again = submit(0);
  EXPECT_THAT(again.shards, IsEmpty());
  ASSERT_EQ(slurm.jobs.size(), 1u) << "the maps alone";
  workflow::merge_members({path("out")}, heard);
  EXPECT_TRUE(submit(0).nothing_to_do);
}

TEST_F(Submit, KilledHalfWayNothingRunsAndTheNextCallCleansUp) {
  slurm.dies = true;
  // The guard of submit() sees the end of the played machine, so take its last word back.
  EXPECT_THROW(submit(), std::runtime_error);
  slurm.dies = false;
  ASSERT_EQ(slurm.jobs.size(), 1u);
  EXPECT_TRUE(slurm.jobs[100].held);
  const auto record = path("out/cluster/submission.json");
  auto left = workflow::read_submission(record);
  ASSERT_TRUE(left.has_value());
  EXPECT_FALSE(left->complete);
  const Submitted again = submit();
  EXPECT_EQ(slurm.jobs.count(100), 0u);
  EXPECT_THAT(again.record.jobs, ElementsAre("101"));
  EXPECT_FALSE(slurm.jobs[101].held);
  ASSERT_FALSE(heard.warnings.empty());
  EXPECT_THAT(heard.warnings.back(), HasSubstr("stopped half-way; its jobs (100)"));
}

TEST_F(Submit, WhatSlurmRefusesLeavesNoJob) {
  slurm.fails = "merge.sh";
  EXPECT_THAT(refusal(2), HasSubstr("refused by test"));
  EXPECT_THAT(slurm.jobs, IsEmpty());
  EXPECT_TRUE(workflow::read_submission(path("out/cluster/submission.json"))->complete);
  EXPECT_THAT(refusal(11), HasSubstr("arrays up to task 10"));
  slurm.there = false;
  EXPECT_THAT(refusal(2), HasSubstr("sbatch is not here"));
}

TEST_F(Submit, AnotherSceneIsRefused) {
  submit();
  workflow::SubmitRequest other = ask(2);
  other.ensemble.scene = scene({"grains.friction_angle_deg=35"});
  EXPECT_THROW(submit(other), SetupError);
}

TEST_F(Submit, TheStateIsSeenWhileOthersCompute) {
  submit(3);
  compute(2, 3);
  const auto lock = workflow::FolderLock::shard({path("out")}, {3, 3}, "ensemble s.yaml");
  lock->say_workers(2);
  lock->others_may_come();
  const workflow::FolderState state = workflow::folder_state({path("out")}, 0);
  EXPECT_EQ(state.planned, n_tiny);
  EXPECT_EQ(state.finished(), 2);
  EXPECT_THAT(workflow::missing_shards(state.shards), ElementsAre(1, 3));
  ASSERT_EQ(state.workers.size(), 1u);
  EXPECT_EQ(state.workers[0].shard.k, 3);
  EXPECT_FALSE(state.workers[0].gone);
  EXPECT_EQ(state.at_a_time(), 2);
  EXPECT_DOUBLE_EQ(state.remaining_s(), 4 * state.member_s() / 2);
  EXPECT_EQ(state.maps, workflow::MapsState::none);
}

}  // namespace
}  // namespace sturz::test
