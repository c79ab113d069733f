// SPDX-License-Identifier: Apache-2.0
/// The maps of an ensemble as one netCDF file, made as its members pass by.
#pragma once

#include "ensemble/hazard/hazard_map.hpp"
#include "ensemble/sampling/design.hpp"
#include "ensemble/workflow/folder/manifest.hpp"
#include "io/members/member_store.hpp"
#include "scenarios/scenario.hpp"

#include <filesystem>
#include <string>

namespace sturz::workflow {

/// What the file says of where its maps come from.
HazardContext hazard_context(const Manifest&, const Scenario&, const DesignTable&);

/// \return the maps' hash \throws IoError; Cancelled, and leaves nothing half-written
std::string write_hazard(const std::filesystem::path& file, const MemberStore&, const HazardSpec&,
                         const HazardContext&);

}  // namespace sturz::workflow
