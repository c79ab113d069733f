// SPDX-License-Identifier: Apache-2.0
/// Gauges of a member as variables gauge_... of its file.
#pragma once

#include "engine/simulation/gauges/gauge_result.hpp"
#include "io/netcdf/netcdf_file.hpp"

namespace sturz {

/// Dimensions gauge_time, gauge_point, gauge_line; nothing where there are no gauges. Corners of
/// lines are not kept: the scenario has them.
void write_gauges(NetcdfWriter& file, const GaugeResult& gauges);
/// Empty where the file has none. \throws IoError for a damaged file
GaugeResult read_gauges(const NetcdfReader& file);

}  // namespace sturz
