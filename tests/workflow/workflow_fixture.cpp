// SPDX-License-Identifier: Apache-2.0
#include "tests/workflow/workflow_fixture.hpp"

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <utility>

namespace sturz::test {
namespace fs = std::filesystem;

void Recorder::warning(std::string_view text) { warnings.emplace_back(text); }

void Recorder::folder_ready(const workflow::OutputFolder& folder) {
  EXPECT_TRUE(fs::is_directory(folder.root));
  order.emplace_back("folder");
}

void Recorder::run_progress(const Progress&) { ++n_run_progress; }

void Recorder::ensemble_progress(const RunnerProgress& progress, std::int64_t) {
  last_progress = progress;
}

void Recorder::member_stored(const MemberResult& result) {
  order.emplace_back("member");
  members.push_back(result.member);
  outcomes.push_back(result.outcome);
  if (members.size() == cancel_after) cancel = true;
}

void Recorder::maps_begin() { order.emplace_back("maps"); }

Workflow::Workflow() {
  std::string name = (fs::temp_directory_path() / "sturz-workflow-XXXXXX").string();
  folder_ = mkdtemp(name.data());
  // Columns: a member takes milliseconds, and what is tested does not depend on the formulation.
  write("scene.yaml",
        replaced(tiny_scene(), "formulation: full_stress", "formulation: depth_averaged"));
}

Workflow::~Workflow() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

void Workflow::write(const std::string& name, const std::string& text) const {
  std::ofstream(path(name), std::ios::binary) << text;
}

std::string Workflow::read(const std::string& name) const {
  std::ostringstream text;
  text << std::ifstream(path(name), std::ios::binary).rdbuf();
  return text.str();
}

std::size_t Workflow::n_members(const std::string& results) const {
  std::size_t n = 0;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(path(results) / "members", ignored))
    n += entry.path().extension() == ".nc";
  return n;
}

void Workflow::damage(const std::string& results, std::int64_t member) const {
  const std::string name = results + "/members/00000" + std::to_string(member) + ".nc";
  ASSERT_TRUE(exists(name));
  fs::resize_file(path(name), fs::file_size(path(name)) / 2);
}

workflow::SceneRequest Workflow::scene(std::vector<std::string> overrides) const {
  // One cache for all tests: measuring this machine takes longer than most of them.
  const fs::path cache = fs::path(STURZ_BINARY_DIR) / "workflow_test_speed.json";
  return {path("scene.yaml").string(), std::move(overrides), {cache}};
}

workflow::EnsembleRequest Workflow::request(const std::string& results) const {
  workflow::EnsembleRequest request;
  request.scene = scene();
  request.folder = path(results);
  request.workers = 1;
  request.command = "test";
  return request;
}

workflow::MembersRun Workflow::run(const workflow::EnsembleRequest& request, Recorder& recorder) {
  const workflow::EnsembleJob job = workflow::prepare_ensemble(request, recorder);
  return workflow::run_ensemble(job, recorder, recorder.cancel);
}

workflow::MapsMade Workflow::whole(const workflow::EnsembleRequest& request, Recorder& recorder) {
  workflow::EnsembleJob job = workflow::prepare_ensemble(request, recorder);
  const workflow::MembersRun run = workflow::run_ensemble(job, recorder, recorder.cancel);
  EXPECT_EQ(run.finished, run.total);
  return workflow::make_maps(job, recorder);
}

std::string Workflow::undisturbed() const {
  Recorder recorder;
  const workflow::MapsMade made = whole(request("undisturbed"), recorder);
  EXPECT_EQ(made.valid, n_tiny);
  EXPECT_FALSE(made.hazard_hash.empty());
  return made.hazard_hash;
}

}  // namespace sturz::test
