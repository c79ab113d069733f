// SPDX-License-Identifier: Apache-2.0
/// Which part of a large raster is read first.
#pragma once

#include "scenarios/assembly/reach.hpp"
#include "scenarios/scenario.hpp"
#include "scenarios/scene_inputs.hpp"

#include <optional>

namespace sturz {

struct FirstGround {
  std::optional<Reach> reach;  ///< empty where the ground repeats itself
  Window window;
};

/// The reach of the energy line with a margin; around the release and what `terrain.window` names
/// where that is given; all of the ground where it repeats itself.
/// \param inputs terrain grid and release are used
/// \throws SetupError for a release on cells without elevation, or a terrain.window beyond the
///   raster
FirstGround first_ground(const Scenario&, const SceneInputs& inputs, const ReadGround& read,
                         const std::string& release_label);

}  // namespace sturz
