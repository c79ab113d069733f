// SPDX-License-Identifier: Apache-2.0
/// The scenario's `report` block.
#pragma once

#include <map>
#include <string>

namespace sturz {

/// What the page shows besides the results, and how; no member depends on it.
struct ReportSpec {
  std::string language;  ///< one of the page's tables of texts; empty: English
  std::map<std::string, std::string> overlays;  ///< name -> any OGR layer, drawn over the maps
  std::string orthophoto;                       ///< raster of three colours, drawn below them
  bool animation = false;                       ///< keep one member's thickness over time
  bool operator==(const ReportSpec&) const = default;
};

}  // namespace sturz
