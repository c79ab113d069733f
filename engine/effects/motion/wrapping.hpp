// SPDX-License-Identifier: Apache-2.0
/// Periodic positions, brought back before neighbours are sorted.
#pragma once

#include "engine/effects/state.hpp"

namespace sturz {

/// Brings particles back into the periodic box and keeps what that takes off their travel.
inline void wrap_particles(State& s) {
  ParticleSet& p = s.grains;
  if (s.wrapped_x.empty()) return;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double x = p.x[i], y = p.y[i];
    s.domain.wrap(p.x[i], p.y[i], p.z[i]);
    s.wrapped_x[p.id[i]] += x - p.x[i];
    s.wrapped_y[p.id[i]] += y - p.y[i];
  }
}

/// Makes room for that where a direction is periodic.
inline void prepare_wrapping(State& s) {
  if (!s.domain.x.active && !s.domain.y.active) return;
  s.wrapped_x.assign(s.grains.size(), 0);
  s.wrapped_y.assign(s.grains.size(), 0);
}

}  // namespace sturz
