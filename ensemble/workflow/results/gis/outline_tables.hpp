// SPDX-License-Identifier: Apache-2.0
/// Maps and places of a scene as tables of features.
#pragma once

#include "engine/core/cancel.hpp"
#include "engine/simulation/member_result.hpp"
#include "reports/figures/legend.hpp"
#include "scenarios/layers/feature_table.hpp"
#include "scenarios/layers/layer_stream.hpp"
#include "scenarios/scene_inputs.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace sturz::workflow {

/// Maps whose classes are worth an outline: all probabilities; quantiles of thickness and
/// deposit, and those of a run.
bool is_outlined(const Layer& layer);

/// Areas of the classes of one plane, along its cells' edges, named as its GeoTIFF: class (1 the
/// first of the legend), label, <quantity>_from and <quantity>_to with their unit, area_m2. Classes
/// that no cell has are left out; so are cells that the legend leaves clear.
/// \throws Cancelled
FeatureTable class_areas(const LayerSource& maps, std::size_t layer, std::size_t plane,
                         const Legend& legend, CancelFlag cancel = {});

/// One area: the cells that are set. Empty where none is.
FeatureTable release_area(const Raster<std::uint8_t>& cells);
/// One area of closed rings [m]. Empty for no rings.
FeatureTable observed_area(const std::vector<std::vector<Vec2>>& rings, const std::string& crs_wkt);
/// A line down the path of the event, where the scene's observation has one; else empty.
FeatureTable thalweg_line(const SceneInputs& inputs, const std::string& crs_wkt);
/// Gauges that are points, or lines, with their names.
FeatureTable gauge_table(const std::string& name, std::span<const Gauge> gauges,
                         const std::string& crs_wkt);
/// Where the centre of mass of each valid member came to rest, with its outcome and lengths.
FeatureTable deposit_centres(std::span<const MemberSummary> members, const std::string& crs_wkt);

}  // namespace sturz::workflow
