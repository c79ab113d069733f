// SPDX-License-Identifier: Apache-2.0
#include "engine/effects/columns/wet_bed.hpp"

#include "engine/effects/columns/mixture.hpp"
#include "engine/effects/fields.hpp"

namespace sturz {

void take_up(MovingSet& p, const MixtureLaw& law, const SaturatedBed& bed,
             std::span<const double> mass, double share) {
  const double m = bed.solid_fraction, density = law.density(m);
  const auto &solids = p.scalar(fields::solids_volume), &water = p.scalar(fields::water_volume),
             &thickness = p.scalar(fields::thickness), &g_n = p.scalar(fields::normal_gravity);
  // What its own pressure adds to that of still water, per thickness of it.
  const double per_depth =
      bed.pressure_ratio < 0 ? 0 : bed.pressure_ratio * density - law.fluid_density;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (!(mass[i] > 0)) continue;
    const double volume = share * mass[i] / density;
    const double deeper = volume / (solids[i] + water[i]) * thickness[i];
    add_to_mixture(p, i,
                   {m * volume, (1 - m) * volume, m, per_depth * g_n[i] * deeper, bed.drained});
  }
}

}  // namespace sturz
