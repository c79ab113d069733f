// SPDX-License-Identifier: Apache-2.0
/// Analytic sources (box, cylinder, paraboloid) as exact shares of the terrain's cells.
#pragma once

#include "engine/terrain/raster.hpp"
#include "scenarios/scenario.hpp"

namespace sturz {

struct ShapeCover {
  /// Thickness / release.thickness_m averaged over the cell, 0..1; on the cells around the source.
  Raster<double> cover;
  double area_m2 = 0;         ///< exact plan area
  double unit_volume_m3 = 0;  ///< exact integral of the cover; the raster's sum equals it
};

/// \throws SetupError naming the key when the shape has no area or reaches beyond the terrain
ShapeCover cover_of(const MapBox& box, const Grid& terrain, const char* key = "release.box");
ShapeCover cover_of(const ReleaseCylinder& cylinder, const Grid& terrain);
/// Interior cells exactly, cells on the outline by 16 x 16 samples, then scaled to the exact
/// volume.
ShapeCover cover_of(const ReleaseParaboloid& paraboloid, const Grid& terrain);

}  // namespace sturz
