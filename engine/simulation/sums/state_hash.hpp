// SPDX-License-Identifier: Apache-2.0
/// A number that differs where any bit of a state does that decides what comes next.
#pragma once

#include "engine/core/error.hpp"
#include "engine/core/hash.hpp"
#include "engine/effects/fields.hpp"
#include "engine/effects/state.hpp"

#include <cstddef>
#include <cstdint>
#include <span>

namespace sturz {

namespace all_of_a_set {
using namespace fields;
inline constexpr const FieldKey* numbers[] = {&velocity_before,
                                              &density_change,
                                              &stress,
                                              &viscous_ratio,
                                              &density_gradient,
                                              &ground_weight,
                                              &packing_change,
                                              &support_completeness,
                                              &granular_temperature,
                                              &kinetic_stress,
                                              &spin,
                                              &grain_acceleration,
                                              &grain_share,
                                              &slip_divergence,
                                              &exchange_velocity,
                                              &thickness,
                                              &support_radius,
                                              &area_share,
                                              &normal_gravity,
                                              &centripetal_momentum,
                                              &ground,
                                              &earth_pressure,
                                              &solids_volume,
                                              &water_volume,
                                              &solid_fraction,
                                              &excess_pressure,
                                              &pore_pressure,
                                              &pore_gravity,
                                              &excess_profile[0],
                                              &excess_profile[1],
                                              &excess_profile[2],
                                              &excess_profile[3],
                                              &excess_profile[4],
                                              &excess_profile[5],
                                              &entrained_mass};
inline constexpr const FlagKey* flags[] = {&fields::state, &steps_alone, &membership};
}  // namespace all_of_a_set

/// All of a set: places, velocities, masses, ids and every field and flag of its effects; the sound
/// speed, which follows the flow. \throws std::logic_error where a set has a field that no list
/// above names
inline void add_set(Hash64& hash, const MovingSet& p) {
  for (const auto* column : {&p.x, &p.y, &p.z, &p.vx, &p.vy, &p.vz, &p.mass})
    hash.add(std::span<const double>(*column));
  hash.add(std::span<const std::uint32_t>(p.id));
  std::size_t found = 0;
  for (const FieldKey* key : all_of_a_set::numbers)
    if (const Field* f = p.find(*key)) {
      ++found;
      for (const auto& column : f->component) hash.add(std::span<const double>(column));
    }
  for (const FlagKey* key : all_of_a_set::flags)
    if (const Flags* f = p.find(*key)) {
      ++found;
      hash.add(std::span<const std::uint8_t>(f->value));
    }
  expect(found == p.field_names().size(), "the hash of a state knows every field");
  hash.add(p.sound_speed);
}

inline std::uint64_t hash_of(const State& state) {
  Hash64 hash;
  for (const MovingSet& p : state.sets) add_set(hash, p);
  if (state.bed_supply)
    state.bed_supply->visit_eroded(
        [&](int row, int col, double depth) { hash.add(row).add(col).add(depth); });
  return hash.value();
}

}  // namespace sturz
