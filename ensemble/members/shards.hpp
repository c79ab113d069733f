// SPDX-License-Identifier: Apache-2.0
/// Which members fall to which machine, and in which order they start.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace sturz {

/// Members of shard k of n (k counts from 1): those with member % n == k - 1, ascending. Together
/// the shards hold every member once, whatever their number.
/// \throws SetupError unless 1 <= k <= n
std::vector<std::int64_t> shard_members(std::int64_t n_members, int k, int n);

/// The members ordered by predicted cost, the longest first, so that no long one starts last and
/// keeps the others waiting. Equal costs keep their order.
/// \param predicted_s seconds of each member, same order as `members`; empty: order unchanged
std::vector<std::int64_t> longest_first(std::vector<std::int64_t> members,
                                        std::span<const double> predicted_s);

}  // namespace sturz
