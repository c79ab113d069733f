// SPDX-License-Identifier: Apache-2.0
/// Numbers of a depth-averaged flow.
#pragma once

#include "engine/effects/bed_rasters.hpp"
#include "engine/effects/columns/mixture_settings.hpp"
#include "engine/effects/sweep/fused_sweep.hpp"
#include "engine/laws/basal_resistance.hpp"
#include "engine/laws/earth_pressure.hpp"
#include "engine/particles/column_area.hpp"
#include "engine/terrain/zone_map.hpp"

#include <optional>
#include <vector>

namespace sturz {

struct DepthAveragedSettings {
  double spacing = 1;      ///< of the columns at release, in the map [m]
  double density = 1500;   ///< bulk [kg/m^3]
  double viscosity = 0.5;  ///< Monaghan's alpha between approaching columns
  double courant = 0.25;   ///< of the wave limit and the approach limit
  /// Support radius over the mean distance of columns: about 50 neighbours.
  double radius_per_spacing = radius_per_distance;
  double least_radius = 0.5,
         most_radius = 2;  ///< bounds of the adaptive support radius over its first value
  /// K's change per strain [M]: active to passive within about a hundredth of strain (Hungr 1995).
  double earth_pressure_stiffness = 200;
  std::vector<BasalResistance> bed{1};           ///< by zone, [0] where there is none
  std::vector<EarthPressure> earth_pressure{1};  ///< by zone, as `bed`
  /// Share of the thrust that drives a column which internal friction takes, by zone: 1 - K_active
  /// (ADR 0026). Empty: none.
  std::vector<double> spent_inside;
  /// With `rasters`, in the place of the two above: K follows from the bed below each column, and
  /// so much of the thrust that internal friction would take is taken.
  bool active_passive = false;
  double spent_share = 0;
  double internal_friction = 0;  ///< tan phi of the grains, to judge deposits by; 0: unknown
  ZoneMap zones;
  BedRasters rasters;                      ///< over the beds of the zones
  std::optional<MixtureSettings> mixture;  ///< absent: a dry mass, or one with a constant ratio
  InstructionSet instruction_set = InstructionSet::plain;

  /// K of a bed below columns with this internal friction. Only the grains' part of the stress is
  /// anisotropic (Iverson & Denlinger 2001).
  EarthPressure earth_pressure_over(const BasalResistance& b) const {
    return EarthPressure(internal_friction, b.effective_friction())
        .with_pore_pressure(b.pore_pressure_ratio);
  }
};

}  // namespace sturz
