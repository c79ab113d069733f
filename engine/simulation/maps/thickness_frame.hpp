// SPDX-License-Identifier: Apache-2.0
/// How thick the flow lies at one instant.
#pragma once

#include "engine/simulation/parts.hpp"

#include <vector>

namespace sturz {

struct ThicknessFrame {
  double time_s = 0;
  Window window;              ///< of the maps' grid; empty: no mass is on it
  std::vector<float> values;  ///< [window.n_cells()] vertical thickness [m]
};

/// Spread over the cells as the deposit is (PeakMaps): of the final state it is the deposit, bit
/// for bit. Costs as much as one record of the peaks.
ThicknessFrame thickness_frame(const SimulationParts&);

}  // namespace sturz
