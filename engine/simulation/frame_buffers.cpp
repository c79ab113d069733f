// SPDX-License-Identifier: Apache-2.0
#include "engine/simulation/frame_buffers.hpp"

#include "engine/simulation/parts.hpp"

namespace sturz {

ParticleFrame FrameBuffers::frame(const SimulationParts& parts) {
  const State& s = parts.state;
  const ParticleSet& p = s.grains;
  density_.assign(p.size(), parts.reference_density);
  pressure_.assign(p.size(), 0);
  if (const Field* thickness = p.find_field("thickness")) {
    const auto& g_n = p.find_field("normal_gravity")->component[0];
    for (std::size_t i = 0; i < p.size(); ++i)
      pressure_[i] = density_[i] * g_n[i] * thickness->component[0][i];  // at the base
  }
  if (const Field* stress = p.find_field("stress")) {
    const auto& compression = p.find_field("compression")->component[0];
    solid_fraction_.assign(p.size(), parts.reference_fraction);
    for (std::size_t i = 0; i < p.size(); ++i) {
      density_[i] *= 1 + compression[i];
      solid_fraction_[i] *= 1 + compression[i];
      pressure_[i] =
          -(stress->component[0][i] + stress->component[1][i] + stress->component[2][i]) / 3;
    }
  }
  ParticleFrame f{s.time, p.x,    p.y,      p.z,       p.vx, p.vy,
                  p.vz,   p.mass, density_, pressure_, p.id, solid_fraction_,
                  {},     {}};
  if (const Field* state = p.find_field("state")) f.state = state->component[0];
  if (const Field* theta = p.find_field("granular_temperature"))
    f.granular_temperature = theta->component[0];
  return f;
}

}  // namespace sturz
