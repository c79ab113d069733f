// SPDX-License-Identifier: Apache-2.0
/// One finished member on disk: members/000017.nc, scalars, outcome, history, and the maps it
/// touched.
///
/// The history (at most 400 rows of 9 to 15 float32 columns) is kept of every member of an
/// ensemble: 25 to 40 kB that let any member be drawn over time without computing it again. Reading
/// a MemberSummary does not touch it.
/// The maps are CF rasters over the touched window (float32, bit for bit), so a member opens in GIS
/// like the hazard map does. A failed member is kept too, without maps.
#pragma once

#include "engine/simulation/member_result.hpp"
#include "io/members/member_origin.hpp"

#include <cstdint>
#include <filesystem>
#include <string>

namespace sturz {

/// "000017.nc"
std::string member_file_name(std::int64_t member);

/// Writes `folder`/000017.nc in one stroke, sealed with a checksum over all of it
/// (io/files/seal.hpp); the folder is made if needed. \throws IoError
void write_member(const std::filesystem::path& folder, const MemberResult& member,
                  const MemberOrigin& origin = {});

/// Reads everything back, bit for bit, after a look at the seal. \throws IoError naming the file
/// when it is damaged
MemberResult read_member(const std::filesystem::path& file);

}  // namespace sturz
