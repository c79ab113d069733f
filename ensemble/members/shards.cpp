// SPDX-License-Identifier: Apache-2.0
#include "ensemble/members/shards.hpp"

#include "engine/core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace sturz {

std::vector<std::int64_t> shard_members(std::int64_t n_members, int k, int n) {
  require(n >= 1 && k >= 1 && k <= n,
          fmt::format("shard {}/{} does not exist (k/n needs 1 <= k <= n). Count shards from 1.", k,
                      n));
  std::vector<std::int64_t> members;
  for (std::int64_t m = k - 1; m < n_members; m += n) members.push_back(m);
  return members;
}

std::vector<std::int64_t> longest_first(std::vector<std::int64_t> members,
                                        std::span<const double> predicted_s) {
  if (predicted_s.empty()) return members;
  expect(predicted_s.size() == members.size(), "one predicted cost per member");
  std::vector<std::size_t> order(members.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return predicted_s[a] > predicted_s[b]; });
  std::vector<std::int64_t> sorted;
  sorted.reserve(members.size());
  for (const std::size_t i : order) sorted.push_back(members[i]);
  return sorted;
}

}  // namespace sturz
