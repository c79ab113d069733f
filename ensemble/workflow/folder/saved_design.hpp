// SPDX-License-Identifier: Apache-2.0
/// The design of an ensemble, drawn once; from then on the saved table is the truth.
#pragma once

#include "ensemble/sampling/design.hpp"
#include "ensemble/workflow/folder/manifest.hpp"
#include "ensemble/workflow/folder/output_folder.hpp"

namespace sturz::workflow {

/// Draws the design, or reads the user's table when the scenario says `design: table`.
DesignTable new_design(const Scenario&);

/// Uncertain keys that a posterior as `ensemble.table` says nothing of: each is drawn from its own
/// distribution. Empty for any other design. \throws SetupError
std::vector<std::string> keys_from_prior(const Scenario&);

/// Rows of the user's table, whether members use them or not. \throws SetupError
std::int64_t rows_of_table(const Scenario&);

/// The table of the folder, once it is known to be the one that was saved: its hash stands in the
/// manifest, its keys and values fit the scenario.
/// \throws SetupError when it is missing, damaged or was edited, naming row and key
DesignTable saved_design(const OutputFolder&, const Manifest&, const Scenario&);

/// The folder's table, grown to `wanted` when that asks for more members and the larger table
/// begins with the saved rows bit by bit.
/// \throws SetupError when it asks for fewer members or the design cannot grow
DesignTable continued_design(const OutputFolder&, const Manifest&, const Scenario&,
                             const DesignTable& wanted);

}  // namespace sturz::workflow
