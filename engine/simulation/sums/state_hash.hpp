// SPDX-License-Identifier: Apache-2.0
/// A number that differs where any bit of a state does that decides what comes next.
#pragma once

#include "engine/core/hash.hpp"
#include "engine/effects/fields.hpp"
#include "engine/effects/state.hpp"

#include <cstdint>
#include <span>

namespace sturz {

inline std::uint64_t hash_of(const State& state) {
  Hash64 hash;
  for (const MovingSet& p : state.sets) {
    for (const auto* column : {&p.x, &p.y, &p.z, &p.vx, &p.vy, &p.vz, &p.mass})
      hash.add(std::span<const double>(*column));
    hash.add(std::span<const std::uint32_t>(p.id));
    for (const FieldKey* key : {&fields::solid_fraction, &fields::excess_pressure})
      if (const Field* f = p.find(*key)) hash.add(std::span<const double>(f->component[0]));
    for (const FieldKey& key : fields::excess_profile)
      if (const Field* f = p.find(key))
        for (const auto& node : f->component) hash.add(std::span<const double>(node));
  }
  if (state.bed_supply)
    state.bed_supply->visit_eroded(
        [&](int row, int col, double depth) { hash.add(row).add(col).add(depth); });
  return hash.value();
}

}  // namespace sturz
