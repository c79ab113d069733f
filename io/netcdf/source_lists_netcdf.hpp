// SPDX-License-Identifier: Apache-2.0
/// Which sources reach which cell, in the file of a region's maps.
#pragma once

#include "io/netcdf/netcdf_file.hpp"
#include "scenarios/layers/source_lists.hpp"

namespace sturz {

/// Compressed rows as CF has them, behind the maps of the same file:
///   reached_cell(reached_cell)      y * x.size + x, rising; CF: compress = "y x"
///   sources_at_cell(reached_cell)   how many hits the cell has; CF: a contiguous ragged array
///   hit_source(source_hit)          number of the source from 1, as in sources.csv; attribute
///                                   source_names: all names, one a line
///   hit_probability(source_hit)     share of the source's valid members that reach the cell
/// Nothing where no source reaches any cell.
/// \throws SetupError for a grid of more than 2^31 cells; IoError
void write_source_lists(NetcdfWriter& file, const SourceLists& lists);

/// Reads them back, bit for bit; no cells where the file has none.
/// \throws IoError where they contradict each other
SourceLists read_source_lists(const NetcdfReader& file, const Grid& grid);

}  // namespace sturz
