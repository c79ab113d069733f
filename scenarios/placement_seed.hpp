// SPDX-License-Identifier: Apache-2.0
/// What the particles' places are drawn from.
#pragma once

#include "scenarios/scenario.hpp"

#include <cstdint>

namespace sturz {

/// ensemble.seed; where the source is one feature of a layer, mixed with that feature's name
/// (FNV-1a), so that features which share one table of uncertain values are not jittered alike.
inline std::uint64_t placement_seed(const Scenario& s) {
  if (s.release.feature.empty()) return s.ensemble.seed;
  std::uint64_t mixed = 14695981039346656037ULL;
  for (const char c : s.release.feature)
    mixed = (mixed ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  return s.ensemble.seed ^ mixed;
}

}  // namespace sturz
