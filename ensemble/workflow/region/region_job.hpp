// SPDX-License-Identifier: Apache-2.0
/// A region before its first member starts: one ensemble for each feature of the release's layer.
#pragma once

#include "ensemble/sampling/design.hpp"
#include "ensemble/workflow/folder/folder_lock.hpp"
#include "ensemble/workflow/folder/manifest.hpp"
#include "ensemble/workflow/forecast/forecast.hpp"
#include "ensemble/workflow/members/ensemble_job.hpp"
#include "ensemble/workflow/region/region_folder.hpp"

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace sturz::workflow {

struct RegionJob {
  std::shared_ptr<FolderLock> lock;  ///< the folder is ours while a copy of the job lives
  OutputFolder folder;
  Manifest manifest;
  Scenario scenario;                 ///< with release.each_feature
  std::vector<std::string> sources;  ///< names of the features, in file order
  DesignTable design;                ///< that all sources share
  EnsembleRequest request;
  Scene typical;           ///< of the first source that makes a scene
  std::string typical_of;  ///< its name
  int workers = 1;         ///< members at a time, of whatever source
  int threads = 1;         ///< of each member
  std::chrono::steady_clock::time_point begin = std::chrono::steady_clock::now();

  std::int64_t members_per_source() const { return design.n_members(); }
};

/// Reads the scenario and the names of the features, and begins the folder or goes on in it. What
/// is wrong with all sources alike is found here, before a folder is made; what is wrong with one
/// is told when it is opened.
/// \throws SetupError; when no feature makes a scene, the first one's reason; IoError
RegionJob prepare_region(const EnsembleRequest&, Observer&);

/// A region whose members were computed before, for its maps: nothing of it is begun anew.
/// \throws SetupError when it is none, when its scenario was changed, when a source's inputs are
///   not what its members were computed from; Cancelled
RegionJob reopen_region(const std::filesystem::path& folder, Observer&, CancelFlag cancel = {});

/// What a region will be, and take: some of its sources looked at.
struct RegionDescription {
  std::size_t n_sources = 0;
  std::int64_t members_per_source = 0;
  Scene typical;
  std::string typical_of;
  std::vector<std::string> looked_at, failed;  ///< names; "name: reason"
  int workers = 1;
  Range member_s, members_s, elapsed_s;  ///< of one on average, of all together, by the clock
};
RegionDescription describe_region(const SceneRequest&, double trial_s, CancelFlag cancel = {});

}  // namespace sturz::workflow
