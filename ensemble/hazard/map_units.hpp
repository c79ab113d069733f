// SPDX-License-Identifier: Apache-2.0
/// The units of maps: those in which the scenario asks for its thresholds. Members are SI.
#pragma once

#include "engine/simulation/member_result.hpp"

namespace sturz {

struct MapUnit {
  const char* name;   ///< UDUNITS text
  double per_si = 1;  ///< a value of a member times this is the map's
};

inline MapUnit map_unit(PeakLayer layer) {
  switch (layer) {
    case PeakLayer::energy:
    case PeakLayer::solid_energy:
    case PeakLayer::liquid_energy:
      return {"kJ m-2", 1e-3};
    case PeakLayer::pressure:
    case PeakLayer::solid_pressure:
    case PeakLayer::liquid_pressure:
      return {"kPa", 1e-3};
    default:
      return {info(layer).units, 1};
  }
}

}  // namespace sturz
