// SPDX-License-Identifier: Apache-2.0
/// A results folder as a later command finds it.
#pragma once

#include "ensemble/workflow/folder/manifest.hpp"
#include "ensemble/workflow/folder/output_folder.hpp"
#include "ensemble/workflow/observer.hpp"
#include "scenarios/scenario.hpp"
#include "scenarios/scene_inputs.hpp"

#include <memory>

namespace sturz::workflow {

struct FinishedFolder {
  OutputFolder folder;
  Manifest manifest;
  Scenario scenario;
  std::shared_ptr<const SceneInputs> inputs;  ///< null when the input files are gone
};

/// Reads a folder back. Warns, and goes on without relief, when the terrain cannot be read any
/// more. \throws SetupError when the folder holds no results
FinishedFolder open_finished(const std::filesystem::path& folder, Observer&);

}  // namespace sturz::workflow
