// SPDX-License-Identifier: Apache-2.0
/// The identity of a raster by what was read of it. Included by .cpp files only.
#pragma once

#include "io/gdal/raster_source.hpp"

#include <map>
#include <optional>
#include <span>
#include <string>

namespace sturz {

/// Edge of the blocks that are hashed, in cells of the file.
inline constexpr int identity_block = 256;

/// Which part of a file's cells was read.
struct ReadWindow {
  int col0 = 0, row0 = 0, n_cols = 0, n_rows = 0;
};

/// The part that block_hashes() calls so; empty: such a file has no such part.
std::optional<ReadWindow> window_of_part(const std::string& name, int file_cols, int file_rows);

/// The hash of each block that the window holds, or of the part of it. The blocks lie on a lattice
/// of the file, so a larger window has the same hashes where the smaller one held whole blocks.
///
/// \param values [window.n_rows][window.n_cols], in the order of the file
/// \param file_cols, file_rows of the whole file
std::map<std::string, std::string> block_hashes(std::span<const double> values,
                                                const ReadWindow& window, int file_cols,
                                                int file_rows);

/// Size, place and coordinate system of the whole file, in words.
std::string raster_shape(int file_cols, int file_rows, const std::array<double, 6>& affine,
                         const OGRSpatialReference& crs);

/// A coordinate system in few words that no other one shares: its name with its code, or with a
/// hash of its definition.
std::string crs_identity(const OGRSpatialReference& crs);

}  // namespace sturz
