// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/calibration/chosen_members.hpp"

#include "engine/core/error.hpp"
#include "ensemble/sampling/design.hpp"
#include "ensemble/scores/score_table.hpp"
#include "ensemble/workflow/calibration/posterior_files.hpp"
#include "ensemble/workflow/folder/folder_members.hpp"
#include "ensemble/workflow/members/run_ensemble.hpp"
#include "ensemble/workflow/results/merge.hpp"
#include "ensemble/workflow/without_folder.hpp"
#include "io/files/atomic_file.hpp"
#include "io/files/text_files.hpp"

#include <fmt/core.h>

namespace sturz::workflow {
namespace fs = std::filesystem;
namespace {

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

namespace {

DesignTable points_of(const fs::path& table, const std::vector<std::string>& keys) {
  DesignTable points = from_csv(read_text(table));
  require(points.keys == keys && points.unit_cube.size() == points.values.size(),
          fmt::format("{} is not of these uncertain values (it was written for another scene). "
                      "Remove it and its folder, or choose another folder with --out.",
                      table.string()));
  return points;
}

/// Valid members join what was found before.
void take(ChosenMembers& found, const DesignTable& points, const MemberStore& store,
          const std::shared_ptr<const ObservedEvent>& event, CancelFlag cancel) {
  const ScoreTable scores = score_members(store, event, cancel);
  found.comparison.observed = scores.comparison.observed;
  const auto& [members, values] = scores.comparison.simulated;
  for (std::size_t i = 0; i < members.size(); ++i) {
    found.comparison.simulated.members.push_back(members[i]);
    found.comparison.simulated.values.push_back(values[i]);
    found.cube.push_back(points.unit_cube.at(static_cast<std::size_t>(members[i])));
  }
}

}  // namespace

fs::path round_table(const OutputFolder& folder, int round) {
  return folder.root / "active" / fmt::format("{}.csv", round);
}

ChosenMembers finished_rounds(const OutputFolder& folder, int from,
                              const std::vector<std::string>& keys,
                              const std::shared_ptr<const ObservedEvent>& event, Observer& observer,
                              CancelFlag cancel) {
  WithoutFolder quiet(observer);
  ChosenMembers found;
  for (int round = from; fs::exists(round_table(folder, round)); ++round) {
    const fs::path table = round_table(folder, round);
    const OutputFolder members{fs::path(table).replace_extension()};
    if (!fs::exists(members.manifest()) || !fs::exists(members.members()) ||
        fs::is_empty(members.members()))
      continue;  // stopped before its first member
    const MergeInput read = open_for_maps({members.root, true}, quiet, cancel);
    take(found, points_of(table, keys), read.store, event, cancel);
  }
  return found;
}

ChosenMembers compute_chosen(const EnsembleRequest& base, const EnsembleJob& job,
                             const fs::path& table, const std::vector<std::vector<double>>& cube,
                             Observer& observer, const std::atomic<bool>& cancel) {
  if (!fs::exists(table)) {
    make_folder(table.parent_path());
    write_text_atomic(table, to_csv(table_of(job, cube)));
  }
  const DesignTable points = points_of(table, job.design.keys);
  WithoutFolder quiet(observer);
  const EnsembleJob chosen = prepare_ensemble(request_of(base, table, points.values.size()), quiet);
  const MembersRun run = run_ensemble(chosen, quiet, cancel);
  require(run.stop_error.empty(), run.stop_error);
  if (run.interrupted) throw Cancelled();
  const CancelFlag flag(cancel);
  const MemberStore store = members_of(chosen.folder, chosen.manifest, chosen.design, {}, flag);
  ChosenMembers found;
  take(found, points, store, chosen.scene.inputs.event, flag);
  return found;
}

}  // namespace sturz::workflow
