// SPDX-License-Identifier: Apache-2.0
/// A results folder as a later command finds it.
#pragma once

#include "ensemble/workflow/folder/manifest.hpp"
#include "ensemble/workflow/folder/output_folder.hpp"
#include "ensemble/workflow/observer.hpp"
#include "scenarios/scenario.hpp"
#include "scenarios/scene_inputs.hpp"

#include <memory>
#include <string>
#include <vector>

namespace sturz::workflow {

struct FinishedFolder {
  OutputFolder folder;
  Manifest manifest;
  Scenario scenario;
  std::shared_ptr<const SceneInputs> inputs;  ///< null when the input files cannot be read
  std::string unreadable;                     ///< why not
  std::vector<std::string> changed;  ///< how they differ from what the members were computed from
};

/// Reads a folder back, and compares today's input files with what its members read of them. That
/// they differ is left to the caller; warns when they cannot be read (any more). \throws SetupError
/// when the folder holds no results
FinishedFolder open_finished(const std::filesystem::path& folder, Observer&);

}  // namespace sturz::workflow
