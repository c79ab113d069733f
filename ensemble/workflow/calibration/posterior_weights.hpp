// SPDX-License-Identifier: Apache-2.0
/// The weights that a calibration gave to the members of an ensemble, read back.
#pragma once

#include "engine/simulation/member_result.hpp"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace sturz::workflow {

/// Under so many effective members a weighted map is hardly more than that of its heaviest ones.
inline constexpr double least_effective_of_maps = 20;

/// Weights of the valid ones of `members`, in their order, adding up to 1.
/// \param calibration folder that `sturz calibrate` wrote
/// \param of hash of the ensemble whose members these are, as members_hash()
/// \throws SetupError when it holds no weights, those of other members, or a damaged file
std::vector<double> posterior_weights(const std::filesystem::path& calibration,
                                      const std::string& of,
                                      std::span<const MemberSummary> members);

}  // namespace sturz::workflow
