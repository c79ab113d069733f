// SPDX-License-Identifier: Apache-2.0
/// The files that a scenario names as its release. Included by .cpp files only, as crs.hpp.
#pragma once

#include "io/gdal/raster_request.hpp"
#include "io/site/polygon_request.hpp"
#include "io/site/stand_in_crs.hpp"
#include "scenarios/scenario.hpp"

namespace sturz {

inline PolygonRequest release_polygon_request(const Scenario& scenario) {
  const ReleaseSpec& spec = scenario.release;
  PolygonRequest request;
  request.path = spec.polygon;
  request.layer = spec.layer;
  request.feature = spec.feature;
  request.feature_field = spec.feature_key;
  request.thickness_attribute = spec.thickness_attribute;
  request.volume_attribute = spec.volume_attribute;
  request.start_time_attribute = spec.start_time_attribute;
  request.directory = scenario.directory;
  request.crs = spec.crs;
  stand_in_with_terrain(request, scenario.terrain);
  return request;
}

inline RasterRequest release_raster_request(const Scenario& scenario) {
  const ReleaseSpec& spec = scenario.release;
  RasterRequest request;
  request.path = spec.thickness_raster;
  request.key = "release.thickness_raster";
  request.directory = scenario.directory;
  request.crs = spec.crs;
  request.crs_key = "release.crs";
  request.factor = spec.thickness_factor;
  stand_in_with_terrain(request, scenario.terrain);
  return request;
}

}  // namespace sturz
