// SPDX-License-Identifier: Apache-2.0
/// Alternating pairs in one process: the core's speed drifts, the ratio of neighbours in time does
/// not.
#pragma once

#include "tests/bench/measure/statistics.hpp"

#include <vector>

namespace sturz::bench {

struct Pairs {
  std::vector<double> a, b;  ///< seconds
  Summary ratio() const { return summarize(ratios(a, b)); }
};

/// Takes `n` pairs after one that is discarded; the first of the two alternates.
/// \param a,b  functions that do a slice of work and return its seconds
template <class A, class B>
Pairs alternate(int n, A&& a, B&& b) {
  a(), b();
  Pairs pairs;
  for (int k = 0; k < n; ++k) {
    if (k % 2 == 0) pairs.a.push_back(a());
    pairs.b.push_back(b());
    if (k % 2 == 1) pairs.a.push_back(a());
  }
  return pairs;
}

}  // namespace sturz::bench
