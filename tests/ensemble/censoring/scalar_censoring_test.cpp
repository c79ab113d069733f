// SPDX-License-Identifier: Apache-2.0
#include "ensemble/censoring/scalar_censoring.hpp"

#include <gtest/gtest.h>

namespace sturz {
namespace {

TEST(ScalarCensoring, HasTheScalarsOfEveryFileInTheirOrder) {
  const auto scalars = scalar_table();
  const auto rows = scalar_censoring();
  ASSERT_EQ(rows.size(), scalars.size());
  for (std::size_t i = 0; i < rows.size(); ++i)
    EXPECT_TRUE(rows[i].field == scalars[i].field) << scalars[i].name;
}

TEST(ScalarCensoring, TellsWhatOnlyGrowsFromWhatMayGoEitherWay) {
  using M = MemberScalars;
  EXPECT_EQ(known(&M::runout_m, Censoring::none), Known::exactly);
  EXPECT_EQ(known(&M::runout_m, Censoring::left_terrain), Known::at_least);
  EXPECT_EQ(known(&M::runout_m, Censoring::still_moving), Known::at_least);
  EXPECT_EQ(known(&M::deposit_area_m2, Censoring::left_terrain), Known::at_least);
  EXPECT_EQ(known(&M::deposit_area_m2, Censoring::still_moving), Known::not_at_all);
  EXPECT_EQ(known(&M::deposit_area_m2, Censoring::left_and_moving), Known::not_at_all);
  EXPECT_EQ(known(&M::com_travel_m, Censoring::left_terrain), Known::not_at_all);
  EXPECT_EQ(known(&M::max_speed_m_s, Censoring::left_terrain), Known::at_least);
  EXPECT_EQ(known(&M::release_volume_m3, Censoring::left_and_moving), Known::exactly);
  EXPECT_EQ(known(&M::lost_fraction, Censoring::still_moving), Known::at_least);
}

/// Only slurry left: what is said of grains stands, what is said of both does not.
TEST(ScalarCensoring, CutsEachMaterialOffByWhatLeftOfItAlone) {
  using M = MemberScalars;
  M m;
  m.solid_lost_fraction = 0, m.liquid_lost_fraction = 0.2;
  const auto says = [&](double M::*field, Censoring c) { return known(field, m, c); };
  EXPECT_EQ(says(&M::solid_runout_m, Censoring::left_terrain), Known::exactly);
  EXPECT_EQ(says(&M::solid_reached_area_m2, Censoring::left_terrain), Known::exactly);
  EXPECT_EQ(says(&M::liquid_runout_m, Censoring::left_terrain), Known::at_least);
  EXPECT_EQ(says(&M::runout_m, Censoring::left_terrain), Known::at_least);
  EXPECT_EQ(says(&M::solid_runout_m, Censoring::left_and_moving), Known::at_least)
      << "it still moved";
  m.solid_lost_fraction = 0.01, m.liquid_lost_fraction = 0;
  EXPECT_EQ(says(&M::solid_runout_m, Censoring::left_terrain), Known::at_least);
  EXPECT_EQ(says(&M::liquid_runout_m, Censoring::left_terrain), Known::exactly);
  EXPECT_EQ(says(&M::liquid_runout_m, Censoring::none), Known::exactly);
  m.solid_lost_fraction = m.liquid_lost_fraction = nan_d;  // not told apart
  EXPECT_EQ(says(&M::runout_m, Censoring::left_terrain), Known::at_least);
}

TEST(ScalarCensoring, ObservesValidMembersOnly) {
  std::vector<MemberSummary> members(3);
  members[0].outcome = Outcome::settled;
  members[0].scalars.runout_m = 5;
  members[1].outcome = Outcome::left_terrain;
  members[1].censoring = Censoring::left_terrain;
  members[1].scalars.runout_m = 7;
  members[2].outcome = Outcome::diverged;
  const auto seen = observations(members, &MemberScalars::runout_m);
  ASSERT_EQ(seen.size(), 2U);
  EXPECT_EQ(seen[0].value, 5);
  EXPECT_EQ(seen[1].value, 7);
  EXPECT_EQ(seen[1].known, Known::at_least);
}

}  // namespace
}  // namespace sturz
