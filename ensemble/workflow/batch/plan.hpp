// SPDX-License-Identifier: Apache-2.0
/// What of a batch is to be computed, and why.
#pragma once

#include "ensemble/workflow/batch/batch_jobs.hpp"
#include "ensemble/workflow/batch/batch_state.hpp"
#include "ensemble/workflow/forecast/forecast.hpp"
#include "ensemble/workflow/observer.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace sturz::workflow {

struct PlanOptions {
  bool check_all = false;     ///< every input and every member is read, whatever the stamps say
  bool retry_failed = false;  ///< members that failed are to do
  bool forecast = false;      ///< what each job will take
  int max_workers = 0;        ///< cores; 0: all available
  double max_memory_bytes = 0;
};

struct PlannedJob {
  BatchJob job;
  JobRecord record;  ///< as it will be remembered: fingerprint, stamps, folder, figures if finished
  bool to_do = false;
  std::string why;       ///< it is to do, in words: "dem.tif changed (terrain.raster)"
  std::string failure;   ///< why it cannot be computed; mostly empty
  bool crashed = false;  ///< the program ended inside it the last time: it comes last
  std::filesystem::path folder;
  std::int64_t members = 0, finished = 0;  ///< planned; there before this call
  std::optional<Forecast> forecast;
};

/// Looks what is there of a job. Nothing is written.
///
///   same fingerprint, program and stamps, results there  -> nothing to do, nothing is read
///   else  the scene is loaded; the folders base-* that hold this kind of results are asked whether
///         their members are of this scene and these inputs, by this program and of rows that the
///         design begins with. That folder goes on; without one a new name is given
/// \throws Cancelled; what is wrong with the scene is in `failure`
PlannedJob plan_job(const BatchJob&, const BatchState&, const PlanOptions&, Observer&,
                    CancelFlag cancel);

/// Folders of results that the job has or had: BASE-<8 hexadecimal digits>[-n] with a manifest,
/// newest first.
std::vector<std::filesystem::path> results_of(const std::filesystem::path& base);

/// Finished members of a folder, counted by their files.
std::int64_t count_members(const std::filesystem::path& folder);

}  // namespace sturz::workflow
