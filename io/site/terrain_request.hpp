// SPDX-License-Identifier: Apache-2.0
/// The raster that a scenario names as its terrain.
#pragma once

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

}  // namespace sturz
