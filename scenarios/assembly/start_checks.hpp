// SPDX-License-Identifier: Apache-2.0
/// Is the release where and as fine as it has to be? Looked at before a step is computed.
#pragma once

#include "engine/core/domain.hpp"
#include "engine/particles/release.hpp"
#include "engine/terrain/raster.hpp"

namespace sturz {

/// A wall throws what starts behind it to its front at once.
/// \throws SetupError naming each wall with the number of particles and the mass behind it, how
///         far, and what would be right
void require_before_walls(const Release&, const Domain&, bool columns);

/// Narrow side of a release [m]: the least of three widths of the rectangle that it is like, by
/// second moments, by area and edge, and by area alone. Exact for a square, up to twice the narrow
/// side of a bent strip.
/// \param source_area_m2 of the outline, where it is finer than the cells; 0: not known
double narrow_side(const Raster<double>& thickness, double source_area_m2);

/// From this many spacings across its narrow side on a release keeps its shape and area.
inline constexpr double resolved_across = 10;

}  // namespace sturz
