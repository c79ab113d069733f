// SPDX-License-Identifier: Apache-2.0
#include "ensemble/comparison/member_pairs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>

namespace sturz {
namespace {

std::vector<std::int64_t> valid_numbers(const MemberParts& members) {
  std::vector<std::int64_t> numbers;
  for (const MemberSummary& m : members.members())
    if (is_valid(m.outcome)) numbers.push_back(m.member);
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

}  // namespace

MemberPairs find_pairs(const MemberParts& a, const MemberParts& b) {
  MemberPairs pairs = without_pairs(a, b);
  const auto of_a = valid_numbers(a), of_b = valid_numbers(b);
  for (std::size_t i = 0; i < of_a.size(); ++i) {
    const auto partner = std::lower_bound(of_b.begin(), of_b.end(), of_a[i]);
    if (partner == of_b.end() || *partner != of_a[i]) continue;
    pairs.of_valid[i] = pairs.n;
    pairs.of_valid[of_a.size() + static_cast<std::size_t>(partner - of_b.begin())] = pairs.n++;
  }
  return pairs;
}

MemberPairs without_pairs(const MemberParts& a, const MemberParts& b) {
  MemberPairs pairs;
  pairs.n_a = valid_numbers(a).size();
  pairs.n_b = valid_numbers(b).size();
  pairs.of_valid.assign(pairs.n_a + pairs.n_b, no_pair);
  return pairs;
}

std::string why_no_pairs(const DesignTable& a, const DesignTable& b) {
  if (a.seed != b.seed) return fmt::format("ensemble.seed is {} and {}", a.seed, b.seed);
  const std::size_t n = std::min(a.values.size(), b.values.size());
  std::size_t shared = 0;
  for (std::size_t k = 0; k < a.keys.size(); ++k) {
    const auto found = std::find(b.keys.begin(), b.keys.end(), a.keys[k]);
    if (found == b.keys.end()) continue;
    ++shared;
    const auto other = static_cast<std::size_t>(found - b.keys.begin());
    for (std::size_t m = 0; m < n; ++m)
      if (a.values[m][k] != b.values[m][other])
        return fmt::format("{} of member {} is {:.10g} and {:.10g}", a.keys[k], m, a.values[m][k],
                           b.values[m][other]);
  }
  if (shared == 0 && !a.keys.empty() && !b.keys.empty()) return "they share no uncertain value";
  return {};
}

}  // namespace sturz
