// SPDX-License-Identifier: Apache-2.0
// Every bit of a state is in its hash.
#include "engine/simulation/sums/state_hash.hpp"

#include "engine/effects/fields.hpp"
#include "tests/support/liquid/immersed_grains.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <stdexcept>

namespace sturz::test {
namespace {

/// Grains with a packing in a liquid: all fields that full stress and coupling bring.
HandMade scene() {
  ImmersedGrains g;
  g.spacing = 0.2;
  g.dilatancy.emplace();
  g.dilatancy->reference_fraction = g.solid_fraction;
  return immersed(g);
}

TEST(StateHash, SeesEveryFieldOfEverySet) {
  HandMade made = scene();
  const std::uint64_t first = hash_of(made.state);
  EXPECT_EQ(hash_of(scene().state), first);
  std::set<std::uint64_t> seen{first};
  const auto expect_seen = [&](double& value, const char* name) {
    const double before = value;
    value = std::nextafter(value, 1e300);
    EXPECT_TRUE(seen.insert(hash_of(made.state)).second) << name;
    value = before;
  };
  bool has_stress = false, has_packing = false;
  for (MovingSet& p : made.state.sets) {
    for (auto* column : {&p.x, &p.vz, &p.mass}) expect_seen(column->back(), "place or mass");
    expect_seen(p.sound_speed, "sound speed");
    for (const FieldKey* key : all_of_a_set::numbers) {
      Field* f = p.find(*key);
      if (!f) continue;
      has_stress |= key == &fields::stress, has_packing |= key == &fields::packing_change;
      for (auto& column : f->component) expect_seen(column.back(), key->name);
    }
  }
  EXPECT_TRUE(has_stress && has_packing);
  EXPECT_EQ(hash_of(made.state), first);
}

TEST(StateHash, DoesNotPassOverAFieldThatItDoesNotKnow) {
  static constexpr FieldKey unheard_of{"unheard_of", 1, "1", "a test"};
  HandMade made = scene();
  made.state.sets[1].add(unheard_of);
  EXPECT_THROW(hash_of(made.state), std::logic_error);
}

TEST(StateHash, SeesFlags) {
  HandMade made = scene();
  made.state.sets[0].add(fields::steps_alone);
  const std::uint64_t first = hash_of(made.state);
  made.state.sets[0].flags(fields::steps_alone)[0] = 1;
  EXPECT_NE(hash_of(made.state), first);
}

}  // namespace
}  // namespace sturz::test
