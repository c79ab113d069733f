// SPDX-License-Identifier: Apache-2.0
/// The part of the map that a page shows: the touched cells, and the ground around them.
#pragma once

#include "engine/simulation/member_result.hpp"
#include "scenarios/layers/layer_stack.hpp"

#include <cstdint>
#include <vector>

namespace sturz {

/// Everything a map picture needs besides the layer itself. Rows north up.
struct MapScene {
  Grid cells;                       ///< result cells shown; may be coarser than the results' own
  Window window;                    ///< the same in the results' grid
  int coarsening = 1;               ///< results' cells per shown cell and direction
  Raster<double> ground;            ///< elevation around them [m], NaN unknown; has a margin
  std::vector<std::uint8_t> shade;  ///< hillshade of `ground`, 0..255
};

/// Cells where any layer (counts aside) holds a value other than zero; empty when none does.
Window touched_window(const LayerStack& maps);

/// Crops to the touched cells with a margin of ground around them. Keeps both rasters below about
/// half a million cells by taking wider cells. Shows the whole grid when nothing was touched.
/// \param elevation may be null: the ground is then unknown and drawn plain
MapScene make_map_scene(const LayerStack& maps, const Raster<double>* elevation);

/// One plane of a layer on scene.cells; where cells were joined, the most severe value of each
/// block: the smallest arrival time, the largest of everything else; NaN only if all are.
std::vector<float> scene_plane(const MapScene& scene, const Layer& layer, std::size_t plane,
                               const Grid& results);

}  // namespace sturz
