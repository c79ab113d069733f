// SPDX-License-Identifier: Apache-2.0
/// What a pass may touch: the particle sets, the ground and the clock.
#pragma once

#include "engine/core/constants.hpp"
#include "engine/core/domain.hpp"
#include "engine/effects/moving_set.hpp"
#include "engine/terrain/bed_supply.hpp"
#include "engine/terrain/terrain.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace sturz {

/// The scene: what its particle sets share.
struct State {
  /// Grains first. Passes know their set by its index here; no set is added after assembly.
  std::vector<MovingSet> sets = std::vector<MovingSet>(1);
  Terrain terrain;
  std::optional<BedSupply> bed_supply;  ///< where the flow takes its bed along
  Domain domain;
  double gravity = standard_gravity;  ///< along -z [m/s^2]
  double time = 0;                    ///< [s]
  double previous_dt = 0;             ///< of the last step [s]; 0 before the first
  std::size_t n_steps = 0;
  int threads = 1;

  State(Terrain ground, Domain bounds) : terrain(std::move(ground)), domain(std::move(bounds)) {}

  MovingSet& grains() { return sets.front(); }
  const MovingSet& grains() const { return sets.front(); }
  std::size_t n_particles() const {
    std::size_t n = 0;
    for (const MovingSet& set : sets) n += set.size();
    return n;
  }
  double max_speed() const {
    double v = 0;
    for (const MovingSet& set : sets) v = std::max(v, set.motion.max_speed);
    return v;
  }
  /// The accounts of all sets together.
  Ledger ledger() const {
    Ledger total = sets.front().ledger;
    for (std::size_t k = 1; k < sets.size(); ++k) total += sets[k].ledger;
    return total;
  }

  /// Whether the move stage removes particle i: beyond a domain boundary that lets mass out,
  /// underground, or taken by an effect.
  bool leaves(const MovingSet& set, std::size_t i) const {
    const Fate fate = set.fate[i];
    return fate != Fate::stays &&
           (fate != Fate::off_terrain || terrain.nodata_rule() == NodataRule::outflow);
  }
  /// Factor that extrapolates the last change of velocity to v_{n+1/2}; see predicted_velocity.
  double extrapolation(double dt) const { return previous_dt > 0 ? dt / previous_dt : 0; }
};

}  // namespace sturz
