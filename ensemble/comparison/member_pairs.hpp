// SPDX-License-Identifier: Apache-2.0
/// Members of two ensembles that drew the same: pairs.
#pragma once

#include "engine/simulation/member_parts.hpp"
#include "ensemble/sampling/design.hpp"

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace sturz {

inline constexpr std::size_t no_pair = std::numeric_limits<std::size_t>::max();

/// Two members are a pair when they have the same number and are both valid.
struct MemberPairs {
  std::size_t n = 0;                  ///< pairs
  std::size_t n_a = 0, n_b = 0;       ///< valid members of each ensemble
  std::vector<std::size_t> of_valid;  ///< pair of each valid member, first those of A, then of B,
                                      ///< by rising number; no_pair where it has no partner
};

MemberPairs find_pairs(const MemberParts& a, const MemberParts& b);
/// The same members without partners.
MemberPairs without_pairs(const MemberParts& a, const MemberParts& b);

/// Why members of the same number are no pairs: another seed, or another value of a key that both
/// drew, with the first member that shows it. Empty where they are. Keys that only one of them drew
/// do not matter: a dam's height, say.
std::string why_no_pairs(const DesignTable& a, const DesignTable& b);

}  // namespace sturz
