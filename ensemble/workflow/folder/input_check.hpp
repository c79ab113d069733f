// SPDX-License-Identifier: Apache-2.0
/// Whether the files of a scene still hold what results were made from.
#pragma once

#include "scenarios/input_identity.hpp"
#include "scenarios/scenario.hpp"

#include <string>
#include <vector>

namespace sturz::workflow {

/// The inputs that members are computed from: without what is only drawn over the maps.
std::vector<InputIdentity> of_members(std::vector<InputIdentity> inputs);

/// What differs between the inputs that results were made from and those of today, one sentence for
/// each input. Every part of the terrain that `before` names is compared: what `now` has not read
/// of it is read from today's file, these blocks alone.
/// \param now what was read today of the files that the scenario names
/// \throws SetupError when the raster cannot be read (any more)
std::vector<std::string> changed_inputs(const Scenario&, std::vector<InputIdentity> now,
                                        const std::vector<InputIdentity>& before);

/// The sentences, one a line, each indented.
std::string as_lines(const std::vector<std::string>& sentences);

}  // namespace sturz::workflow
