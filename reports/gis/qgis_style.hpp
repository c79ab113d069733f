// SPDX-License-Identifier: Apache-2.0
/// How a map looks when its GeoTIFF is opened in QGIS.
#pragma once

#include "scenarios/layers/layer_stack.hpp"

#include <string>

namespace sturz {

/// Text of a .qml file, which QGIS applies by itself when it lies beside the raster under the same
/// name: the classes and colours of the page, and nothing drawn where no member came (0) or where
/// nothing is known. The values of the raster are not touched.
/// \param layer with values, which set the largest class; bounds and probabilities need none
std::string qgis_style(const Layer& layer);

/// What of it a project repeats for each layer: the elements pipe and blendMode.
std::string raster_symbology(const Layer& layer);
/// The same of elevations: light from all sides, pale.
std::string hillshade_symbology();
/// The frame of a .qml file.
/// \param categories what of a layer it sets, e.g. "Symbology|Labeling"
std::string qgis_style_file(const std::string& symbology, const char* categories);

}  // namespace sturz
