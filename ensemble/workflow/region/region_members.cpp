// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/region/region_members.hpp"

#include "engine/core/error.hpp"
#include "engine/core/hash.hpp"
#include "ensemble/workflow/folder/folder_members.hpp"
#include "ensemble/workflow/folder/manifest.hpp"
#include "ensemble/workflow/folder/saved_design.hpp"
#include "ensemble/workflow/folder/scene_identity.hpp"
#include "ensemble/workflow/region/region_folder.hpp"
#include "io/members/member_file.hpp"
#include "io/members/member_netcdf.hpp"
#include "io/members/packs/pack_file.hpp"
#include "io/scenario/scenario_file.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstring>
#include <mutex>
#include <utility>

namespace sturz::workflow {
namespace {

/// What maps need of it: its words and times are left in its file.
MemberSummary slim(const MemberSummary& member, std::int64_t number) {
  MemberSummary kept;
  kept.member = number;
  kept.outcome = member.outcome;
  kept.censoring = member.censoring;
  kept.state_hash = member.state_hash;
  kept.scalars = member.scalars;
  kept.window = member.window;
  return kept;
}

std::string without_numbers(const std::string& text) {
  std::string words;
  for (const char c : text)
    if (std::strchr("0123456789.", c) == nullptr) words += c;
  return words;
}

Window hull(const Window& a, const Window& b) {
  if (a.n_cells() == 0) return b;
  return b.n_cells() == 0 ? a : joined(a, b);
}

}  // namespace

StoredMembers::StoredMembers(const OutputFolder& region, const std::vector<std::string>& sources,
                             std::int64_t members_per_source, const std::string& design_hash,
                             Observer& observer, CancelFlag cancel) {
  Hash64 hash;
  for (const std::string& source : sources) {
    cancel.check();
    const std::size_t first = members_.size();
    add(region, source, members_per_source, design_hash, observer, cancel);
    hash.add(members_.size());
    for (std::size_t i = first; i < members_.size(); ++i)
      hash.add(row_of_[i]).add(members_[i].state_hash);
  }
  hash_ = fmt::format("{} of {} sources: {:016x}", members_.size(), sources.size(), hash.value());
}

void StoredMembers::add(const OutputFolder& region, const std::string& source, std::int64_t planned,
                        const std::string& design_hash, Observer& observer, CancelFlag cancel) {
  const OutputFolder folder = source_folder(region, source);
  SourceState state;
  state.counts.name = source;
  state.counts.planned = planned;
  folders_.push_back(folder.members());
  packed_.emplace_back();
  const auto number = static_cast<std::uint32_t>(sources_.size());
  if (auto failure = failure_of(region, source)) {
    state.failure = std::move(*failure);
    sources_.push_back(std::move(state));
    return;
  }
  if (!std::filesystem::exists(folder.manifest()) || !std::filesystem::exists(folder.scenario())) {
    missing_.push_back(fmt::format("source {}: nothing of it was computed", source));
    sources_.push_back(std::move(state));
    return;
  }
  const Manifest manifest = Manifest::read(folder.manifest());
  const Scenario scenario = read_scenario(folder.scenario());
  require_own_scenario(folder, manifest, scenario);
  const DesignTable design = saved_design(folder, manifest, scenario);
  require(
      manifest.design_hash == design_hash,
      fmt::format("{}: its design.csv is not that of the region (the sources' members would not "
                  "share their rows). Run the same `sturz ensemble` again.",
                  folder.root.string()));
  auto read = std::make_shared<const MemberStore>(members_of(folder, manifest, design, {}, cancel));
  const MemberStore& store = *read;
  if (!packs_in(folder.members()).empty()) packed_.back() = {read, members_.size()};
  warn_of_problems(store, "It counts as missing.", observer);
  if (const auto what = what_is_missing(store, planned); !what.empty())
    missing_.push_back(fmt::format("source {}: {}", source, what));
  for (const std::string& warning : manifest.warnings) {
    Warned& warned = warnings_[without_numbers(warning)];
    if (warned.sources++ == 0) warned.first = fmt::format("source {}: {}", source, warning);
  }
  for (const MemberSummary& m : store.members()) {
    const bool valid = is_valid(m.outcome);
    ++state.finished;
    state.compute_s += m.scalars.wall_s;
    if (valid) {
      if (state.counts.valid++ == 0) state.release_volume_m3 = m.scalars.release_volume_m3;
      state.cut_off += is_censored(m.censoring);
      state.counts.touched = hull(state.counts.touched, m.window);
      source_of_valid_.push_back(number);
      row_of_valid_.push_back(m.member);
      if (grid_.n_cells() == 0) grid_ = store.grid();
      require(grid_.same_place(store.grid()),
              fmt::format("{}: its maps lie on other cells than those of the sources before it.",
                          folder.root.string()));
    }
    members_.push_back(slim(m, static_cast<std::int64_t>(members_.size())));
    source_of_.push_back(number);
    row_of_.push_back(m.member);
  }
  sources_.push_back(std::move(state));
}

void StoredMembers::read_part(std::size_t index, PeakLayer layer, const Window& part,
                              std::span<float> out) const {
  expect(index < members_.size() && out.size() == part.n_cells(), "a part of a member");
  const MemberSummary& member = members_[index];
  if (part.n_cells() == 0) return;
  if (const Packed& of = packed_[source_of_[index]]; of.store)
    return of.store->read_part(index - of.first, layer, part, out);
  if (!is_kept(layer, member.censoring, member.scalars)) {
    std::fill(out.begin(), out.end(), info(layer).untouched);
    return;
  }
  const std::lock_guard lock(netcdf_mutex());
  if (!last_reader_ || last_index_ != index) {
    last_reader_.reset();
    last_reader_ = std::make_unique<NetcdfReader>(folders_[source_of_[index]] /
                                                  member_file_name(row_of_[index]));
    last_index_ = index;
  }
  read_member_part(*last_reader_, member.window, layer, part, out);
}

void StoredMembers::read_touched(std::size_t index, const Window& part,
                                 std::span<const PeakLayer> layers, TouchedCells& out) const {
  if (const Packed& of = packed_[source_of_.at(index)]; of.store)
    return of.store->read_touched(index - of.first, part, layers, out);
  MemberParts::read_touched(index, part, layers, out);
}

Raster<std::uint8_t> StoredMembers::release_cells(const Grid& map, const Window& part, int joined,
                                                  CancelFlag cancel) const {
  Raster<std::uint8_t> covered(map);
  std::vector<float> arrival;
  std::vector<bool> looked_at(sources_.size(), false);
  for (std::size_t i = 0; i < members_.size(); ++i) {
    cancel.check();
    if (!is_valid(members_[i].outcome) || looked_at[source_of_[i]]) continue;
    looked_at[source_of_[i]] = true;
    const Window own = overlap(members_[i].window, part);
    arrival.resize(own.n_cells());
    if (arrival.empty()) continue;
    read_part(i, PeakLayer::arrival, own, arrival);
    for (std::size_t c = 0; c < arrival.size(); ++c) {
      const auto n_cols = static_cast<std::size_t>(own.n_cols);
      if (arrival[c] == 0)
        covered.at((own.row0 - part.row0 + static_cast<int>(c / n_cols)) / joined,
                   (own.col0 - part.col0 + static_cast<int>(c % n_cols)) / joined) = 1;
    }
  }
  return covered;
}

std::vector<RegionSource> StoredMembers::region_sources() const {
  std::vector<RegionSource> all;
  all.reserve(sources_.size());
  for (const SourceState& state : sources_) all.push_back(state.counts);
  return all;
}

}  // namespace sturz::workflow
