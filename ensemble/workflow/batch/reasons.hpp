// SPDX-License-Identifier: Apache-2.0
/// Why a job is computed: what differs from what is there, in words.
#pragma once

#include "ensemble/workflow/folder/manifest.hpp"
#include "scenarios/input_identity.hpp"
#include "scenarios/scenario.hpp"

#include <string>
#include <vector>

namespace sturz::workflow {

/// "program 1.2.0 -> 1.3.0", with commits where the versions are equal; empty where only this
/// program computed members there.
std::string other_program(const std::vector<Build>& builds);

/// "basal.friction_coefficient 0.3 -> 0.25" of "basal.friction_coefficient: 0.3 -> 0.25".
std::vector<std::string> changed_values(const std::vector<std::string>& differences);

/// "dem.tif changed (terrain.raster)" of the sentences of input_differences().
std::vector<std::string> changed_files(const std::vector<std::string>& sentences);

/// What is only drawn over maps or scored, of two lists of inputs.
std::vector<std::string> changed_map_inputs(const std::vector<InputIdentity>& before,
                                            const std::vector<InputIdentity>& now);

/// "a; b; c and 4 more"
std::string joined(const std::vector<std::string>& reasons);

}  // namespace sturz::workflow
