// SPDX-License-Identifier: Apache-2.0
/// Lines that the front of a flow took, from its times of arrival.
#pragma once

#include "engine/terrain/raster.hpp"
#include "scenarios/layers/feature_table.hpp"
#include "scenarios/layers/layer_stack.hpp"

#include <cstdint>

namespace sturz::workflow {

/// Lines down which the times of arrival grow most steadily, from the middle of the release to the
/// farthest cell of each probability (90, 50 and 5 %), or of a single run to its farthest cell: of
/// all ways over reached cells the one with the least sum of changes of the arrival time (Dijkstra
/// 1959), of equal ones the shortest. Where times only grow along the way that is how the front
/// went; it is the way of no particle, and no flow line of a velocity field. Times are the median
/// over the members that came. Farthest: in a straight line from the release.
///
/// Columns: name ("P >= 50 %"), probability (none for a run), length_m along the line, arrival_s
/// at its end, cell_m of the cells that it was sought in. Corners are centres of cells. Empty
/// without times of arrival or release. Layer `flow_lines`.
FeatureTable flow_lines(const LayerStack& maps, const Raster<std::uint8_t>& release);

}  // namespace sturz::workflow
