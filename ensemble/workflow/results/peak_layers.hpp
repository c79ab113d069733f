// SPDX-License-Identifier: Apache-2.0
/// The maps of one member around what it touched.
#pragma once

#include "engine/simulation/member_result.hpp"
#include "scenarios/layers/layer_stack.hpp"

namespace sturz::workflow {

/// Every peak layer of the member in the units of hazard maps (energy kJ m-2, pressure kPa), over
/// map_extent() of what it touched; 0 where the ground is known and no flow came, NaN where it is
/// not known, arrival NaN where none came. \param ground elevations; null: known everywhere
/// \param whole_ground of which `ground` is a window; empty: it is all
LayerStack peak_layers(const MemberResult&, const Raster<double>* ground,
                       const Grid& whole_ground = {});

/// The grid of those maps.
Grid map_grid(const MemberResult&);

}  // namespace sturz::workflow
