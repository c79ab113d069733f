// SPDX-License-Identifier: Apache-2.0
/// Everything that a scene's `observation` names, as one event on the cells of the maps.
#pragma once

#include "engine/core/vec.hpp"
#include "scenarios/input_identity.hpp"
#include "scenarios/observation/observed_event.hpp"
#include "scenarios/scenario.hpp"

#include <string>
#include <vector>

namespace sturz {

struct EventRead {
  ObservedEvent event;
  std::vector<std::vector<Vec2>> rings;  ///< of the outline, else of the deposit, to be drawn
  std::vector<std::string> notes, warnings;
  std::vector<InputIdentity> identities;  ///< of every file
};

/// \pre the scenario is valid and has an `observation`
/// \param maps their whole grid; no cells: the terrain could not be read, only files are checked
/// \param release thickness or cover of the source on its cells; null: not known
/// \throws SetupError naming key and file, for all files at once, one a line
EventRead read_observed_event(const Scenario&, const Grid& maps, const Raster<double>* release);

}  // namespace sturz
