// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/folder/finished_folder.hpp"

#include "engine/core/error.hpp"
#include "ensemble/workflow/folder/input_check.hpp"
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
    const auto inputs = std::make_shared<const SceneInputs>(load_scene_inputs(found.scenario));
    found.changed = changed_inputs(found.scenario, inputs->identities, found.manifest.inputs);
    found.inputs = inputs;
  } catch (const SetupError& problem) {
    found.unreadable =
        fmt::format("the terrain cannot be read, a page will have no relief: {}", problem.what());
    observer.warning(found.unreadable);
  }
  return found;
}

}  // namespace sturz::workflow
