// SPDX-License-Identifier: Apache-2.0
#include "ensemble/censoring/rank_agreement.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace sturz {
namespace {

TEST(RankAgreement, IsKendallsTauWhereNothingIsCensored) {
  // Ranks 1 2 3 4 against 2 1 4 3: 4 pairs agree, 2 do not.
  const std::vector<double> x{1, 2, 3, 4};
  const std::vector<Observation> y{{2}, {1}, {4}, {3}};
  const RankAgreement r = rank_agreement(x, y);
  EXPECT_DOUBLE_EQ(r.tau, 2.0 / 6);
  EXPECT_EQ(r.ordered, 6);
  EXPECT_EQ(r.pairs, 6);
}

TEST(RankAgreement, UsesWhatACensoredValueStillSays) {
  // The two with the least friction ran off at 100 m and 90 m; the others stopped at 80, 60, 95 m.
  const std::vector<double> friction{0.1, 0.15, 0.2, 0.3, 0.25};
  const std::vector<Observation> runout{
      {100, Known::at_least}, {90, Known::at_least}, {80}, {60}, {95}};
  const RankAgreement r = rank_agreement(friction, runout);
  // Known: (100+, 80) (100+, 60) (100+, 95) (90+, 80) (90+, 60) and the three pairs at rest; not
  // (100+, 90+) and (90+, 95). Of the eight only (80, 95) says that friction helps.
  EXPECT_EQ(r.pairs, 10);
  EXPECT_EQ(r.ordered, 8);
  EXPECT_DOUBLE_EQ(r.tau, (1 - 7) / 8.0);
}

TEST(RankAgreement, LeavesOutTiesUnknownAndMissingValues) {
  const std::vector<double> x{1, 1, 2, nan_d, 3};
  const std::vector<Observation> y{{1}, {2}, {2}, {9}, {5, Known::not_at_all}};
  const RankAgreement r = rank_agreement(x, y);
  EXPECT_EQ(r.pairs, 5);    // of rows 0, 1, 2, 4 all but (0, 1)
  EXPECT_EQ(r.ordered, 1);  // (0, 2); (1, 2) are equal, row 4 says nothing
  EXPECT_EQ(r.tau, 1);
  EXPECT_TRUE(std::isnan(rank_agreement({}, {}).tau));
}

}  // namespace
}  // namespace sturz
