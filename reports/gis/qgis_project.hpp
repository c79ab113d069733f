// SPDX-License-Identifier: Apache-2.0
/// A QGIS project over files of results: groups, readable names, styles, relative paths.
#pragma once

#include "engine/terrain/raster.hpp"
#include "reports/gis/vector_style.hpp"

#include <optional>
#include <string>
#include <vector>

namespace sturz {

struct ProjectLayer {
  std::string title;           ///< as the list of layers shows it
  std::string source;          ///< "hazard/P_reached.tif", from the project's folder
  std::string table;           ///< of a GeoPackage; empty: a raster
  std::optional<Shape> shape;  ///< of a vector layer; nothing: a raster
  std::string symbology;       ///< elements, as raster_symbology() and its like make them
  bool shown = false;
};

struct ProjectGroup {
  std::string title;
  std::vector<ProjectLayer> layers;  ///< the upper ones first
  bool open = true;
};

struct QgisProject {
  std::string title;
  Grid place;               ///< extent and system of the first view
  std::optional<int> epsg;  ///< code of that system
  std::vector<ProjectGroup> groups;
};

/// Text of a .qgs file. The same project gives the same text.
std::string qgis_project(const QgisProject& project);

}  // namespace sturz
