// SPDX-License-Identifier: Apache-2.0
/// Everything that a scene's `assets` names, on the cells of the maps.
#pragma once

#include "io/site/structures/structure_inputs.hpp"
#include "scenarios/assets/assets.hpp"
#include "scenarios/input_identity.hpp"
#include "scenarios/scenario.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace sturz {

struct AssetsRead {
  Assets assets;
  std::vector<std::string> notes, warnings;
  std::vector<InputIdentity> identities;  ///< of every file
};

/// Points touch the cell that holds them, lines every cell that they pass, polygons every cell of
/// which they cover some area. An asset beyond the maps, or where no ground is known, is named in a
/// warning and stays in the list.
/// \pre the scenario is valid and has `assets`
/// \param maps their whole grid; no cells: the terrain could not be read, only files are checked
/// \param terrain its whole grid
/// \param read elevations of a window of it
/// \throws SetupError naming key, file and feature: missing file, layer or field; no coordinate
///   system; an empty layer or geometry; an empty or repeated name; a class without a curve; a
///   value that is no number or below 0; no asset on the maps
AssetsRead read_assets(const Scenario&, const Grid& maps, const Grid& terrain,
                       const ReadGround& read);

/// Curves of a vulnerability file, `{class: {intensity: [[x, damage], ...]}}`, by class in file
/// order. Intensities are thickness_m, speed_m_s, energy_kj_m2 and pressure_kpa; stored in SI.
/// \param name of the file in messages
/// \throws SetupError with all problems, one a line
std::vector<DamageCurve> parse_damage_curves(std::string_view text, const std::string& name);

}  // namespace sturz
