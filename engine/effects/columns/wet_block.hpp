// SPDX-License-Identifier: Apache-2.0
/// Columns of a mixture over one kick, a block at a time and every number an array: the same
/// arithmetic for all of them, so that the compiler puts four columns side by side.
#pragma once

#include "engine/effects/columns/mixture_settings.hpp"

#include <cstddef>

namespace sturz {

struct WetProfile;

struct WetBlock {
  static constexpr std::size_t capacity = 128;
  using Row = double[capacity];

  std::size_t n = 0;
  double time = 0;                ///< of the kick [s]
  WetProfile* profile = nullptr;  ///< of their excess pressure; null: a parabola

  // What the step gives: volumes [m^3], thickness of all along the normal [m], div v [1/s].
  alignas(64) Row mass, solids, water, thickness, normal_gravity, strain_rate;
  Row gravity_seen;            ///< normal gravity at the kick before; negative at the first [m/s^2]
  Row pull_x, pull_y, pull_z;  ///< tangent acceleration without the bed [m/s^2]
  Row friction, cohesion;      ///< tan phi of the bed [-]; [Pa]
  Row drag;  ///< g/xi, deceleration by turbulence times thickness over speed^2 [-]

  // What the kick changes.
  Row vx, vy, vz;    ///< [m/s]
  Row fraction;      ///< m [-]
  Row excess;        ///< p_e [Pa]
  Row pressure;      ///< p_b; an outcome only [Pa]
  Row clipped_work;  ///< of pressures beyond their bounds; an outcome only [J]

  /// Moves pore pressure, solid fraction and velocity on together: each decides the others within
  /// a fraction of a second, faster than columns meet each other. Second order, in parts in which
  /// the pressure changes by a twentieth of the weight.
  void slide(const MixtureSettings&);

 private:
  friend struct WetProfile;
  // Of the column over the kick.
  Row share_, stress_, per_load_, area_, permeability_, touching_;
  // Of a part: its length, thickness of grains and pores, hydrostatic pressure, and what it brings.
  Row time_, grains_, still_, speed_, change_, mean_, compaction_, decay_, steady_;

  // Of a part where a profile is resolved: thickness squeezed out over thickness, and whether the
  // pressure inside would rise.
  Row squeezed_, rising_;

  void load(const MixtureSettings&);
  void let_go();
  template <bool resolved>
  void look_ahead(const MixtureLaw&);
  template <bool resolved>
  void finish(const MixtureLaw&);
  template <bool resolved>
  void slide_loaded(const MixtureSettings&, WetProfile* inside_more);
  int parts_of(std::size_t i) const;
  void copy(std::size_t to, const WetBlock& from, std::size_t i);
  template <bool resolved>
  void slide_in_parts(const MixtureLaw&, const int* parts, const std::size_t* source);
};

}  // namespace sturz
