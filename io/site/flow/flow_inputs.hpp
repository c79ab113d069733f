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

struct FlowRead {
  std::vector<InflowSource> inflow;  ///< of those without a problem
  std::vector<Gauge> points, lines;
  std::vector<FlowFile> files;        ///< hydrographs and layers
  std::vector<std::string> problems;  ///< naming key and file; of a hydrograph each with its line
};
/// \param terrain an empty grid: the terrain could not be read, only files are checked
FlowRead read_flow(const Scenario&, const Grid& terrain);

/// Of a scene whose mass only enters over time: nothing, on the cells where it does.
Raster<double> empty_release(const std::vector<InflowSource>&, const Grid& terrain);

}  // namespace sturz
