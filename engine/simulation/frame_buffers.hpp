// SPDX-License-Identifier: Apache-2.0
/// The particles of one instant as they are drawn.
#pragma once

#include "engine/simulation/simulation.hpp"

#include <vector>

namespace sturz {

struct State;

/// Holds what a frame derives from the fields, between frames.
class FrameBuffers {
 public:
  /// Of one particle set. Spans are valid until the next step or frame.
  ParticleFrame frame(const State&, std::size_t set);

 private:
  std::vector<double> density_, pressure_, solid_fraction_, state_;
};

}  // namespace sturz
