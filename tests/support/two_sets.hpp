// SPDX-License-Identifier: Apache-2.0
/// A scene of two particle sets: dry grains of two sizes that fall past each other onto level
/// ground.
#pragma once

#include "engine/simulation/simulation.hpp"
#include "tests/support/hand_made.hpp"

#include <array>
#include <string>
#include <vector>

namespace sturz::test {

/// A box of grains on a cubic lattice.
struct GrainBox {
  std::string name;
  double spacing = 1, density = 1500;
  Vec3 corner{0, 0, 0};
  std::array<int, 3> n{4, 4, 4};
  Vec3 velocity{0, 0, 0};
};

/// Coarse grains that fall from above and fine ones thrown up through them.
std::vector<GrainBox> coarse_and_fine();

/// Each box as a particle set of its own: grain stress, gravity, ground, motion.
/// \param exchange  drag between the sets [1/s]; 0: they do not know of each other, no pairs across
HandMade sets_of(const std::vector<GrainBox>&, int threads = 1, double exchange = 0);

/// The same with the bookkeeping of a run. \param apart  maps of each set besides
Simulation simulation_of(HandMade, double end_time_s, bool apart = false);

}  // namespace sturz::test
