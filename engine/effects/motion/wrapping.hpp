// SPDX-License-Identifier: Apache-2.0
/// Periodic positions, brought back before neighbours are sorted.
#pragma once

#include "engine/effects/state.hpp"

namespace sturz {

/// Brings particles back into the periodic box and keeps what that takes off their travel.
inline void wrap_particles(const Domain& domain, MovingSet& p) {
  if (p.wrapped_x.empty()) return;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double x = p.x[i], y = p.y[i];
    domain.wrap(p.x[i], p.y[i], p.z[i]);
    p.wrapped_x[p.id[i]] += x - p.x[i];
    p.wrapped_y[p.id[i]] += y - p.y[i];
  }
}

}  // namespace sturz
