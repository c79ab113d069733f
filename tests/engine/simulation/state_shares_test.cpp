// SPDX-License-Identifier: Apache-2.0
#include "engine/simulation/state_shares.hpp"

#include "engine/effects/dense/settings.hpp"
#include "engine/effects/fields.hpp"
#include "engine/laws/grain_states.hpp"
#include "engine/simulation/member_result.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace sturz {
namespace {

/// Four grains of 1, 2, 3 and 4 kg in the four states.
MovingSet four_grains() {
  MovingSet p;
  p.grow(4);
  p.mass = {1, 2, 3, 4};
  p.add(fields::density_change).component[0] = {0.01, -0.019, -0.5, -0.99};
  p.add(fields::state).value = {static_cast<std::uint8_t>(GrainState::dense),
                                static_cast<std::uint8_t>(GrainState::transition),
                                static_cast<std::uint8_t>(GrainState::dilute),
                                static_cast<std::uint8_t>(GrainState::ultradilute)};
  p.add(fields::granular_temperature).component[0] = {0, 0.5, 2, 0};
  return p;
}

StateShares shares_of(const MovingSet& set) { return state_shares({&set, 1}); }

TEST(StateShares, AreSharesOfTheMassOfAllSets) {
  const MovingSet sets[] = {four_grains(), four_grains()};
  const StateShares both = state_shares(sets);
  EXPECT_DOUBLE_EQ(both.dilute, 0.3);
  MovingSet dense = four_grains();
  dense.flags(fields::state).assign(4, static_cast<std::uint8_t>(GrainState::dense));
  const MovingSet half_dense[] = {four_grains(), dense};
  EXPECT_DOUBLE_EQ(state_shares(half_dense).dense, 0.55);
}

TEST(StateShares, AreSharesOfTheMass) {
  const StateShares s = shares_of(four_grains());
  EXPECT_DOUBLE_EQ(s.dense, 0.1);
  EXPECT_DOUBLE_EQ(s.transition, 0.2);
  EXPECT_DOUBLE_EQ(s.dilute, 0.3);
  EXPECT_DOUBLE_EQ(s.ultradilute, 0.4);
  EXPECT_DOUBLE_EQ(s.dilated, 0.7);
  EXPECT_DOUBLE_EQ(s.mean_theta, 0.7);
  EXPECT_DOUBLE_EQ(s.max_theta, 2);
}

TEST(StateShares, PartAtTheStrainThatTheStressLawKnows) {
  EXPECT_EQ(dilated_density_change, GrainStressSettings::separation_threshold);
}

TEST(StateShares, AreNotMadeUpWhereNothingIsKnown) {
  MovingSet columns;
  columns.grow(2);
  columns.mass = {1, 1};
  const StateShares none = shares_of(columns);
  EXPECT_TRUE(std::isnan(none.dilated));
  EXPECT_EQ(none.dense + none.transition + none.dilute + none.ultradilute, 0);
  MovingSet empty = four_grains();
  empty.compact(std::vector<std::uint8_t>{0, 0, 0, 0});
  EXPECT_EQ(shares_of(empty).dilated, 0);
}

TEST(StateTimes, WeighSharesByHowLongTheyHeld) {
  StateTimes times;
  StateShares s;
  times.add(s, 0);
  s.dilated = 0.5, s.dilute = 0.2, s.ultradilute = 0.1, s.transition = 0.3;
  times.add(s, 1);
  s.dilated = 0.1, s.dilute = 0, s.ultradilute = 0, s.transition = 0;
  times.add(s, 3);
  MemberScalars m;
  times.write(m);
  EXPECT_DOUBLE_EQ(m.parted_fraction, 0.2);
  EXPECT_DOUBLE_EQ(m.dilute_fraction, 0.05);
  EXPECT_DOUBLE_EQ(m.ultradilute_fraction, 0.025);
  EXPECT_DOUBLE_EQ(m.transition_fraction, 0.075);
}

TEST(StateTimes, OfNoTimeAreWhatThereIsNow) {
  StateTimes times;
  StateShares s;
  s.dilated = 0.25;
  times.add(s, 0);
  MemberScalars m;
  times.write(m);
  EXPECT_EQ(m.parted_fraction, 0.25);
}

}  // namespace
}  // namespace sturz
