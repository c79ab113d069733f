// SPDX-License-Identifier: Apache-2.0
/// Where the deposit of a collapse ends.
#pragma once

#include "engine/particles/particle_set.hpp"

#include <cstddef>
#include <vector>

namespace sturz::test {

/// The particles that the heap at the axis reaches, each within `link` of the next; the others have
/// separated. Images across a period are not looked at.
/// \return  by index, 1 for those of the heap
std::vector<char> heap_of(const ParticleSet&, double link);

/// How far the heap reaches: in every sector the outer edge (centre + dx/2) of its farthest
/// particle, the mean over all sectors that have one. Experiments measure to the last grains that
/// touch each other; here particles touch within 1.5 dx, about the diagonal of a cell. Nothing is
/// extrapolated: where the deposit is thinner than a particle there is none.
/// reach_along_x has strips of width dx across y, reach_along_r `n_sectors` of the full circle.
/// \return  from the axis, in the unit of dx
double reach_along_x(const ParticleSet&, double dx);
double reach_along_r(const ParticleSet&, double dx, int n_sectors);

/// Outermost place where the thickness, linear between the slices' middles, falls to
/// max(dx/2, 5 cm), docs/physics.md C.5.
/// \param thickness  means over rings or slices of width dx, from the axis outwards [m]
double contour(const std::vector<double>& thickness, double dx);

/// Adds to slice k, making room for it.
void add_to_slice(std::vector<double>& thickness, std::size_t k, double share);

}  // namespace sturz::test
