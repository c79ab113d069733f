// SPDX-License-Identifier: Apache-2.0
/// Maps in as few cells as a page can show.
#pragma once

#include "engine/core/cancel.hpp"
#include "scenarios/layers/layer_stream.hpp"

namespace sturz {

/// All layers but counts and bounds, in at most about `max_cells` cells: each joins f x f cells of
/// the source (f = LayerStack::joined) and holds the most severe value of them, the smallest
/// arrival time, the difference that is farthest from 0, the largest of everything else; NaN only
/// if all are. The source is read in bands of rows. \throws Cancelled, and what the source throws
LayerStack coarse_layers(const LayerSource& source, std::size_t max_cells, CancelFlag cancel = {});

}  // namespace sturz
