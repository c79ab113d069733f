// SPDX-License-Identifier: Apache-2.0
/// In which unit, and counted in which direction, a raster's values are heights. Included by .cpp
/// files only.
#pragma once

#include "io/gdal/crs.hpp"

#include <string>

namespace sturz {

/// How stored values become metres upwards.
struct HeightUnit {
  double metres = 1;    ///< per unit
  bool down = false;    ///< depths: the value's sign is turned
  std::string note;     ///< what was converted and why; may be empty
  std::string warning;  ///< what was guessed; may be empty
};

/// Metres per unit of a band's word for it ("ft", "US survey foot", ...), 0 for one not known.
double metres_per_unit(std::string word);

/// The scenario's system comes first where it has a vertical part, then the band's own word, then
/// the vertical part of the file's own system. A direction downwards comes from the settled system
/// only.
/// \param settled of the coordinates, its vertical part included
/// \param own the file's own; nullptr: none
/// \param word unit of the band; empty: none
HeightUnit height_unit(const OGRSpatialReference& settled, const OGRSpatialReference* own,
                       const std::string& word, const std::string& label);

}  // namespace sturz
