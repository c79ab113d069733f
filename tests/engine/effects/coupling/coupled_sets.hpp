// SPDX-License-Identifier: Apache-2.0
/// Grains and liquid in three dimensions that act on each other alone: no pair forces within a set,
/// no bed; MovingSet::ax pushes them.
#pragma once

#include "engine/effects/coupling/effect.hpp"
#include "engine/effects/state.hpp"

#include <array>
#include <cstdint>

namespace sturz::test {

/// Particles on a cubic lattice.
struct Lattice {
  std::array<int, 3> n{12, 12, 12};
  double spacing = 1;
  Vec3 corner{0, 0, 0};    ///< south-west, low [m]
  double jitter = 0;       ///< largest displacement along each axis, over the spacing
  double bulk = 1500;      ///< mass over lattice volume [kg/m^3]
  Vec3 velocity{0, 0, 0};  ///< [m/s]
  double fraction = 1;     ///< MovingSet::reference_fraction
};

struct CoupledSets {
  State state;
  Step step;

  MovingSet& grains() { return state.sets[0]; }
  MovingSet& liquid() { return state.sets[1]; }
  Vec3 momentum() const;
  double kinetic() const;
};

/// \param domain  what is periodic; there is no gravity
CoupledSets coupled_sets(const Lattice& grains, const Lattice& liquid, const Domain& domain,
                         const CouplingSettings&, int threads = 1);

/// A box of n spacings, periodic along x and y.
Domain periodic_box(double length);

/// Half of grains of 2600 kg/m^3, the pores full of water, both at the same lattice.
std::array<Lattice, 2> full_pores(int n, double jitter, double solids = 0.5);

/// New storage order of a set, as its neighbour pass might give it.
void shuffle(MovingSet&, unsigned seed);

}  // namespace sturz::test
