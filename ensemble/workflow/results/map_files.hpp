// SPDX-License-Identifier: Apache-2.0
/// The maps as files of their own: GeoTIFFs, their QGIS styles, and a list of them.
#pragma once

#include "engine/core/cancel.hpp"
#include "scenarios/layers/layer_stream.hpp"

#include <filesystem>

namespace sturz::workflow {

/// Writes hazard/*.tif, hazard/bounds/*.tif, a .qml beside each and hazard/index.csv, and removes
/// those files of an earlier list that are no maps any more, say of other thresholds. What others
/// keep in the folder stays.
/// \param coarse the same maps in few cells, for the classes of the styles
/// \throws IoError; Cancelled
void write_map_files(const std::filesystem::path& folder, const LayerSource& maps,
                     const LayerStack& coarse, CancelFlag cancel);

/// Removes what write_map_files() left in the folder, and nothing else. \throws IoError
void remove_map_files(const std::filesystem::path& folder);

}  // namespace sturz::workflow
