// SPDX-License-Identifier: Apache-2.0
/// Numbers of a bed that the flow takes along.
#pragma once

#include "engine/effects/bed_rasters.hpp"
#include "engine/effects/moving_set.hpp"
#include "engine/laws/basal_resistance.hpp"
#include "engine/laws/entrainment.hpp"
#include "engine/terrain/bed_supply.hpp"
#include "engine/terrain/zone_map.hpp"

#include <functional>
#include <span>
#include <vector>

namespace sturz {

struct ErosionSettings {
  Entrainment law;
  double bed_density = 1500;            ///< bulk [kg/m^3]
  std::vector<BasalResistance> bed{1};  ///< what the bed takes from the flow, by zone
  ZoneMap zones;
  BedRasters rasters;  ///< over the beds of the zones
  Grid cells;  ///< of the ground that the columns feel; one period of it where it repeats itself
  BedSource source;
  /// Told, twice a step, that each column took up this share of so much mass [kg], by storage
  /// index, and that mass and velocity are those of the whole now: where a column has more than
  /// these, what the bed brings of it enters here.
  std::function<void(MovingSet&, std::span<const double> mass, double share)> received = {};
};

}  // namespace sturz
