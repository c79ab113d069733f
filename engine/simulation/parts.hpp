// SPDX-License-Identifier: Apache-2.0
/// What assemble puts together for one member.
#pragma once

#include "engine/effects/state.hpp"
#include "engine/effects/step.hpp"
#include "engine/simulation/peak_maps.hpp"
#include "engine/simulation/stop_rule.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace sturz {

struct SimulationParts {
  State state;
  Step step;
  PeakMaps peaks;
  StopRule stop;

  std::int64_t member = 0;
  double spacing_m = 1;
  std::string formulation = "full_stress";
  double reference_density = 1;     ///< of the bulk [kg/m^3]
  double reference_fraction = 0.6;  ///< solid fraction of that bulk [-]
  double least_dt_s = 0;            ///< below it the member has diverged
  double release_layers = 0;
  double release_volume_m3 = 0;
  double release_x_m = 0, release_y_m = 0;  ///< centre of mass
  double release_top_m = 0;                 ///< highest release elevation
  std::string warnings = {};
  std::vector<double> start_x = {}, start_y = {};  ///< [n_created], by particle id
};

}  // namespace sturz
