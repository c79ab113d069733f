// SPDX-License-Identifier: Apache-2.0
/// Where a map lies in degrees, for readers that know no projections.
#pragma once

#include "engine/core/vec.hpp"
#include "engine/terrain/raster.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sturz {

/// Longitude and latitude (WGS 84, degrees) of places on a map.
class Geographic {
 public:
  explicit Geographic(const std::string& crs_wkt);
  ~Geographic();
  Geographic(const Geographic&) = delete;
  Geographic& operator=(const Geographic&) = delete;

  /// False for a map that lies nowhere on the earth, or in a system whose shift to WGS 84 is not
  /// known: then it may not be asked.
  bool is_known() const;
  /// In place: x, y [m] become longitude, latitude [degrees]. \throws IoError
  void transform(std::vector<double>& x, std::vector<double>& y) const;

 private:
  class Parts;
  std::unique_ptr<Parts> parts_;
};

/// The outline of a grid in degrees: closed, counterclockwise, with points along the edges, which
/// are no straight lines there. Empty where it has no place in degrees.
std::vector<Vec2> geographic_outline(const Grid& grid);

/// Code of a coordinate system in the EPSG's list; nothing where it has none.
std::optional<int> epsg_code(const std::string& crs_wkt);

}  // namespace sturz
