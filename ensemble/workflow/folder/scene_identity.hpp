// SPDX-License-Identifier: Apache-2.0
/// When two scenes, and two members, are the same: what was computed from what.
#pragma once

#include "ensemble/sampling/design.hpp"
#include "ensemble/workflow/folder/manifest.hpp"
#include "ensemble/workflow/folder/output_folder.hpp"
#include "scenarios/input_identity.hpp"
#include "scenarios/scenario.hpp"
#include "scenarios/schema/schema.hpp"

#include <string>
#include <vector>

namespace sturz::workflow {

/// False for keys whose value no member depends on, so that a begun ensemble may go on with another
/// one: title, thresholds and quantiles of the maps, what was observed, assets, accepted shares,
/// the number of members, the wall-time limit (a member that ran into it is failed, and
/// `--retry-failed` computes it again), what is read first of a raster, and the names of files
/// (what was read of them counts instead).
bool changes_members(const KeyInfo&);

/// Each difference between two scenes that changes what a member computes, as "key: old -> new".
std::vector<std::string> differences(const Scenario& before, const Scenario& now);

/// Each difference that only changes what is made of the members: thresholds, titles, what was
/// observed. The number of members and limits of time are none.
std::vector<std::string> differences_of_maps(const Scenario& before, const Scenario& now);

/// \param inputs what was read of today's files; what the folder's members read besides is read
///   again, see changed_inputs()
/// \throws SetupError with every difference when the folder was begun with another scene or other
///   input files
void require_same_scene(const OutputFolder&, const Scenario& now,
                        const std::vector<InputIdentity>& inputs);

/// \throws SetupError when the folder's scenario.yaml is not the one its members are computed from
///   any more (thresholds, titles and the like may change)
void require_own_scenario(const OutputFolder&, const Manifest&, const Scenario& in_folder);

/// "sha256:..." of all keys that change members.
std::string scenario_hash(const Scenario&);

/// "sha256:..." of that and of what was read of the inputs.
std::string scene_hash(const Scenario&, const std::vector<InputIdentity>& inputs);

/// "sha256:..." of the scene and of what is drawn for one of its members: keys and values of its
/// row, to the last bit. A run without a design has none.
std::string member_hash(const std::string& scene_hash, const DesignTable&, std::int64_t member);
std::string member_hash(const std::string& scene_hash);

/// "sha256:..." of keys, units, rows and how they were drawn.
std::string design_hash(const DesignTable&);

}  // namespace sturz::workflow
