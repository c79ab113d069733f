// SPDX-License-Identifier: Apache-2.0
/// A scene as every door meets it: scenario, its files, and what it will be.
#pragma once

#include "ensemble/workflow/folder/manifest.hpp"
#include "ensemble/workflow/folder/output_folder.hpp"
#include "ensemble/workflow/machine/machine_speed.hpp"
#include "ensemble/workflow/members/growing_ground.hpp"
#include "io/scenario/scenario_file.hpp"
#include "scenarios/assembly/assemble.hpp"
#include "scenarios/scene_inputs.hpp"

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sturz::workflow {

/// Which scene is meant.
struct SceneRequest {
  std::string file;                    ///< scenario file
  std::vector<std::string> overrides;  ///< "key=value"
  SpeedCache speed_cache;              ///< for the prediction of seconds
  bool predicts = true;                ///< false: seconds are not asked for, 0 then
};

struct Scene {
  Scenario scenario;                      ///< with overrides and defaults, distributions in place
  Scenario medians;                       ///< the same with each distribution's median
  SceneInputs inputs;                     ///< with the part of the raster that is read first
  std::shared_ptr<GrowingGround> ground;  ///< the same for members, and more where they need it
  SceneDescription description;           ///< of the medians
};

/// "file:line:column: " in front of lines that begin with a key, where the file says it or the
/// block that it is in.
std::string at_their_places(const std::string& lines, const std::map<std::string, Position>& at);

/// Reads, overrides, validates, loads and describes. Everything that can be wrong with the user's
/// data is found here, before a folder is made or a step computed.
/// \throws SetupError; also for a region, which is as many scenes as its layer has features
Scene load_scene(const SceneRequest&);
/// The same for a scenario that was read already. \param cache  for the prediction of seconds;
/// empty: none
Scene scene_of(ScenarioFile, const std::optional<SpeedCache>& cache);

/// The description in sentences, as `describe` prints it and reports keep it.
std::vector<std::string> description_lines(const Scene&);

/// A manifest filled with what the scene says about itself.
Manifest manifest_of(const Scene&, const std::string& kind, const std::string& command);

/// Writes scenario.yaml into the folder. \throws IoError
void save_scenario(const OutputFolder&, const Scenario&);

}  // namespace sturz::workflow
