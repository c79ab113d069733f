// SPDX-License-Identifier: Apache-2.0
/// A coordinate system in the words of the CF conventions (appendix F). Included by .cpp files
/// only.
#pragma once

#include "io/gdal/crs.hpp"

#include <string>
#include <utility>
#include <vector>

namespace sturz {

/// Attributes of a grid mapping variable.
struct GridMapping {
  std::vector<std::pair<std::string, std::string>> texts;
  std::vector<std::pair<std::string, std::vector<double>>> numbers;
};

/// grid_mapping_name with its parameters, the ellipsoid, names, and crs_wkt (WKT2:2019).
/// A projection that CF has no name for is told by crs_wkt alone.
GridMapping cf_grid_mapping(const OGRSpatialReference& crs);

}  // namespace sturz
