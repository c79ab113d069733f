// SPDX-License-Identifier: Apache-2.0
/// Bytes that a member keeps per particle while it runs.
#pragma once

#include "engine/simulation/parts.hpp"

namespace sturz::bench {

struct MemoryPerParticle {
  double set = 0;     ///< the particle set: base columns and the effects' fields
  double passes = 0;  ///< what the passes say that they hold: lists, records, results
  double state = 0;   ///< accelerations, ground and wall support, flags
  double total() const { return set + passes + state; }
};

/// \pre at least one step was made: lists exist from then on
MemoryPerParticle memory_per_particle(const State&, const Step&);

}  // namespace sturz::bench
