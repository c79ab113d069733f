// SPDX-License-Identifier: Apache-2.0
/// Still pictures of one map over hillshade, for pages without script, for print, for other texts.
#pragma once

#include "engine/core/vec.hpp"
#include "reports/figures/cell_outline.hpp"
#include "reports/figures/legend.hpp"
#include "reports/figures/map_scene.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace sturz {

/// How far one of two materials comes.
struct FrontMark {
  Phase phase = Phase::both;
  std::string label;
  std::vector<MapLine> lines;
};
/// Of grains and of liquid, where maps tell them apart: the cells that a run reached, or that half
/// of an ensemble's members reach. A material that comes nowhere has none.
std::vector<FrontMark> front_marks(const LayerStack& maps);
/// "grains" or "liquid": what styles call it.
const char* style_word(Phase phase);

/// What is drawn over every map.
struct MapMarks {
  std::vector<MapLine> release;                 ///< outline of the cells covered at the start
  std::span<const std::vector<Vec2>> observed;  ///< closed rings of a mapped event [m]
  std::string observed_note;                    ///< what they are; may be empty
  std::vector<MapLine> nearest;                 ///< outline of what the member nearest to it covers
  std::string nearest_label;
  std::vector<FrontMark> fronts;
  std::vector<float> left;  ///< [scene.cells], > 0 where mass left the terrain; may be empty
};
/// All but the observed outline and the member nearest to it.
MapMarks map_marks(const MapScene& scene, const LayerStack& maps,
                   const Raster<std::uint8_t>* release);
/// "observed: NOTE"
std::string observed_label(const std::string& note);
/// "member 7, nearest to what was observed"; of a single run "this run".
std::string nearest_label(std::int64_t member, bool single);

/// Hidden SVG that holds the hillshade picture once, under the id `hillshade`, and the pattern
/// `hatch`; every figure of a page refers to them.
std::string hillshade_defs(const MapScene& scene);

/// Figure for a page that already holds hillshade_defs(): hillshade, colours, frame, coordinates,
/// scale bar, north arrow, marks. The legend is the page's (see legend_html).
std::string map_figure_svg(const MapScene& scene, const LayerStack& maps, const Layer& layer,
                           std::size_t plane, const MapMarks& marks);
/// What the marks mean, as a list for HTML; empty text where there are none.
std::string marks_legend_html(const MapMarks& marks);
/// Legend as a list of coloured swatches for HTML, ordered from low to high.
std::string legend_html(const Legend& legend);

}  // namespace sturz
