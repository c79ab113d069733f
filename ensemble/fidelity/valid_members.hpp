// SPDX-License-Identifier: Apache-2.0
/// Members of several ensembles by their number.
#pragma once

#include "engine/simulation/member_parts.hpp"

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace sturz {

using ByNumber = std::map<std::int64_t, const MemberSummary*>;

/// The valid ones; they live as long as the source.
ByNumber valid_members(const MemberParts& source);
/// Numbers of the members that all of them have, ascending. \pre at least one source
std::vector<std::int64_t> common_members(std::span<const ByNumber> sources);
/// \throws std::logic_error for a name that scalar_table() does not have
const ScalarInfo& scalar_named(const std::string& name);
/// A finite number, and the member's end lets one know it.
bool is_known(const MemberSummary& m, double MemberScalars::*field);

}  // namespace sturz
