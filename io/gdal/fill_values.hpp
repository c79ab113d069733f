// SPDX-License-Identifier: Apache-2.0
/// Numbers that stand for "nothing here" although the file does not say so. Each test looks at one
/// cell only, so that any window of a raster loses the same cells. Included by .cpp files only.
#pragma once

#include "io/gdal/raster_source.hpp"

#include <gdal_priv.h>

namespace sturz {

/// No ground on earth lies beyond these, bare or under the sea.
inline constexpr double highest_ground_m = 9000, lowest_ground_m = -11000;

/// Blanks the usual marks in the values as they are stored: not finite, beyond 1e15, the largest
/// (or smallest) number of the band's integer type, and, where the band has no scale, -9999,
/// -99999, -32767, -32768, 32767 and 65535. The count goes to the notes.
void blank_marks(RasterSource& source, GDALDataType type, bool scaled);

/// Blanks elevations in metres that no ground has. The count goes to the notes.
/// \throws SetupError when every valid cell is such a one: the unit is wrong
void blank_beyond_earth(RasterSource& source);

}  // namespace sturz
