// SPDX-License-Identifier: Apache-2.0
#include "engine/effects/coupling/effect.hpp"

#include "engine/core/error.hpp"
#include "engine/effects/coupling/shared.hpp"
#include "engine/effects/fields.hpp"

#include <algorithm>
#include <memory>

namespace sturz {

void add_coupling_fields(State& state, std::size_t liquid) {
  state.sets[liquid].add(fields::grain_share);
  state.sets[liquid].add(fields::slip_divergence);
}

void add_coupling(Step& step, State& state, std::size_t grains, std::size_t liquid,
                  const CouplingSettings& settings) {
  for (const std::size_t set : {grains, liquid})
    expect(state.sets[set].has(fields::velocity_before),
           "grains and liquid have the velocity before the step when their coupling is added");
  expect(state.sets[liquid].has(fields::grain_share), "add_coupling_fields comes first");
  state.sets[grains].add(fields::exchange_velocity);
  const auto shared = std::make_shared<Coupling>(grains, liquid, settings);
  // Until the first step has looked: as the grains were set down.
  const double packed =
      std::clamp(state.sets[grains].reference_fraction, 0.0, CouplingSettings::largest_fraction());
  shared->largest_share = packed / (1 - packed);
  add_shares(step, shared);
  add_exchange(step, shared);
}

std::size_t coupling_bytes_per_particle() {
  // A support of 74 neighbours, half as many again in the skin: candidates, and those that have a
  // weight; one side has gradients. Half of the particles lie beside ground or a wall.
  const std::size_t pairs = 105 * (4 + 4 + 4) + 105 * 4 / 2;
  const std::size_t images = (105 * (4 + 4) + 105 * 4 / 2) / 2;
  return pairs + images + sizeof(MetLiquid) + 4 * sizeof(Vec3) + 160;
}

}  // namespace sturz
