// SPDX-License-Identifier: Apache-2.0
/// When an ensemble has enough members: at the first of some fixed member counts at which no
/// probability of its map, or that of one asset, is less sure than was asked for
/// (docs/decisions/0036).
#pragma once

#include "ensemble/stopping/arrival_counts.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace sturz {

/// Members between two looks, at the beginning.
inline constexpr std::int64_t least_batch = 32;

/// Member counts at which a growing ensemble is looked at: every 32 members up to 512, from there
/// eight times until the number has doubled, and `at_most`, the last. They follow from it alone,
/// not from workers or time.
std::vector<std::int64_t> look_counts(std::int64_t at_most);

/// What one look saw.
struct Look {
  std::int64_t n_members = 0;  ///< so many first members of the design
  LargestHalfWidth found;
};

/// Where a stop rule stands: asked for, last look, how many there were. Looks follow from the
/// members alone, so an interrupted ensemble that goes on has the same.
struct StopRecord {
  double wanted_half_width = 0;
  std::int64_t at_most = 0;  ///< members
  std::string asset;         ///< name of the one that is looked at; empty: the map
  std::int64_t n_looks = 0;
  Look last;

  bool reached() const { return last.found.half_width <= wanted_half_width; }  ///< no for NaN
};

/// Members after which every probability is that sure, the least sure of all, 1/2, too; of an asset
/// where none is cut off before it hits.
std::int64_t certain_count(double half_width);

/// The look at which the rule will probably stop: half widths fall as one over the square root of
/// the number of members. Without a look yet, where it is certain to.
/// \param looks as look_counts() gives them
std::int64_t expected_count(const StopRecord&, const std::vector<std::int64_t>& looks);

/// "the largest half width of P(reached) is 0.0987, wanted is 0.1, in 214 cells with 0.05 < P <
/// 0.95; 96 members, 96 of them valid; look 3; 256 members at most". Of an asset "the half width of
/// P(hit) of house is 0.0987, wanted is 0.1; 96 members, ..."
std::string stop_text(const StopRecord&);
/// "214 cells with 0.05 < P < 0.95", or what was looked at instead.
std::string looked_at_text(const LargestHalfWidth&);
const char* to_string(LookedAt);

}  // namespace sturz
