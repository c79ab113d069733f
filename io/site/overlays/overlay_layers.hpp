// SPDX-License-Identifier: Apache-2.0
/// Layers that a scenario's page draws over its maps, in the terrain's system.
#pragma once

#include "engine/terrain/raster.hpp"
#include "scenarios/overlays/overlay.hpp"
#include "scenarios/scenario.hpp"

#include <string>
#include <vector>

namespace sturz {

/// Corners that all overlays of a page may have together, after clipping and thinning: about a
/// megabyte of its text.
inline constexpr std::size_t most_overlay_corners = 60'000;

struct OverlaysRead {
  std::vector<Overlay> overlays;
  std::vector<std::string> notes, warnings;
};

/// Every layer of report.overlays: clipped to `terrain`, thinned to a quarter of its cell, parts of
/// collections as features of their own. \param terrain without cells only the files are checked
/// \throws SetupError naming layer and file: missing, no coordinate system, more corners than a
/// page
///   holds
OverlaysRead read_overlays(const Scenario& scenario, const Grid& terrain);

}  // namespace sturz
