// SPDX-License-Identifier: Apache-2.0
/// What the members of an ensemble say together, before any of them is computed.
#pragma once

#include "ensemble/sampling/design.hpp"
#include "ensemble/workflow/scene.hpp"

#include <string>
#include <vector>

namespace sturz::workflow {

/// Nothing uncertain; a distribution of a key without effect; rows of the table that are not used;
/// and what is true at the ends of what was drawn although not at the medians: releases that are
/// too thin, members that nothing brakes, formulations that change from member to member.
std::vector<std::string> ensemble_warnings(const Scene&, const DesignTable&);

}  // namespace sturz::workflow
