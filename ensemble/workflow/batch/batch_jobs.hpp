// SPDX-License-Identifier: Apache-2.0
/// The jobs of a batch list: each entry, each feature of its release, with the scenario that it is.
#pragma once

#include "ensemble/workflow/machine/machine_speed.hpp"
#include "ensemble/workflow/scene.hpp"
#include "io/batch/batch_file.hpp"
#include "scenarios/scenario.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace sturz::workflow {

struct BatchJob {
  std::string name;
  SceneRequest scene;
  bool single_run = false;
  std::filesystem::path base;   ///< of its results: their hash comes after it
  std::vector<BatchValue> set;  ///< as scene.overrides, with their places in the list
  Scenario scenario;            ///< with overrides and defaults
  bool wanted = true;           ///< named by `only`, or that is empty
  std::string failure;          ///< why it cannot even be told what it is; mostly empty
};

struct BatchJobs {
  BatchSpec spec;
  std::filesystem::path root;       ///< of all results
  std::filesystem::path stop_file;  ///< empty: none
  std::vector<BatchJob> list;       ///< in the order of the list
};

/// Reads the list and every scenario that it names; nothing is loaded or computed yet.
/// \param only names of jobs; empty: all. That of an entry stands for all its features.
/// \param results in the place of what the list says; empty: that
/// \throws SetupError with everything that is wrong with the list and the scenarios, one a line,
///   each with file, line and key; IoError when the list cannot be read
BatchJobs read_batch_jobs(const std::filesystem::path& list, const SpeedCache&,
                          const std::vector<std::string>& only,
                          const std::filesystem::path& results = {});

/// Problems of a scene whose place is an override ("--set key: ...") at their place in the list.
std::string at_places_in_list(const std::string& lines, const BatchJob&);

}  // namespace sturz::workflow
