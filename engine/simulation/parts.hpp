// SPDX-License-Identifier: Apache-2.0
/// What assemble puts together for one member.
#pragma once

#include "engine/effects/state.hpp"
#include "engine/effects/step.hpp"
#include "engine/simulation/gauges/gauge_recorder.hpp"
#include "engine/simulation/peak_maps.hpp"
#include "engine/simulation/stop_rule.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace sturz {

/// What a run has to know of its release.
struct ReleaseFacts {
  double layers = 0;        ///< volume-weighted median thickness over the initial particle spacing
  double volume_m3 = 0;     ///< of the source
  double x_m = 0, y_m = 0;  ///< centre of mass
  double top_m = 0;         ///< highest elevation of a particle
  /// Highest point of the source's surface before it failed.
  double crown_x_m = 0, crown_y_m = 0, crown_z_m = 0;
};

/// What a run has to know besides its state.
struct RunFacts {
  std::int64_t member = 0;
  std::string formulation = "full_stress";
  double spacing_m = 1;   ///< the finest initial particle spacing
  double least_dt_s = 0;  ///< below it the member has diverged
  ReleaseFacts release = {};
  bool has_inflow = false;  ///< mass enters over time
  std::string warnings = {};
};

struct SimulationParts {
  State state;
  Step step;
  PeakMaps peaks;
  StopRule stop;
  RunFacts facts = {};
  std::optional<GaugeSettings> gauges = {};  ///< absent: none
};

}  // namespace sturz
