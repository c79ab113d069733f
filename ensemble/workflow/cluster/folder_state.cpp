// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/cluster/folder_state.hpp"

#include "engine/core/error.hpp"
#include "engine/terrain/raster.hpp"
#include "ensemble/workflow/cluster/recent_members.hpp"
#include "ensemble/workflow/folder/folder_members.hpp"
#include "ensemble/workflow/folder/saved_design.hpp"
#include "io/scenario/scenario_file.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <optional>
#include <regex>
#include <system_error>
#include <thread>
#include <utility>

namespace sturz::workflow {
namespace fs = std::filesystem;
namespace {

/// Which shard a lock is of; nothing: another file.
std::optional<Shard> shard_of_lock(const std::string& name) {
  if (name == "lock.json") return Shard{1, 1};
  static const std::regex form(R"(lock_(\d{1,7})_of_(\d{1,7})\.json)");
  std::smatch parts;
  if (!std::regex_match(name, parts, form)) return std::nullopt;
  const Shard shard{std::stoi(parts[1]), std::stoi(parts[2])};
  if (shard.k < 1 || shard.k > shard.n) return std::nullopt;
  return shard;
}

Worker judged(const Shard& shard, const fs::path& file, LockHolder holder) {
  Worker worker{shard, std::move(holder), 0, false};
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  if (const auto touched = last_touch(file))
    worker.silent_s = std::max(0.0, std::chrono::duration<double>(now - *touched).count());
  const Liveness known = liveness_of(worker.holder.process);
  worker.gone =
      known == Liveness::gone || (known == Liveness::unknown && worker.holder.beat_s > 0 &&
                                  worker.silent_s > worker.holder.silence_s());
  return worker;
}

std::vector<Worker> workers_in(const OutputFolder& folder) {
  std::map<std::pair<int, int>, Worker> sorted;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder.root, ignored)) {
    const auto shard = shard_of_lock(entry.path().filename().string());
    if (!shard) continue;
    auto holder = holder_in(entry.path());
    if (!holder || (shard->n == 1 && holder->brief)) continue;  // over, or only looks around
    sorted.emplace(std::pair{shard->n, shard->k}, judged(*shard, entry.path(), std::move(*holder)));
  }
  std::vector<Worker> all;
  for (auto& [place, worker] : sorted) all.push_back(std::move(worker));
  return all;
}

/// A folder that grows just now has for a moment a design that its manifest does not know.
DesignTable design_of(FolderState& state, CancelFlag cancel) {
  constexpr int tries = 5;
  for (int i = 0;; ++i) {
    state.manifest = Manifest::read(state.folder.manifest());
    try {
      return saved_design(state.folder, state.manifest, read_scenario(state.folder.scenario()));
    } catch (const SetupError&) {
      if (i + 1 == tries) throw;
    }
    cancel.check();
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  }
}

MapsState maps_state(const FolderState& state) {
  std::error_code ignored;
  if (state.manifest.hazard_hash.empty() || !fs::exists(state.folder.hazard_nc(), ignored))
    return MapsState::none;
  if (state.manifest.maps_of != members_hash(*state.store, state.planned)) return MapsState::older;
  return state.missing() > 0 ? MapsState::partial : MapsState::complete;
}

void add_pace(FolderState& state) {
  constexpr std::size_t least = 20, rounds = 3;
  const auto n = std::max(least, rounds * static_cast<std::size_t>(state.at_a_time()));
  const std::vector<std::size_t> recent = written_last(*state.store, n);
  double sum = 0;
  for (const std::size_t i : recent) sum += state.members()[i].scalars.wall_s;
  state.recent_members = static_cast<std::int64_t>(recent.size());
  state.recent_member_s = recent.empty() ? 0 : sum / static_cast<double>(recent.size());
}

}  // namespace

const char* to_string(MapsState state) {
  switch (state) {
    case MapsState::none:
      return "none";
    case MapsState::older:
      return "older";
    case MapsState::partial:
      return "partial";
    case MapsState::complete:
      return "complete";
  }
  return "";
}

int FolderState::at_a_time() const {
  int n = 0;
  for (const Worker& w : workers)
    if (!w.gone) n += std::max(1, w.holder.workers);
  return n;
}

double FolderState::remaining_s() const {
  if (missing() == 0) return 0;
  const double each = member_s();
  if (at_a_time() == 0 || !(each > 0)) return nan_d;
  double longest = static_cast<double>(missing()) * each / at_a_time();
  for (const Worker& w : workers) {
    if (w.gone || w.shard.n != static_cast<int>(shards.size())) continue;
    const auto left =
        static_cast<double>(shards[static_cast<std::size_t>(w.shard.k - 1)].missing());
    longest = std::max(longest, left * each / std::max(1, w.holder.workers));
  }
  return longest;
}

FolderState folder_state(const OutputFolder& folder, int shards, CancelFlag cancel) {
  FolderState state;
  state.folder = folder;
  require(fs::exists(folder.manifest()) && fs::exists(folder.scenario()),
          fmt::format("{} holds no results of sturz (manifest.json or scenario.yaml is missing). "
                      "Name the folder that `sturz ensemble` or `sturz submit` began.",
                      folder.root.string()));
  const DesignTable design = [&] {
    require(
        Manifest::read(folder.manifest()).kind == "ensemble",
        fmt::format("{} holds a single run (it has no members to count).", folder.root.string()));
    return design_of(state, cancel);
  }();
  state.planned = design.n_members();
  state.workers = workers_in(folder);
  state.store =
      std::make_shared<const MemberStore>(members_of(folder, state.manifest, design, {}, cancel));
  state.shards = shard_states(state.members(), state.planned,
                              shards > 0 ? shards : std::max(1, state.manifest.shards));
  state.maps = maps_state(state);
  add_pace(state);
  return state;
}

}  // namespace sturz::workflow
