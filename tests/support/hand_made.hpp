// SPDX-License-Identifier: Apache-2.0
/// States and steps built by hand: the engine's own effects on a small even ground.
#pragma once

#include "engine/effects/bed/effect.hpp"
#include "engine/effects/columns/effect.hpp"
#include "engine/effects/dense/effect.hpp"
#include "engine/effects/motion/effect.hpp"
#include "engine/effects/motion/gravity.hpp"
#include "engine/effects/state.hpp"
#include "engine/effects/step.hpp"

#include <array>
#include <vector>

namespace sturz::test {

/// Even ground of n x n cells of 1 m around the origin that falls by `slope` per metre eastward.
Terrain even_ground(int n, double slope = 0, NodataRule rule = NodataRule::outflow);

struct HandMade {
  State state;
  Step step;

  /// One step at the limit of the passes; \return its length [s]
  double advance();
};

/// Particles of mass 1560 kg on a cubic lattice of 1 m, the lowest layer 0.5 m above z = 0.
std::vector<Vec3> block(std::array<int, 3> n, const Vec3& south_west_corner = {0, 0, 0});

/// Grains with stress, gravity, contact and motion on `ground`; dx = 1 m.
HandMade grains_on(Terrain ground, const std::vector<Vec3>& positions, const Vec3& velocity,
                   const Domain& domain = {}, double friction = 0.4);

/// Particles without stress: gravity, contact and motion alone.
HandMade particles_on(Terrain ground, const std::vector<Vec3>& positions, const Vec3& velocity,
                      const Domain& domain = {}, double friction = 0.4);

/// The same with a bed of its own in each zone.
HandMade particles_on_zones(Terrain ground, const std::vector<Vec3>& positions,
                            const Vec3& velocity, const Domain& domain,
                            std::vector<GroundFriction> bed, ZoneMap zones);

/// The same with numbers of rasters over the bed.
HandMade particles_on_rasters(Terrain ground, const std::vector<Vec3>& positions,
                              const Vec3& velocity, std::vector<GroundFriction> bed,
                              BedRasters rasters);

/// Depth-averaged columns of density 1560 kg/m^3 on a lattice of 1 m (z of the positions does not
/// count), each with the vertical `thickness` [m].
HandMade columns_on(Terrain ground, const std::vector<Vec3>& positions, double thickness,
                    const Vec3& velocity, const Domain& domain = {},
                    DepthAveragedSettings settings = {});

}  // namespace sturz::test
