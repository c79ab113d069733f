// SPDX-License-Identifier: Apache-2.0
#include "engine/effects/erosion/effect.hpp"

#include "engine/core/error.hpp"
#include "engine/effects/erosion/shared.hpp"
#include "engine/effects/fields.hpp"

namespace sturz {

std::size_t erosion_bytes_per_particle() {
  return sizeof(Appetite) + 3 * sizeof(double);  // and the two of the origin's shift
}

void add_erosion(Step& step, State& state, std::size_t set, const ErosionSettings& settings) {
  MovingSet& p = state.sets[set];
  expect(p.has(fields::thickness) && p.has(fields::ground), "erosion follows the columns");
  expect(settings.bed_density > 0 && !settings.bed.empty() && settings.cells.n_cells() > 0,
         "the bed is known");
  p.add(fields::entrained_mass);
  begin_lags(p);
  state.bed_supply.emplace(settings.cells, settings.source, state.domain.x.active,
                           state.domain.y.active);
  const auto erosion = std::make_shared<Erosion>(set, settings);
  add_taking(step, erosion);
  add_mixing(step, erosion);
}

}  // namespace sturz
