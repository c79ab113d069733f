// SPDX-License-Identifier: Apache-2.0
/// Maps as GeoTIFF: Cloud-Optimised for results, plain for terrains.
#pragma once

#include "engine/core/cancel.hpp"
#include "scenarios/layers/layer_stream.hpp"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace sturz {

using TextPairs = std::vector<std::pair<std::string, std::string>>;

/// Which plane of which layer a file holds.
struct PlaneFile {
  std::size_t layer = 0, plane = 0;
  std::filesystem::path path;
};

/// The files that write_cogs() makes, in the order of the layers.
std::vector<PlaneFile> cog_files(const std::filesystem::path& folder, const LayerStack& about);

/// One Cloud-Optimised GeoTIFF per plane, plane_file_name() + ".tif", in `folder`; bounds of
/// probabilities in its folder `bounds`, so that the maps that people open first stand alone;
/// counts, the same number everywhere, are left out. float32 with nodata NaN; unit, description and
/// the stack's attributes as metadata. Planes pass through block by block; each file appears whole
/// or not at all. \return the files in the order of the layers \throws IoError; Cancelled
std::vector<PlaneFile> write_cogs(const std::filesystem::path& folder, const LayerSource& maps,
                                  CancelFlag cancel = {});

/// One such file of one plane under any name. \throws IoError; Cancelled
void write_cog(const std::filesystem::path& file, const LayerSource& maps, std::size_t layer,
               std::size_t plane, CancelFlag cancel = {});

/// A float64 GeoTIFF [m] with nodata NaN and metadata, e.g. {{"SYNTHETIC", "YES"}}. \throws IoError
void write_geotiff(const std::filesystem::path& file, const Raster<double>& raster,
                   const TextPairs& metadata);

}  // namespace sturz
