// SPDX-License-Identifier: Apache-2.0
/// The members of all sources of a region on one pool of workers.
#pragma once

#include "ensemble/workflow/observer.hpp"
#include "ensemble/workflow/region/region_job.hpp"

#include <atomic>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace sturz::workflow {

struct RegionRun {
  std::int64_t finished = 0, total = 0;   ///< members, those of earlier calls included
  std::int64_t computed = 0, failed = 0;  ///< members of this call
  /// Name and reason of each source of this call's share that could not be computed.
  std::vector<std::pair<std::string, std::string>> failed_sources;
  bool interrupted = false;  ///< cancelled before all were finished
  std::string stop_error;    ///< why the run stopped by itself; empty: it did not
};

/// Opens a source when its first member is due and lets it go behind its last, so that no more
/// sources are in memory than twice the workers. A worker that finds no member left of one source
/// goes on with the next: none waits for a source's end. Shard K of N takes the sources K - 1,
/// K - 1 + N, ... whole.
/// A source that makes no scene is recorded with its reason, and the others go on. What is wrong
/// with a results folder, say other inputs than it was begun with, stops the run.
RegionRun run_region(RegionJob&, Observer&, const std::atomic<bool>& cancel);

}  // namespace sturz::workflow
