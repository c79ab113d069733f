// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/results/merge.hpp"

#include "engine/core/error.hpp"
#include "ensemble/workflow/folder/finished_folder.hpp"
#include "ensemble/workflow/folder/saved_design.hpp"
#include "io/members/member_store.hpp"

#include <fmt/core.h>

#include <set>
#include <string>

namespace sturz::workflow {
namespace {

/// "3 of 6 members are missing (1, 3, 5)", at most twenty named; empty when none is.
std::string what_is_missing(const MemberStore& store, std::int64_t planned) {
  std::set<std::int64_t> there;
  for (const MemberSummary& m : store.members()) there.insert(m.member);
  std::int64_t missing = 0;
  std::string names;
  for (std::int64_t k = 0; k < planned; ++k) {
    if (there.contains(k)) continue;
    if (++missing <= 20) names += (names.empty() ? "" : ", ") + std::to_string(k);
  }
  if (missing == 0) return {};
  if (missing > 20) names += ", ...";
  return fmt::format("{} of {} members are missing ({})", missing, planned, names);
}

}  // namespace

MapsMade merge_members(const MergeRequest& request, Observer& observer, CancelFlag cancel) {
  FinishedFolder finished = open_finished(request.folder, observer);
  const std::string where = request.folder.string();
  require(finished.manifest.kind == "ensemble",
          fmt::format("{} holds a single run (there is nothing to merge).", where));
  const DesignTable design = saved_design(finished.folder);
  const MemberStore store(finished.folder.members(), MemberCheck::open, cancel);
  for (const std::string& problem : store.problems()) observer.warning(problem);
  const std::string missing = what_is_missing(store, design.n_members());
  require(missing.empty() || request.partial,
          fmt::format("{}: {}. Run their shards, or make maps from the others with --partial.",
                      where, missing));
  require(!store.members().empty(),
          fmt::format("{} has no finished member (maps need at least one).", where));
  if (!missing.empty()) observer.warning(missing + "; the maps are made from the others.");
  observer.folder_ready(finished.folder);
  return make_maps(
      {finished.folder, finished.manifest, finished.scenario, design, finished.elevation.get()},
      store, observer, cancel);
}

}  // namespace sturz::workflow
