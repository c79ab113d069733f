// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/calibration/chosen_members.hpp"

#include "engine/core/error.hpp"
#include "ensemble/sampling/design.hpp"
#include "ensemble/scores/score_table.hpp"
#include "ensemble/workflow/calibration/posterior_files.hpp"
#include "ensemble/workflow/folder/folder_members.hpp"
#include "ensemble/workflow/members/run_ensemble.hpp"
#include "io/files/atomic_file.hpp"
#include "io/files/text_files.hpp"

#include <fmt/core.h>

namespace sturz::workflow {
namespace fs = std::filesystem;
namespace {

/// The listener of the whole: this folder's log is not its log.
class WithoutFolder final : public Observer {
 public:
  explicit WithoutFolder(Observer& to) : to_(to) {}
  void warning(std::string_view text) override { to_.warning(text); }
  void ensemble_progress(const RunnerProgress& progress, std::int64_t before) override {
    to_.ensemble_progress(progress, before);
  }
  void member_stored(const MemberResult& result) override { to_.member_stored(result); }

 private:
  Observer& to_;
};

DesignTable table_of(const EnsembleJob& job, const std::vector<std::vector<double>>& cube) {
  DesignTable table;
  table.keys = job.design.keys;
  table.units = job.design.units;
  table.design = Design::table;
  table.seed = job.design.seed;
  table.unit_cube = cube;
  table.values = values_at(uncertain_keys(job.scene.scenario), job.scene.scenario.ensemble, cube);
  return table;
}

EnsembleRequest request_of(const EnsembleRequest& base, const fs::path& table, std::size_t n) {
  EnsembleRequest request = base;
  request.folder = fs::path(table).replace_extension();
  request.members = 0;
  for (const std::string& set :
       {std::string("ensemble.design=table"), "ensemble.table=" + yaml_quoted(fs::absolute(table)),
        std::string("ensemble.correlation={}"), fmt::format("ensemble.members={}", n)})
    request.scene.overrides.push_back(set);
  request.command = base.command + " (chosen members)";
  return request;
}

}  // namespace

ChosenMembers compute_chosen(const EnsembleRequest& base, const EnsembleJob& job,
                             const fs::path& table, const std::vector<std::vector<double>>& cube,
                             Observer& observer, const std::atomic<bool>& cancel) {
  if (!fs::exists(table)) {
    make_folder(table.parent_path());
    write_text_atomic(table, to_csv(table_of(job, cube)));
  }
  const DesignTable points = from_csv(read_text(table));
  require(points.keys == job.design.keys && points.unit_cube.size() == points.values.size(),
          fmt::format("{} is not of these uncertain values (it was written for another scene). "
                      "Remove it and its folder, or choose another folder with --out.",
                      table.string()));
  WithoutFolder quiet(observer);
  const EnsembleJob chosen = prepare_ensemble(request_of(base, table, points.values.size()), quiet);
  const MembersRun run = run_ensemble(chosen, quiet, cancel);
  require(run.stop_error.empty(), run.stop_error);
  if (run.interrupted) throw Cancelled();
  const CancelFlag flag(cancel);
  const MemberStore store = members_of(chosen.folder, chosen.manifest, chosen.design, {}, flag);
  const ScoreTable scores = score_members(store, chosen.scene.inputs.event, flag);
  ChosenMembers found;
  found.comparison = scores.comparison;
  for (const std::int64_t m : found.comparison.simulated.members)
    found.cube.push_back(points.unit_cube.at(static_cast<std::size_t>(m)));
  return found;
}

}  // namespace sturz::workflow
