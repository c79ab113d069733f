// SPDX-License-Identifier: Apache-2.0
/// A discharge over time as comma-separated text.
#pragma once

#include "scenarios/inflow/hydrograph.hpp"

#include <string>
#include <string_view>

namespace sturz {

/// First line: names of columns, with units: time_s (or time_min, time_h), discharge_m3_s (or
/// discharge_l_s), and solid_fraction where it is known. Then a row for each time, times rising
/// from 0 on; blank lines and lines that begin with # do not count. \param name  of the file, for
/// messages \throws SetupError with one line for everything that is wrong, each "name:line: ..."
Hydrograph parse_hydrograph(std::string_view text, const std::string& name);

}  // namespace sturz
