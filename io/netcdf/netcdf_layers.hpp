// SPDX-License-Identifier: Apache-2.0
/// Maps as CF-1.10 netCDF: opens with its coordinate system in QGIS, gdalinfo, xarray, cdo.
///
/// Float maps are [axis][y][x] float32 with _FillValue NaN, counts int32. A layer's extra axis is a
/// coordinate variable; thresholds carry spp__relative_to_threshold = "greater_than" (the shape in
/// which the Met Office's IMPROVER stores exceedance probabilities). What a map shows stands in its
/// attributes sturz_quantity, sturz_statistic and sturz_intensity_class, words of
/// scenarios/layers/layer_meaning.hpp.
/// No unlimited dimensions, no time stamps: the same layers give the same bytes.
#pragma once

#include "engine/simulation/history.hpp"
#include "scenarios/layers/layer_stack.hpp"

#include <filesystem>

namespace sturz {

/// Writes the whole stack in one stroke, and with it the history of the member whose maps these are
/// (see history_netcdf.hpp). How long it took to compute is not in it: the file says what the mass
/// did, and two machines should agree on it; computing times are in the member's file. Global
/// attributes Conventions, title, source and history are added where `stack.attributes` has none.
/// \throws IoError when the disk refuses; SetupError for layers that contradict each other (two
///   axes of one name with other values, axis not increasing, wrong number of values)
void write_layers(const std::filesystem::path& file, const LayerStack& stack,
                  const MemberHistory& history = {});

/// Reads back the maps that write_layers wrote. \throws IoError, also where a map does not say what
/// it shows
LayerStack read_layers(const std::filesystem::path& file);

}  // namespace sturz
