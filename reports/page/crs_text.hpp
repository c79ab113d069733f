// SPDX-License-Identifier: Apache-2.0
/// Coordinate systems in words.
#pragma once

#include <string>

namespace sturz {

/// Name of a coordinate system and its code: "WGS 84 / UTM zone 33N (EPSG:32633)".
std::string crs_name(const std::string& wkt);
/// "EPSG:32633"; its name where the system has no code.
std::string system_text(const std::string& wkt);

}  // namespace sturz
