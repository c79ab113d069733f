// SPDX-License-Identifier: Apache-2.0
/// batch.json: what a batch folder remembers from one call to the next.
#pragma once

#include "ensemble/workflow/batch/batch_figures.hpp"
#include "io/files/file_stamp.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace sturz::workflow {

/// How a job ended the last time.
enum class JobEnd {
  none,
  running,      ///< the program ended inside it, by itself or by a kill
  interrupted,  ///< it may go on
  failed,       ///< its data, its scenario or the disk
  done,
  too_many_failed,  ///< done, and more members failed than the scenario accepts
};

struct JobRecord {
  JobEnd end = JobEnd::none;
  std::string fingerprint;        ///< of the scenario as it was asked for
  std::string build;              ///< as build_text()
  std::vector<FileStamp> stamps;  ///< of its files; empty: they cannot be told by stamps
  bool has_stamps = false;
  std::int64_t looked_ns = 0;  ///< when
  std::string folder;          ///< of its results
  std::string message;         ///< why it failed
  double utilisation = nan_d;  ///< of the last call that computed members
  std::optional<BatchFigures> figures;

  bool is_finished() const { return end == JobEnd::done || end == JobEnd::too_many_failed; }
};

struct BatchState {
  std::map<std::string, JobRecord> jobs;
  std::string outlines_of;  ///< what outlines.gpkg was made from

  /// \throws IoError
  void write(const std::filesystem::path& file) const;
  /// Empty when there is no such file, or it is damaged: then all is looked at anew.
  static BatchState read(const std::filesystem::path& file);
};

}  // namespace sturz::workflow
