// SPDX-License-Identifier: Apache-2.0
#include "engine/simulation/maps/erosion_result.hpp"

#include <algorithm>

namespace sturz {

void write_erosion(const BedSupply& bed, const Ledger& ledger, MemberScalars& m) {
  m.eroded_volume_m3 = bed.eroded_volume_m3();
  m.entrained_mass_kg = ledger.entrained_mass;
  m.volume_growth = 1 + ledger.entrained_mass / (ledger.released_mass + ledger.added_mass);
  m.max_eroded_depth_m = 0;
  bed.visit_eroded([&](int, int, double depth) {
    m.max_eroded_depth_m = std::max(m.max_eroded_depth_m, depth);
  });
  const double energy = ledger.available_energy();
  m.entrainment_loss_fraction = energy > 0 ? ledger.entrainment_loss / energy : 0;
}

void write_eroded_depth(const State& s, MemberResult& result) {
  std::vector<float>& depth = result.layer(PeakLayer::eroded);
  if (s.bed_supply)
    depth = eroded_depth_on(*s.bed_supply, result.grid, result.window);
  else
    depth.clear();
}

}  // namespace sturz
