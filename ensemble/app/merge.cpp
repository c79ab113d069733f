// SPDX-License-Identifier: Apache-2.0
// sturz merge: maps from the members that shards have left in a folder.
#include "engine/core/error.hpp"
#include "ensemble/app/commands.hpp"
#include "ensemble/app/finished_folder.hpp"
#include "ensemble/app/maps.hpp"
#include "ensemble/app/saved_design.hpp"
#include "io/members/member_store.hpp"

#include <fmt/core.h>

#include <memory>
#include <set>

namespace sturz::app {
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

int merge_command(const MergeOptions& options, Console& console) {
  FinishedFolder finished = open_finished(options.folder, console);
  require(finished.manifest.kind == "ensemble",
          fmt::format("{} holds a single run (there is nothing to merge).", options.folder));
  const DesignTable design = saved_design(finished.folder);
  {
    const MemberStore store(finished.folder.members());
    for (const std::string& problem : store.problems()) console.warn(problem);
    const std::string missing = what_is_missing(store, design.n_members());
    require(missing.empty() || options.partial,
            fmt::format("{}: {}. Run their shards, or make maps from the others with --partial.",
                        options.folder, missing));
    require(!store.members().empty(),
            fmt::format("{} has no finished member (maps need at least one).", options.folder));
    if (!missing.empty()) console.warn(missing + "; the maps are made from the others.");
  }
  console.log_to(finished.folder.log().string());
  const MapsMade made = make_maps(finished.folder, finished.manifest, finished.scenario, design,
                                  finished.elevation.get(), console);
  return verdict(made, finished.folder, finished.manifest,
                 finished.scenario.ensemble.max_failed_fraction, console);
}

}  // namespace sturz::app
