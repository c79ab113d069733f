// SPDX-License-Identifier: Apache-2.0
#include "scenarios/schema/suggest.hpp"

#include <algorithm>
#include <cstddef>

namespace sturz {

int edit_distance(const std::string& a, const std::string& b) {
  const std::size_t n = b.size() + 1;
  std::vector<int> before(n), last(n), now(n);
  for (std::size_t j = 0; j < n; ++j) last[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    now[0] = static_cast<int>(i);
    for (std::size_t j = 1; j < n; ++j) {
      const bool same = a[i - 1] == b[j - 1];
      now[j] = std::min({last[j] + 1, now[j - 1] + 1, last[j - 1] + (same ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        now[j] = std::min(now[j], before[j - 2] + 1);
    }
    before.swap(last);
    last.swap(now);
  }
  return last[n - 1];
}

std::string nearest_name(const std::string& word, const std::vector<std::string>& candidates) {
  if (word.size() > 64) return {};  // no slip of the pen; keeps the table small
  std::string best;
  int best_distance = std::max(2, static_cast<int>(word.size()) / 3) + 1;
  for (const auto& candidate : candidates) {
    const int d = edit_distance(word, candidate);
    const bool mostly_other = d >= static_cast<int>(std::max(word.size(), candidate.size()));
    if (d < best_distance && !mostly_other) {
      best_distance = d;
      best = candidate;
    }
  }
  return best;
}

}  // namespace sturz
