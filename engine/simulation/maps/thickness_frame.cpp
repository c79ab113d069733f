// SPDX-License-Identifier: Apache-2.0
#include "engine/simulation/maps/thickness_frame.hpp"

#include <utility>

namespace sturz {

ThicknessFrame thickness_frame(const SimulationParts& parts) {
  MemberResult now;
  PeakMaps maps(parts.peaks.settings());
  maps.finish(parts.state.sets, now);
  return {parts.state.time, now.window, std::move(now.layer(PeakLayer::deposit))};
}

}  // namespace sturz
