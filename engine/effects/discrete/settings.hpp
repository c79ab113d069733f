// SPDX-License-Identifier: Apache-2.0
/// Numbers of a mass that is computed grain by grain.
#pragma once

#include "engine/effects/bed_rasters.hpp"
#include "engine/laws/basal_resistance.hpp"
#include "engine/laws/hertz_mindlin.hpp"
#include "engine/terrain/zone_map.hpp"

#include <algorithm>
#include <optional>
#include <vector>

namespace sturz {

struct DiscreteSettings {
  double diameter = 1;            ///< of the mean grain [m]
  GrainMaterial material;         ///< as it acts, softened: see `softened_grains`
  double restitution = 0.5;       ///< between grains [-]
  double friction = 0.5;          ///< mu_c between grains [-]
  double rolling_friction = 0.1;  ///< between grains: moment over R* F_n at most [-]
  double bed_restitution = 0.2;   ///< of ground and walls [-]
  /// On ground and walls; absent: as large as their friction, so that a grain does not roll where
  /// a mass would not slide.
  std::optional<double> bed_rolling_friction;
  std::vector<BasalResistance> bed{1};  ///< by zone, [0] where there is none; Coulomb part only
  ZoneMap zones;
  BedRasters rasters;  ///< over the ground of the zones
};

/// The grains' material with E lowered to what a scene needs: an impact at `speed` overlaps by at
/// most `share` of the radius, and the weight of `load` on a grain by a tenth of that.
/// With 4/3 E* sqrt(R/2) delta^(3/2) = p (2R)^2 weight needs E* = 3 sqrt(2) p (share/10)^(-3/2).
/// \param speed  [m/s]  \param load  [Pa]
inline GrainMaterial softened_grains(const GrainMaterial& material, double speed, double load,
                                     double share) {
  const double in_impact = softest_modulus(material.density, speed, share);
  const double at_rest = 4.2426 * load / std::pow(0.1 * share, 1.5);
  return softened(material, std::max(in_impact, at_rest));
}

/// The step that resolves an impact of two mean grains, or of one on the ground, at `speed`.
double grain_time_step(const DiscreteSettings&, double speed);

}  // namespace sturz
