// SPDX-License-Identifier: Apache-2.0
/// How much two probabilities differ, from pairs of members and from two heaps of them.
#pragma once

#include <cstdint>

namespace sturz {

/// What pairs of members did, the first of A and the second of B.
struct PairCounts {
  std::int64_t both = 0, only_a = 0, only_b = 0, neither = 0;
  std::int64_t n() const { return both + only_a + only_b + neither; }
  std::int64_t a() const { return both + only_a; }
  std::int64_t b() const { return both + only_b; }
};

struct DifferenceBounds {
  double difference = 0;  ///< P(B) - P(A)
  double lower = 0, upper = 0;
  double width() const { return upper - lower; }
};

/// 95 % interval of P(B) - P(A) from pairs: Newcombe's method 10 (1998, Stat. Med. 17, 2635-2650),
/// the score intervals of both shares squared and added, less twice their correlation phi with its
/// continuity correction. NaN without pairs.
DifferenceBounds paired_difference(const PairCounts&);

/// The same from members that are no pairs: Newcombe's method 10 for independent samples (1998,
/// Stat. Med. 17, 873-890), phi = 0. NaN where one has no members.
DifferenceBounds unpaired_difference(std::int64_t hits_a, std::int64_t n_a, std::int64_t hits_b,
                                     std::int64_t n_b);

}  // namespace sturz
