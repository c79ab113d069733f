// SPDX-License-Identifier: Apache-2.0
/// A scene as the commands meet it: scenario, its files, and what it will be.
#pragma once

#include "ensemble/app/console.hpp"
#include "ensemble/app/output_folder.hpp"
#include "scenarios/assembly/assemble.hpp"
#include "scenarios/scene_inputs.hpp"

#include <string>
#include <vector>

namespace sturz::app {

struct Scene {
  Scenario scenario;  ///< with overrides and defaults, distributions in place
  Scenario medians;   ///< the same with each distribution's median
  SceneInputs inputs;
  SceneDescription description;  ///< of the medians
};

/// Reads, overrides, validates, loads and describes. Everything that can be wrong with the user's
/// data is found here, before a folder is made or a step computed.
/// \throws SetupError
Scene load_scene(const std::string& file, const std::vector<std::string>& overrides,
                 bool measure_machine_again = false);

/// The description in sentences, as `describe` prints it and reports keep it.
std::vector<std::string> description_lines(const Scene&);

/// A manifest filled with what the scene says about itself.
Manifest manifest_of(const Scene&, const std::string& kind, const std::string& command);

/// Writes scenario.yaml into the folder. \throws IoError
void save_scenario(const OutputFolder&, const Scenario&);

}  // namespace sturz::app
