// SPDX-License-Identifier: Apache-2.0
/// The raster that a scenario names as its terrain.
#pragma once

#include "io/gdal/crs.hpp"
#include "io/gdal/raster_request.hpp"
#include "scenarios/scenario.hpp"

namespace sturz {

inline RasterRequest terrain_request(const Scenario& scenario) {
  const TerrainSpec& spec = scenario.terrain;
  RasterRequest request;
  request.path = spec.raster;
  request.directory = scenario.directory;
  request.crs = spec.crs;
  request.cell_size_m = spec.cell_size_m;
  return request;
}

/// Where the terrain's file had no system, the files beside it mostly share the lack, and the user
/// has named the system once.
template <class Request>
void stand_in_with_terrain(Request& request, const TerrainSpec& terrain) {
  if (terrain.crs == local_crs) return;
  request.fallback_crs = terrain.crs;
  request.fallback_crs_key = "terrain.crs";
}

}  // namespace sturz
