// SPDX-License-Identifier: Apache-2.0
#include "ensemble/app/console/fitted.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sturz::app {
namespace {

using ::testing::ElementsAre;

TEST(Folded, LinesThatFitAndPlacesWithoutATerminalAreLeftAlone) {
  EXPECT_EQ(folded("twelve chars", 12), "twelve chars");
  EXPECT_EQ(folded("a line of any length", 0), "a line of any length");
}

TEST(Folded, TheRestStandsUnderTheValue) {
  EXPECT_EQ(folded("  run-out   1,204 m from the crown to the front", 30),
            "  run-out   1,204 m from the\n"
            "            crown to the front");
}

TEST(Folded, WithoutAGapTheRestIsIndentedALittle) {
  EXPECT_EQ(folded("note: the polygon was reprojected to the CRS", 30),
            "note: the polygon was\n"
            "  reprojected to the CRS");
}

TEST(Folded, PathsAreNotTorn) {
  EXPECT_EQ(folded("In /a/folder/with/a/name/beyond/thirty/columns now", 30),
            "In\n  /a/folder/with/a/name/beyond/thirty/columns\n  now");
}

TEST(Folded, LettersOfTwoBytesCountOnce) {
  EXPECT_EQ(folded("äöü äöü äöü äöü äöü äöü äöü äöü", 31), "äöü äöü äöü äöü äöü äöü äöü äöü");
}

TEST(FittedTable, ColumnsThatDoNotFitComeBelow) {
  const std::vector<std::vector<std::string>> rows = {
      {"key", "prior", "posterior"}, {"friction", "0.3 [0.1 .. 0.5]", "0.2 [0.15 .. 0.25]"}};
  EXPECT_THAT(fitted_table(rows, 0), ElementsAre("key       prior             posterior",
                                                 "friction  0.3 [0.1 .. 0.5]  0.2 [0.15 .. 0.25]"));
  EXPECT_THAT(fitted_table(rows, 40),
              ElementsAre("key       prior", "friction  0.3 [0.1 .. 0.5]", "key       posterior",
                          "friction  0.2 [0.15 .. 0.25]"));
}

TEST(FittedTable, ShortRowsAndNarrowTerminalsEnd) {
  EXPECT_THAT(fitted_table({{"a", "b", "c"}, {"1"}}, 1), ElementsAre("a  b", "1", "a  c", "1"));
}

}  // namespace
}  // namespace sturz::app
