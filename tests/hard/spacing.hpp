// SPDX-License-Identifier: Apache-2.0
/// How the particles of a mass lie to each other: closest pair, connected pieces, local shear.
#pragma once

#include "engine/simulation/parts.hpp"

#include <vector>

namespace sturz::test {

/// Smallest distance of two particles, periodic images included [dx].
double closest_pair(const SimulationParts&);

/// Sets of particles that are connected by steps of at most `link` dx.
/// \return sizes, largest first
std::vector<std::size_t> pieces(const SimulationParts&, double link);

/// Neighbours of every particle within `radius` dx, images included: offset to each [m].
struct Neighbor {
  std::size_t index;
  double dx, dy, dz;
};
std::vector<std::vector<Neighbor>> neighbors_within(const SimulationParts&, double radius);

}  // namespace sturz::test
