// SPDX-License-Identifier: Apache-2.0
/// The particles of one instant as whoever draws them wants them.
#pragma once

#include "engine/simulation/simulation.hpp"

#include <vector>

namespace sturz {

/// Holds what a frame derives from the fields, between frames.
class FrameBuffers {
 public:
  /// Spans are valid until the next step or frame.
  ParticleFrame frame(const SimulationParts& parts);

 private:
  std::vector<double> density_, pressure_, solid_fraction_;
};

}  // namespace sturz
