// SPDX-License-Identifier: Apache-2.0
/// Heights that no ground has: what fill values, tiles that do not fit, spikes and a careless
/// interpolation leave in an elevation raster. Included by .cpp files only.
#pragma once

#include "io/gdal/raster_source.hpp"

#include <string>
#include <vector>

namespace sturz {

/// Where the cells that were read lie in the whole raster, for the numbers in the sentences.
struct CellOrigin {
  int row = 0, col = 0;
};

/// One sentence for each kind of doubt, with the number of cells, the worst cell (row and column
/// from the north-west, from 0, and map coordinates) and its size. Kinds, for cells of width c:
/// - a block of 0 m whose outline rises by more than max(50 m, 6 c) on average;
/// - neighbours that differ by more than max(200 m, 6 c);
/// - a single cell above or below all its eight neighbours by more than max(5 m, c) and by more
/// than
///   these differ among themselves;
/// - terraces: whole multiples of a step of at least 2 % of c, at least a tenth of the neighbours
///   equal and a tenth one step apart;
/// - flat spots at the levels of contour lines and hardly elsewhere, at five levels or more.
/// Looks at every cell a few times; north-up sources only, others have no doubts.
std::vector<std::string> dem_doubts(const RasterSource& source, CellOrigin origin = {});

}  // namespace sturz
