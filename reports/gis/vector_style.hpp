// SPDX-License-Identifier: Apache-2.0
/// How the layers of a GeoPackage look in QGIS.
#pragma once

#include "reports/figures/legend.hpp"

#include <string>

namespace sturz {

/// What kind of shape a vector layer holds, in the words of QGIS.
enum class Shape { point, line, polygon };

/// What a layer of a scene's own things is.
enum class SiteLayer {
  release,   ///< where the mass lay
  observed,  ///< what an event reached
  flow,      ///< ways of the front
  thalweg,   ///< line down the path of an event
  gauge,     ///< points and lines that were watched
  assets,    ///< what may be hit, with a column `probability`
  deposits   ///< centres of the members' deposits
};

/// Column by which areas of a legend's classes are told apart: 1 the first class, 2 the next, ...
inline constexpr const char* class_column = "class";

/// Elements of areas with a column class_column, filled in the colours of the legend.
std::string class_symbology(const Legend& legend);
/// Elements of one layer of the scene's own; those with a column `name` show it.
std::string site_symbology(SiteLayer layer, Shape shape);
/// A .qml of either. \param symbology as the two above make it
std::string vector_style(const std::string& symbology, Shape shape);

}  // namespace sturz
