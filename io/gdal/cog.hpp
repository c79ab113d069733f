// SPDX-License-Identifier: Apache-2.0
/// Maps as GeoTIFF: Cloud-Optimised for results, plain for terrains.
#pragma once

#include "scenarios/layers/layer_stack.hpp"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace sturz {

using TextPairs = std::vector<std::pair<std::string, std::string>>;

/// Names of the files that write_cogs() makes of the stack, in their order.
std::vector<std::string> cog_names(const LayerStack& stack);

/// One Cloud-Optimised GeoTIFF per plane, <layer>.tif or <layer>_<axis value>.tif, in `folder`
/// (made if needed): float32 with nodata NaN, counts int32; unit, description and the stack's
/// attributes as metadata. Each file appears whole or not at all.
/// \return the files in the order of the layers
/// \throws IoError
std::vector<std::filesystem::path> write_cogs(const std::filesystem::path& folder,
                                              const LayerStack& stack);

/// A float64 GeoTIFF [m] with nodata NaN and metadata, e.g. {{"SYNTHETIC", "YES"}}. \throws IoError
void write_geotiff(const std::filesystem::path& file, const Raster<double>& raster,
                   const TextPairs& metadata);

}  // namespace sturz
