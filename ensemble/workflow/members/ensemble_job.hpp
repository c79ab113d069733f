// SPDX-License-Identifier: Apache-2.0
/// What is known of an ensemble before its first member starts.
#pragma once

#include "ensemble/sampling/design.hpp"
#include "ensemble/workflow/folder/folder_lock.hpp"
#include "ensemble/workflow/folder/manifest.hpp"
#include "ensemble/workflow/folder/output_folder.hpp"
#include "ensemble/workflow/folder/shard.hpp"
#include "ensemble/workflow/observer.hpp"
#include "ensemble/workflow/scene.hpp"
#include "io/members/member_writer.hpp"
#include "scenarios/assets/assets.hpp"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sturz::workflow {

struct EnsembleRequest {
  SceneRequest scene;
  std::filesystem::path folder;  ///< of the results; a begun one of the same scene goes on
  int members = 0;               ///< 0: as the scenario says
  int workers = 0;               ///< members at a time; 0: all cores available to the process
  int max_cores = 0;             ///< members at a time times threads of each; 0: all available
  double max_memory_bytes = 0;   ///< of the whole process; 0: what is free
  Shard shard;
  int planned_shards = 0;     ///< into which others will divide the members; 0: not known here
  bool retry_failed = false;  ///< compute failed members again
  bool packs = false;  ///< members in packs however few there are; a begun folder stays as is
  /// Stop as soon as the largest half width of P(reached) is no more than this, see
  /// run_until_converged(); `members` is the most then. Not for shards.
  std::optional<double> until_half_width;
  std::string until_asset;  ///< name of the asset whose P(hit) is meant instead; empty: the map
  /// Folder of a calibration that the scene's table is from: the job warns where what was found
  /// there does not fit this scene. Empty: none.
  std::filesystem::path posterior;
  std::string command;  ///< how the user asked for it, for the manifest
};

/// An ensemble that grows look by look: its design is at every time a first part of `whole`.
struct Growth {
  double wanted_half_width = 0;
  DesignTable whole;                ///< of all members that may be computed
  std::vector<std::int64_t> looks;  ///< as look_counts() gives them
  std::optional<Asset> asset;       ///< that is looked at; nothing: the map
};

struct EnsembleJob {
  std::shared_ptr<FolderLock> lock;  ///< the folder is ours while a copy of the job lives
  Scene scene;
  OutputFolder folder;
  Manifest manifest;
  DesignTable design;
  std::optional<Growth> growth;          ///< under a stop rule
  std::shared_ptr<MemberWriter> writer;  ///< keeps members in the folder
  std::vector<std::int64_t> to_do;
  std::int64_t finished_before = 0;  ///< of this call's share
  bool retry_failed = false;         ///< failed members are to do
  int wanted_workers = 0;            ///< 0: all cores available to the process
  int max_cores = 0;                 ///< 0: all available
  double max_memory_bytes = 0;       ///< 0: what is free
  int workers = 1;                   ///< members at a time
  int threads = 1;                   ///< of each member
  std::chrono::steady_clock::time_point begin = std::chrono::steady_clock::now();
};

/// The scene with the wanted number of members as its last override.
SceneRequest scene_of(const EnsembleRequest&);

/// Reads and checks the scene, then begins the results folder or finds out what is left to do in
/// it. Nothing is written before everything that the user could have wrong has been looked at.
/// Warns of damaged members, which count as absent, and of fewer workers than wanted.
/// \throws SetupError; IoError when the folder cannot be written
EnsembleJob prepare_ensemble(const EnsembleRequest&, Observer&);

/// The same of a scene that was loaded already, as request.scene says.
EnsembleJob prepare_ensemble(const EnsembleRequest&, Scene, Observer&);

/// What a manifest keeps of the folder's past: when it was begun, its time, maps and programs.
/// Warns when another program began it. Part of prepare_ensemble.
void take_past(Manifest& now, const Manifest& before, const OutputFolder&, Observer&);

/// Workers, and threads of each, for what is to do: their product never exceeds the cores, nor
/// workers times memory the machine. Part of prepare_ensemble.
void share_machine(EnsembleJob&, Observer&);

/// Takes more rows of job.growth->whole into the design, in memory and in the folder; to do is then
/// what is not finished of them. \throws SetupError when design.csv was changed meanwhile;
/// IoError
void grow_design(EnsembleJob&, std::int64_t n_members, Observer&);

/// From now on the manifest knows whatever part of the ground members read before one of them is
/// stored: also for shards, and when the run is stopped. Part of prepare_ensemble.
void keep_what_is_read(EnsembleJob&);

}  // namespace sturz::workflow
