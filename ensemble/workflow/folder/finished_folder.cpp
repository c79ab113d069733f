// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/folder/finished_folder.hpp"

#include "engine/core/error.hpp"
#include "io/scenario/scenario_file.hpp"
#include "io/site/scene_inputs.hpp"

#include <fmt/core.h>

namespace sturz::workflow {
namespace fs = std::filesystem;

FinishedFolder open_finished(const fs::path& folder, Observer& observer) {
  FinishedFolder found;
  found.folder.root = folder;
  require(fs::exists(found.folder.manifest()) && fs::exists(found.folder.scenario()),
          fmt::format("{} holds no results of sturz (manifest.json or scenario.yaml is missing). "
                      "Name the folder that `sturz ensemble` or `sturz run` wrote.",
                      folder.string()));
  found.manifest = Manifest::read(found.folder.manifest());
  found.scenario = read_scenario(found.folder.scenario());
  try {
    found.inputs = std::make_shared<const SceneInputs>(load_scene_inputs(found.scenario));
  } catch (const SetupError& problem) {
    observer.warning(
        fmt::format("the terrain cannot be read, a page will have no relief: {}", problem.what()));
  }
  return found;
}

}  // namespace sturz::workflow
