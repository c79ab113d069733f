// SPDX-License-Identifier: Apache-2.0
#include "engine/simulation/frame_buffers.hpp"

#include "engine/effects/fields.hpp"
#include "engine/effects/state.hpp"

namespace sturz {

ParticleFrame FrameBuffers::frame(const State& s, std::size_t set) {
  const MovingSet& p = s.sets[set];
  density_.assign(p.size(), p.bulk_density);
  pressure_.assign(p.size(), 0);
  solid_fraction_.clear();
  state_.clear();
  if (const Field* thickness = p.find(fields::thickness)) {
    const auto& g_n = p.scalar(fields::normal_gravity);
    for (std::size_t i = 0; i < p.size(); ++i)
      pressure_[i] = density_[i] * g_n[i] * thickness->component[0][i];  // at the bed
  }
  if (const Field* stress = p.find(fields::stress)) {
    const auto& density_change = p.scalar(fields::density_change);
    const Field* packing = p.find(fields::packing_change);  // without load
    solid_fraction_.assign(p.size(), p.reference_fraction);
    for (std::size_t i = 0; i < p.size(); ++i) {
      const double packed = packing ? 1 + packing->component[0][i] : 1;
      density_[i] *= packed * (1 + density_change[i]);
      solid_fraction_[i] *= packed * (1 + density_change[i]);
      pressure_[i] =
          -(stress->component[0][i] + stress->component[1][i] + stress->component[2][i]) / 3;
    }
  }
  // Of a liquid: the grains around it.
  if (const Field* grains = p.find(fields::grain_share))
    for (std::size_t i = 0; i < p.size(); ++i) {
      const double x = grains->component[0][i];
      solid_fraction_[i] = x / (1 + x);
    }
  ParticleFrame f{s.time, p.x,    p.y,      p.z,       p.vx, p.vy,
                  p.vz,   p.mass, density_, pressure_, p.id, solid_fraction_,
                  {},     {}};
  f.set = p.name;
  f.set_index = set;
  if (const Flags* state = p.find(fields::state)) {
    state_.assign(state->value.begin(), state->value.end());
    f.state = state_;
  }
  if (const Field* theta = p.find(fields::granular_temperature))
    f.granular_temperature = theta->component[0];
  return f;
}

}  // namespace sturz
