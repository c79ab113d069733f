// SPDX-License-Identifier: Apache-2.0
/// The system of files that do not say theirs. Included by .cpp files only, as crs.hpp.
#pragma once

#include "io/gdal/crs.hpp"
#include "scenarios/scenario.hpp"

namespace sturz {

/// Where the terrain's file had no system, the files beside it mostly share the lack, and the user
/// has named the system once.
template <class Request>
void stand_in_with_terrain(Request& request, const TerrainSpec& terrain) {
  if (terrain.crs == local_crs) return;
  request.fallback_crs = terrain.crs;
  request.fallback_crs_key = "terrain.crs";
}

}  // namespace sturz
