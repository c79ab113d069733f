// SPDX-License-Identifier: Apache-2.0
/// manifest.json: how the results of a folder came to be.
#pragma once

#include "ensemble/stopping/stop_rule.hpp"
#include "scenarios/input_identity.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sturz::workflow {

/// A program that computed members of a folder.
struct Build {
  std::string version, git_commit;
  bool operator==(const Build&) const = default;
};
/// "sturz 1.2.0 (0123456789ab)"
std::string build_text(const Build&);
Build this_build();

/// What a results folder says about how it came to be: manifest.json.
struct Manifest {
  std::string kind;     ///< "ensemble", "region" or "run"
  std::string started;  ///< UTC, ISO 8601
  std::string command;
  std::string design;
  std::uint64_t seed = 0;
  std::int64_t members = 0;  ///< planned
  int shards = 0;            ///< into which the members were divided last; 0: they never were
  std::vector<InputIdentity> inputs;                      ///< what was read of each file
  std::vector<std::string> description, notes, warnings;  ///< as `describe` says them
  double spacing_m = 0;
  double compute_s = 0;     ///< wall time of all calls so far
  std::string hazard_hash;  ///< of every value of the maps; empty: none yet, or being made
  std::string maps_of;      ///< hash of the members that the maps were made from, as members_hash()
  std::string scenario_hash;       ///< as scenario_hash()
  std::string scene_hash;          ///< as scene_hash(): what the members are computed from
  std::string design_hash_before;  ///< of the table that this one replaces; empty: none
  std::string design_hash;         ///< as design_hash(); empty for a single run
  std::vector<Build> builds;       ///< all that computed members here, the first first
  std::optional<StopRecord> stop;  ///< what decided the number of members; nothing: the user did
  std::string weighting;  ///< of weighted maps, in words; for their page, not kept in the file
  std::string censored;   ///< which of the maps' members are cut off; empty: no maps yet
  // Of the program that wrote it; filled in by write().
  std::string version, git_commit, compiler, build_type;

  void write(const std::filesystem::path& file);
  /// \throws SetupError when the file is damaged
  static Manifest read(const std::filesystem::path& file);
  /// Name and value of every line that people want to see, in order.
  std::vector<std::pair<std::string, std::string>> lines() const;
};

/// "2026-01-31T12:00:00Z"
std::string utc_now();

}  // namespace sturz::workflow
