// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/folder/folder_members.hpp"

#include "engine/core/hash.hpp"
#include "ensemble/workflow/folder/scene_identity.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <set>

namespace sturz::workflow {

MemberOrigin origin_of(const Manifest& manifest, const DesignTable& design, std::int64_t member) {
  const Build build = this_build();
  return {member_hash(manifest.scene_hash, design, member), build.version, build.git_commit};
}

MemberStore members_of(const OutputFolder& folder, const Manifest& manifest,
                       const DesignTable& design, std::function<bool(std::int64_t)> wanted,
                       CancelFlag cancel, PackName shard) {
  MemberFilter filter;
  filter.shard = shard;
  filter.wanted = std::move(wanted);
  filter.refusal = [&](const MemberSummary& member, const MemberOrigin& origin) -> std::string {
    if (member.member >= design.n_members())
      return fmt::format("has no row in design.csv (that has members 0 .. {})",
                         design.n_members() - 1);
    if (origin.scene_hash != member_hash(manifest.scene_hash, design, member.member))
      return "was computed from another scene or other drawn values (members of two scenes make no "
             "map)";
    const Build build{origin.engine_version, origin.engine_commit};
    if (std::find(manifest.builds.begin(), manifest.builds.end(), build) == manifest.builds.end())
      return fmt::format("was computed by {}, of which manifest.json knows nothing",
                         build_text(build));
    return "";
  };
  return MemberStore(folder.members(), filter, cancel);
}

void warn_of_problems(const MemberStore& store, const std::string& consequence,
                      Observer& observer) {
  constexpr std::size_t named = 10;
  const auto& all = store.problems();
  for (std::size_t i = 0; i < std::min(named, all.size()); ++i)
    observer.warning(all[i] + " " + consequence);
  if (all.size() > named)
    observer.warning(
        fmt::format("... and {} more members like these. {}", all.size() - named, consequence));
}

void warn_of_builds(const Manifest& manifest, Observer& observer) {
  if (manifest.builds.size() < 2) return;
  std::string all;
  for (const Build& build : manifest.builds) all += (all.empty() ? "" : ", ") + build_text(build);
  observer.warning(
      fmt::format("members of this folder were computed by {} programs ({}); their "
                  "results may differ.",
                  manifest.builds.size(), all));
}

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

std::string members_hash(const MemberStore& store, std::int64_t planned) {
  Hash64 hash;
  for (const MemberSummary& m : store.members()) hash.add(m.member).add(m.state_hash);
  return fmt::format("{} of {}: {:016x}", store.members().size(), planned, hash.value());
}

}  // namespace sturz::workflow
