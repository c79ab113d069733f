// SPDX-License-Identifier: Apache-2.0
/// Reading parts of a member's file; shared by read_member and MemberStore.
#pragma once

#include "engine/simulation/member_result.hpp"
#include "io/members/member_origin.hpp"
#include "io/netcdf/netcdf_file.hpp"

namespace sturz {

/// Everything but the maps. \throws IoError for a file that is not a member's or is damaged
MemberSummary read_member_summary(const NetcdfReader& file);
/// \throws IoError where one of its parts is missing
MemberOrigin read_member_origin(const NetcdfReader& file);
/// \throws IoError when the window reaches beyond the grid
void require_inside(const NetcdfReader& file, const Window& window, const Grid& grid);
/// Rows first..first+n-1 of one map, counted within the window. \throws IoError
void read_member_rows(const NetcdfReader& file, const Window& window, PeakLayer layer, int first,
                      int n, std::span<float> out);

/// One map in the cells of `part`, a window of the grid inside the member's own. \throws IoError
void read_member_part(const NetcdfReader& file, const Window& window, PeakLayer layer,
                      const Window& part, std::span<float> out);

}  // namespace sturz
