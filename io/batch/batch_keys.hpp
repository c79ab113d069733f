// SPDX-License-Identifier: Apache-2.0
/// The keys of a batch list: the one table that its reader and its JSON Schema share.
#pragma once

#include <array>
#include <string_view>

namespace sturz {

enum class BatchKind {
  text,
  integer,
  number,
  flag,      ///< true | false
  mode,      ///< ensemble | run
  window,    ///< "HH:MM-HH:MM"
  features,  ///< each, or a list of names or numbers
  values,    ///< {key of a scenario: value, ...}
  job,       ///< what a job may say
  jobs,      ///< a list of those
};

struct BatchKey {
  const char* name;
  BatchKind kind;
  const char* help;  ///< one sentence
  double min = 0, max = 0;
};

inline constexpr int most_jobs = 10000;

/// At the top.
inline constexpr std::array batch_keys{
    BatchKey{"jobs", BatchKind::jobs, "What is computed, in this order."},
    BatchKey{"defaults", BatchKind::job, "What every job says that does not say it itself."},
    BatchKey{"results", BatchKind::text,
             "Folder of all results, from the list's folder; without it out/NAME beside the list."},
    BatchKey{"max_workers", BatchKind::integer,
             "Cores that the batch may use: members at a time, times the threads of each.", 1,
             4096},
    BatchKey{"between", BatchKind::window,
             "Time of day in which it computes, such as \"20:00-06:00\"; over midnight is fine."},
    BatchKey{"wait", BatchKind::flag,
             "Outside of that time: wait for it (true), or end with exit code 3 (false)."},
    BatchKey{"stop_file", BatchKind::text,
             "As soon as this file is there the batch ends; what is finished is kept."},
    BatchKey{"nice", BatchKind::integer, "How far other programs go first.", 0, 19},
    BatchKey{"min_free_disk_gb", BatchKind::number,
             "Ends before the results' disk has less free than this; 0: no limit.", 0, 1e9},
    BatchKey{"max_memory_gb", BatchKind::number,
             "Fewer members at a time where they would need more; a job that does fails.", 0.05,
             1e6},
    BatchKey{"keep", BatchKind::integer,
             "So many results of each job stay, the newest ones; without it all of them.", 1, 1e6},
};

/// Of a job; `defaults` knows all but name and folder.
inline constexpr std::array job_keys{
    BatchKey{"name", BatchKind::text,
             "Of the job and its results: letters, digits, '.', '_' and '-'."},
    BatchKey{"scenario", BatchKind::text, "Scenario file, from the list's folder."},
    BatchKey{"set", BatchKind::values,
             "Values in the place of those of the scenario: {basal.friction_coefficient: 0.3}."},
    BatchKey{"mode", BatchKind::mode, "ensemble, or run: the medians alone."},
    BatchKey{"members", BatchKind::integer, "Number of members, instead of the scenario's.", 1,
             100000000},
    BatchKey{"features", BatchKind::features,
             "A job of its own for each feature of the release's polygon layer, or for those "
             "named."},
    BatchKey{"folder", BatchKind::text,
             "Of its results, from the list's folder, instead of results/NAME."},
};

inline constexpr bool is_for_defaults(const BatchKey& key) {
  const std::string_view name = key.name;
  return name != "name" && name != "folder";
}

}  // namespace sturz
