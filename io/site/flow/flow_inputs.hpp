// SPDX-License-Identifier: Apache-2.0
/// Files and places of what enters and is followed over time: `inflow`, `gauges`.
#pragma once

#include "scenarios/scenario.hpp"
#include "scenarios/scene_inputs.hpp"

#include <string>
#include <vector>

namespace sturz {

/// What was read of one file, as SceneInputs wants it.
struct FlowFile {
  std::vector<std::string> notes, warnings;
  InputIdentity identity;
};

struct InflowRead {
  InflowSource source;
  std::vector<FlowFile> files;  ///< the hydrograph, and the layer where there is one
};
/// \param terrain an empty grid: the terrain could not be read, only files are checked
/// \throws SetupError naming key and file; the faults of a hydrograph each with its line
InflowRead read_inflow_source(const Scenario&, std::size_t source, const Grid& terrain);

struct GaugesRead {
  std::vector<Gauge> points, lines;
  std::vector<FlowFile> files;
};
/// \pre the scene has gauges
GaugesRead read_gauges(const Scenario&, const Grid& terrain);

}  // namespace sturz
