// SPDX-License-Identifier: Apache-2.0
/// What a finished member must warn of, judged by its own scalars.
#pragma once

#include "engine/simulation/member_result.hpp"

#include <string>

namespace sturz {

/// Above this share of mass and time in the air, columns (which cannot leave the ground) are no
/// model of what happened.
inline constexpr double much_take_off = 0.01;
/// Verified runs leave less than 0.01 of their energy unexplained.
inline constexpr double much_residual = 0.05;

/// Sentences joined by "; ", empty where there is nothing to warn of.
std::string run_warnings(const MemberScalars&);

}  // namespace sturz
