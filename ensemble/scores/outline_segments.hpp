// SPDX-License-Identifier: Apache-2.0
/// Outlines as straight segments: of a set of cells, and of mapped rings.
#pragma once

#include "engine/core/vec.hpp"
#include "engine/terrain/raster.hpp"

#include <cstdint>
#include <vector>

namespace sturz {

struct Segment {
  Vec2 a = Vec2::Zero(), b = Vec2::Zero();  ///< [m]
  double length() const { return (b - a).norm(); }
};

/// The set with its holes filled: cells that are not set and from which no way over such cells
/// (side by side) leads out of the raster. A mapper draws the outer line.
Raster<std::uint8_t> without_holes(Raster<std::uint8_t> cells);

/// The outer boundary of a set of cells, one segment per straight run of cell edges.
std::vector<Segment> outer_boundary(const Raster<std::uint8_t>& cells);

/// The sides of closed rings whose last point repeats the first.
std::vector<Segment> sides_of(const std::vector<std::vector<Vec2>>& rings);

}  // namespace sturz
