// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/results/merge.hpp"

#include "engine/core/error.hpp"
#include "ensemble/workflow/cluster/shard_layout.hpp"
#include "ensemble/workflow/folder/finished_folder.hpp"
#include "ensemble/workflow/folder/folder_lock.hpp"
#include "ensemble/workflow/folder/folder_members.hpp"
#include "ensemble/workflow/folder/input_check.hpp"
#include "ensemble/workflow/folder/saved_design.hpp"
#include "ensemble/workflow/folder/scene_identity.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <string>
#include <utility>

namespace sturz::workflow {

MergeInput open_for_maps(const MergeRequest& request, Observer& observer, CancelFlag cancel) {
  FinishedFolder finished = open_finished(request.folder, observer);
  const std::string where = request.folder.string();
  require(finished.manifest.kind == "ensemble",
          fmt::format("{} holds no ensemble but a {} (there is nothing to merge).", where,
                      finished.manifest.kind));
  require(finished.inputs != nullptr,
          fmt::format("{}: its input files cannot be read (maps say 0 only where the ground is "
                      "known, so they need the terrain). Put the files back where scenario.yaml "
                      "names them.",
                      where));
  require(
      finished.changed.empty(),
      fmt::format("{}: its members were computed from other inputs (maps say 0 only where the "
                  "ground is known, and would take it from today's). Take these changes back:{}",
                  where, as_lines(finished.changed)));
  auto lock = FolderLock::alone(finished.folder, "merge " + where);
  finished.manifest = Manifest::read(finished.folder.manifest());  // no other process writes it now
  require_own_scenario(finished.folder, finished.manifest, finished.scenario);
  DesignTable design = saved_design(finished.folder, finished.manifest, finished.scenario);
  MemberStore store = members_of(finished.folder, finished.manifest, design, {}, cancel);
  warn_of_problems(store, "It counts as missing.", observer);
  const std::string missing = what_is_missing(store, design.n_members());
  if (!missing.empty() && !request.partial) {
    const auto shards = missing_shards(
        shard_states(store.members(), design.n_members(), std::max(1, finished.manifest.shards)));
    throw SetupError(fmt::format("{}: {}. {}; or make maps from the others with --partial.", where,
                                 missing,
                                 how_to_resume(finished.manifest, request.folder, shards)));
  }
  require(!store.members().empty(),
          fmt::format("{} has no finished member (maps need at least one).", where));
  if (!missing.empty()) observer.warning(missing + "; the maps are made from the others.");
  warn_of_builds(finished.manifest, observer);
  observer.folder_ready(finished.folder);
  return {std::move(finished), std::move(lock), std::move(design), std::move(store)};
}

MapsMade merge_members(const MergeRequest& request, Observer& observer, CancelFlag cancel) {
  MergeInput of = open_for_maps(request, observer, cancel);
  of.lock->require_ours();
  FinishedFolder& finished = of.finished;
  return make_maps(
      {finished.folder, finished.manifest, finished.scenario, of.design, *finished.inputs},
      of.store, observer, cancel);
}

}  // namespace sturz::workflow
