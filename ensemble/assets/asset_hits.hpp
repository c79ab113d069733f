// SPDX-License-Identifier: Apache-2.0
/// Which members hit which assets, and how hard.
#pragma once

#include "engine/core/cancel.hpp"
#include "engine/simulation/member_parts.hpp"
#include "scenarios/assets/assets.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sturz {

/// One member at one asset that it hit: the largest over the asset's cells that the member reached,
/// each by itself, and its earliest arrival there. SI.
struct AssetHit {
  std::size_t member = 0;  ///< place among the valid members
  float arrival_s = 0;
  float thickness_m = 0, speed_m_s = 0, energy_j_m2 = 0, pressure_pa = 0;

  /// \pre the layer is one of these four
  float peak(PeakLayer layer) const {
    switch (layer) {
      case PeakLayer::speed:
        return speed_m_s;
      case PeakLayer::energy:
        return energy_j_m2;
      case PeakLayer::pressure:
        return pressure_pa;
      default:
        return thickness_m;
    }
  }
};

struct AssetHits {
  std::vector<std::int64_t> members;      ///< numbers of the valid members, rising
  std::vector<Censoring> censoring;       ///< of each of them
  std::vector<std::vector<AssetHit>> of;  ///< [asset], by rising member; members without a hit miss
};

/// A member hits an asset when it reached a cell that the asset touches, as probability_of_reach
/// has it. The smoothing's tail beyond the last column, which is thick but not reached, counts
/// nowhere. Reads the members one by one, around the assets only.
/// \pre the assets' cells are those of source.grid(). \throws Cancelled
AssetHits find_hits(const MemberParts& source, const Assets&, CancelFlag cancel = {});

}  // namespace sturz
