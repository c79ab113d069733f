// SPDX-License-Identifier: Apache-2.0
/// One member with the median of every distribution, and its folder of results.
#pragma once

#include "engine/simulation/member_result.hpp"
#include "ensemble/censoring/censoring_report.hpp"
#include "ensemble/scores/score_table.hpp"
#include "ensemble/workflow/folder/folder_lock.hpp"
#include "ensemble/workflow/folder/manifest.hpp"
#include "ensemble/workflow/folder/output_folder.hpp"
#include "ensemble/workflow/observer.hpp"
#include "ensemble/workflow/scene.hpp"

#include <atomic>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sturz::workflow {

struct RunRequest {
  SceneRequest scene;
  std::filesystem::path folder;  ///< of the results; an earlier run of the same scene is replaced
  int threads = 0;               ///< 0: all cores available to the process
  std::optional<double> particles_every_s;  ///< frames for ParaView, simulated seconds apart
  std::string command;                      ///< how the user asked for it, for the manifest
  bool replace = false;                     ///< a run of another scene is replaced too
};

/// A run that has its folder and waits for its first step.
struct SingleRun {
  std::shared_ptr<FolderLock> lock;  ///< the folder is ours while a copy of the run lives
  Scene scene;
  OutputFolder folder;
  Manifest manifest;
  int threads = 1;
  std::optional<double> particles_every_s;
  std::chrono::steady_clock::time_point begin = std::chrono::steady_clock::now();
};

/// Reads and checks the scene and begins the folder.
/// \throws SetupError, also when the folder holds the run of another scene; IoError when the folder
///   cannot be written
SingleRun prepare_run(const RunRequest&, Observer&);

/// Computes it; writes particle frames on the way where they are wanted, and nothing else.
/// \param cancel may be set at any time and is looked at every 0.2 s; the outcome is then
///   `cancelled`
MemberResult compute_run(const SingleRun&, Observer&, const std::atomic<bool>& cancel);

/// What is to be said of a run besides its numbers.
struct RunStored {
  CensoringReport censoring;
  std::vector<MemberWarning> warnings;  ///< its own, those that `describe` did not give
  std::optional<ScoreTable> scores{};   ///< one row, where something was observed
};

/// Writes member, maps, manifest and page. \throws IoError
RunStored store_run(SingleRun&, const MemberResult&);

}  // namespace sturz::workflow
