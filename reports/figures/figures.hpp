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
/// The same as a complete file of its own: hillshade inside, title above, legend beside.
std::string map_figure_file(const MapScene& scene, const LayerStack& maps, const Layer& layer,
                            std::size_t plane, const std::string& title);
/// Legend as a list of coloured swatches for HTML, ordered from low to high.
std::string legend_html(const Legend& legend);

/// Bare picture without any text, colours over hillshade, north up, square cells.
/// \param pixels_across wished width [pixels]; whole pixels per ground cell are used
/// \return a PNG file
std::vector<std::uint8_t> map_picture_png(const MapScene& scene, const LayerStack& maps,
                                          const Layer& layer, std::size_t plane,
                                          int pixels_across = 1200);

/// hazard_map.png: map_picture_png of the layer that a reader should see first (empty if none).
std::vector<std::uint8_t> overview_png(const LayerStack& maps, const Raster<double>* elevation);
/// hazard_map.svg: map_figure_file of the same layer (empty if none).
std::string overview_svg(const LayerStack& maps, const Raster<double>* elevation,
                         const std::string& title);

}  // namespace sturz
