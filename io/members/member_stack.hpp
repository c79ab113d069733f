// SPDX-License-Identifier: Apache-2.0
/// One quantity of many members on one grid, in one netCDF file that needs no code to be read.
#pragma once

#include "engine/core/cancel.hpp"
#include "io/members/member_store.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace sturz {

struct MemberStack {
  PeakLayer layer = PeakLayer::thickness;
  std::string units;     ///< UDUNITS text of what is written
  float per_si = 1;      ///< a value of a member times this is written
  double frequency = 1;  ///< of the release [1/year]; each member has its share of it
  std::vector<std::pair<std::string, std::string>> attributes;  ///< of the file
};

struct StackWritten {
  std::int64_t members = 0;
  Grid grid;               ///< the smallest rectangle around what valid members touched
  bool has_place = false;  ///< it lies somewhere on the earth, and has longitude and latitude
};

/// Writes dimensions member, y, x and the variable `intensity` [member][y][x], of the valid members
/// by ascending number, 0 (arrival: missing) where a member did not come; beside it the names that
/// CLIMADA's Hazard.from_xarray_raster_file looks for: `time` (a number, for members have no date),
/// `event_id`, `frequency`, and `latitude`, `longitude` of the cells [degrees, WGS 84]. Memory
/// holds a band of rows of one member, and the two coordinates of all cells. \throws SetupError
/// when no member is valid or has the layer; IoError; Cancelled
StackWritten write_member_stack(const std::filesystem::path& file, const MemberStore& store,
                                const MemberStack& stack, CancelFlag cancel = {});

}  // namespace sturz
