// SPDX-License-Identifier: Apache-2.0
/// A member's history as netCDF variables over a coordinate `time`; in peaks.nc and member files.
#pragma once

#include "engine/simulation/history.hpp"
#include "io/netcdf/netcdf_file.hpp"

namespace sturz {

/// Dimension and coordinate `time` [s since the release] and one float32 variable per column of
/// history_table() that the scene has. Nothing for a history without rows. Not deflated: the index
/// of a chunk is as large as 400 numbers.
void write_history(NetcdfWriter& file, const MemberHistory& history);

/// Reads back what write_history wrote, bit for bit; no rows where there is no such dimension.
/// \throws IoError when a column is cut short or missing
MemberHistory read_history(const NetcdfReader& file);

}  // namespace sturz
