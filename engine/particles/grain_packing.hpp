// SPDX-License-Identifier: Apache-2.0
/// A release set down as grains one by one: a close-packed lattice, opened, shaken and of uneven
/// sizes.
#pragma once

#include "engine/particles/release.hpp"

namespace sturz {

struct GrainPacking {
  double diameter_m = 1;        ///< of the mean volume
  double density_kg_m3 = 2600;  ///< of the grain material
  double solid_fraction = 0.6;  ///< of the release, as its mass follows from its volume
  double size_spread = 0.1;     ///< diameters lie evenly within 1 +- this
  double jitter = 0.05;         ///< of the lattice, in its own spacings, each direction
  std::uint64_t seed = 1;       ///< Philox key
  std::int64_t member = 0;      ///< Philox counter, with the place on the lattice
};

/// The densest fill that grains are set down at: that of a random packing, spheres of 1 +- 0.1.
inline constexpr double densest_fill = 0.6;

/// Number of grains that a bulk volume holds.
double grains_in(double volume_m3, const GrainPacking&);

/// Replaces the particles of a release by grains whose masses add up to its mass to round-off.
///
/// Lattice points above the bed are filled from the lowest part of the local thickness up, until
/// all grains have a place: so their number is right on ragged ground, too. A release denser than
/// `densest_fill` stands higher by as much as it is looser (0.70: by a sixth). Neighbours may
/// overlap by the jitter and their sizes; the contacts carry nothing of that.
/// \param thickness vertical [m], as the release was made with
/// \throws SetupError when it holds more than 2e9 grains or less than one, or they find no place
void pack_grains(const Terrain& bed, const Raster<double>& thickness, const GrainPacking&,
                 Release&);

}  // namespace sturz
