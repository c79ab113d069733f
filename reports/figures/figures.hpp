// SPDX-License-Identifier: Apache-2.0
/// Still pictures of one map over hillshade, for pages without script, for print, for other texts.
#pragma once

#include "reports/figures/legend.hpp"
#include "reports/figures/map_scene.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace sturz {

/// Hidden SVG that holds the hillshade picture once, under the id `hillshade`; every figure of a
/// page refers to it.
std::string hillshade_defs(const MapScene& scene);

/// Figure for a page that already holds hillshade_defs(): hillshade, colours, frame, coordinates,
/// scale bar. The legend is the page's (see legend_html).
std::string map_figure_svg(const MapScene& scene, const LayerStack& maps, const Layer& layer,
                           std::size_t plane);
/// Legend as a list of coloured swatches for HTML, ordered from low to high.
std::string legend_html(const Legend& legend);

}  // namespace sturz
