// SPDX-License-Identifier: Apache-2.0
/// Batch lists: which scenarios are computed, with which changes, within which limits.
#pragma once

#include "io/scenario/yaml_tree.hpp"
#include "scenarios/batch/day_window.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sturz {

/// One value of `set`: replaces a value of the scenario, as --set does.
struct BatchValue {
  std::string key;    ///< "basal.friction_coefficient"
  std::string value;  ///< YAML on one line
  Position at;
};

/// An entry of `jobs`, with what `defaults` says where it says nothing itself.
struct BatchEntry {
  std::string path;         ///< "jobs[2]", for messages
  std::string name;         ///< letters, digits, '.', '_', '-'
  std::string scenario;     ///< file, as written; relative to the list
  std::string folder;       ///< of the results without their hash, as written; empty: results/NAME
  bool single_run = false;  ///< `mode: run`: the median of every distribution alone
  int members = 0;          ///< 0: as the scenario says
  std::vector<BatchValue> set;
  bool each_feature = false;          ///< a job for each feature of the release's polygon layer
  std::vector<std::string> features;  ///< a job for each of these; empty: the scenario as it is
  Position at, scenario_at, features_at, folder_at;
};

struct BatchSpec {
  std::string source;   ///< name of the file in messages
  std::string results;  ///< folder, as written; relative to the list; empty: out/<name of the list>
  std::vector<BatchEntry> jobs;
  int max_workers = 0;               ///< cores that may be used; 0: all available to the process
  std::optional<DayWindow> between;  ///< nothing: at any time
  bool wait = false;                 ///< for the window to open; else the batch ends outside it
  std::string stop_file;             ///< as written; empty: none
  int nice = 0;                      ///< 0: as started
  double min_free_disk_gb = 1;       ///< 0: no limit
  double max_memory_gb = 0;          ///< 0: no limit
  int keep = 0;                      ///< results of a job that stay; 0: all
};

/// \param name of the file in messages
/// \throws SetupError with all problems, one a line, each `file:line:column: key ...`: unknown and
///   missing keys, wrong types and ranges, two jobs of one name
BatchSpec parse_batch(std::string_view text, const std::string& name);

/// The same for who has more to complain of: problems are added, and entries that can be used come.
BatchSpec parse_batch(std::string_view text, const std::string& name,
                      std::vector<std::string>& problems);

/// \throws IoError when the file cannot be read
BatchSpec read_batch(const std::filesystem::path& file, std::vector<std::string>& problems);

}  // namespace sturz
