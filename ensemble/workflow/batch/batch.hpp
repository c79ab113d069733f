// SPDX-License-Identifier: Apache-2.0
/// A list of scenarios, computed one after another as far as they changed.
///
///   results/
///     lock.json        one batch at a time
///     batch.json       what is remembered (batch_state.hpp)
///     NAME-<hash8>/    results of a job: hash of scene, inputs, design and program
///     NAME             link to those of today
///     summary.csv, summary.html, outlines.gpkg
#pragma once

#include "ensemble/workflow/batch/batch_figures.hpp"
#include "ensemble/workflow/batch/guard.hpp"
#include "ensemble/workflow/batch/plan.hpp"
#include "ensemble/workflow/observer.hpp"

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace sturz::workflow {

struct BatchRequest {
  std::filesystem::path list;
  SpeedCache speed_cache;
  std::string command;            ///< how the user asked for it
  std::vector<std::string> only;  ///< names of entries; empty: all
  bool dry_run = false;           ///< nothing is computed or written; forecasts are made
  bool check_all = false;         ///< as PlanOptions
  bool retry_failed = false;
  // In the place of what the list says.
  std::optional<std::filesystem::path> results;
  std::optional<int> max_workers, keep;
  std::optional<DayWindow> between;
  bool wait = false;
};

enum class RowState {
  unchanged,
  computed,
  failed,
  interrupted,  ///< it has begun and goes on with the next call
  waiting,      ///< not begun
  skipped,      ///< not named by `only`
};
const char* to_string(RowState);

/// A job at the end of a batch.
struct BatchRow {
  std::string name, title;
  bool single_run = false;
  RowState state = RowState::waiting;
  std::string why, message;
  std::filesystem::path folder;
  std::optional<BatchFigures> figures;
  double utilisation = nan_d;  ///< of the last call that computed members
  std::optional<Forecast> forecast;
  std::int64_t members = 0, finished = 0;  ///< planned; there before this call
};

struct BatchDone {
  std::filesystem::path root, csv, page, outlines;
  BatchSpec spec;
  std::vector<BatchRow> rows;     ///< in the order of the list
  StopReason stop;                ///< why it ended before its end
  double core_s = 0, wall_s = 0;  ///< of this call, waiting not counted
  int cores = 1;
  std::string low_utilisation;  ///< the likely cause, where it was under one half
  std::vector<std::filesystem::path> removed;

  std::size_t count(RowState) const;
  double utilisation() const { return wall_s > 0 ? core_s / (wall_s * cores) : nan_d; }
};

/// What a batch tells besides what its jobs tell.
class BatchObserver : public Observer {
 public:
  /// The list is read and all of it understood; nothing has begun.
  virtual void list_read(const BatchSpec&) {}
  virtual void job_planned(const PlannedJob&, std::size_t /*i*/, std::size_t /*n*/) {}
  virtual void job_begins(const PlannedJob&, std::size_t /*i*/, std::size_t /*n*/) {}
  virtual void job_ended(const BatchRow&) {}
  /// It waits for its time window. \param minutes until that opens
  virtual void waits(int /*minutes*/) {}
};

/// \param interrupt may be set at any time, from a signal handler too
/// \throws SetupError for the list and its scenarios, and when another process works in the folder;
///   IoError when that cannot be written; Cancelled while it looks at the jobs
BatchDone run_batch(const BatchRequest&, BatchObserver&, const std::atomic<bool>& interrupt);

}  // namespace sturz::workflow
