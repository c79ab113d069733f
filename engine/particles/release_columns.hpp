// SPDX-License-Identifier: Apache-2.0
/// The mean thickness of each lattice column under a thickness raster, by exact overlap of areas.
#pragma once

#include "engine/terrain/raster.hpp"

#include <cstdint>
#include <vector>

namespace sturz {

/// The column over [lattice_x, lattice_x + 1) x [lattice_y, lattice_y + 1), times the spacing, in
/// map coordinates: the lattice does not move with the raster's origin or extent.
struct ReleaseColumn {
  std::int64_t lattice_x = 0, lattice_y = 0;
  double thickness_m = 0;  ///< volume of the raster over the column / spacing^2, vertical
  double covered = 0;      ///< share of the column's lattice cell that the source covers, 0..1
};

/// Rows and columns of a raster, ends included.
struct CellExtent {
  int row0 = 0, row1 = -1, col0 = 0, col1 = -1;
};

struct ReleaseColumns {
  std::vector<ReleaseColumn> columns;  ///< thickness > 0; rows from the north, west to east
  double volume_m3 = 0;                ///< of the raster
  double area_m2 = 0;                  ///< of its cells with thickness > 0
  double max_thickness_m = 0;
  CellExtent cells;  ///< of the raster that hold all thickness > 0
};

/// \param thickness vertical [m]; NaN and <= 0 count as nothing
/// \param cover share of each cell of `thickness` that the source covers, on the same grid; null:
///              all of every cell that is thicker than zero
/// \throws SetupError when nothing is thicker than zero, a value is infinite, or the lattice is
///         too fine to be meant
ReleaseColumns release_columns(const Raster<double>& thickness, double spacing_m,
                               const Raster<double>* cover = nullptr);

}  // namespace sturz
