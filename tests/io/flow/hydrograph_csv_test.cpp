// SPDX-License-Identifier: Apache-2.0
// A discharge over time as a table: units, and every fault with its line.
#include "io/site/flow/hydrograph_csv.hpp"

#include "tests/io/io_fixture.hpp"

#include <cmath>

namespace sturz::test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

std::string refusal(const std::string& text) {
  return message_of([&] { parse_hydrograph(text, "flood.csv"); });
}

TEST(HydrographCsv, ReadsColumnsInAnyOrderWithTheirUnits) {
  const Hydrograph h = parse_hydrograph(
      "\xEF\xBB\xBF# gauge at the bridge\r\ndischarge_l_s, \"time_min\",solid_fraction\r\n\r\n"
      "0,0,0.5\r\n2500,1,0.55\r\n# falling\n0,3,0.4\n",
      "flood.csv");
  EXPECT_THAT(h.time_s, ElementsAre(0, 60, 180));
  EXPECT_THAT(h.discharge_m3_s, ElementsAre(0, 2.5, 0));
  EXPECT_THAT(h.solid_fraction, ElementsAre(0.5, 0.55, 0.4));
  EXPECT_NEAR(h.total_m3(), 0.5 * 2.5 * 180, 1e-12);
}

TEST(HydrographCsv, NamesEveryFaultInOneRound) {
  const std::string text =
      refusal("time_s,discharge_m3_s\n0,1\n10,two\n20,-3\n20,4\n15,5,6\n1e8,1\n30,nan\n");
  EXPECT_THAT(text,
              HasSubstr("flood.csv:3: 'two' in column discharge_m3_s is not a finite number"));
  EXPECT_THAT(text, HasSubstr("flood.csv:4: discharge = -3 m3/s (must be in 0.."));
  EXPECT_THAT(text,
              HasSubstr("flood.csv:5: time = 20 s is not after that of the row before, 20 s"));
  EXPECT_THAT(text, HasSubstr("flood.csv:6: 3 cells for 2 columns"));
  EXPECT_THAT(text, HasSubstr("flood.csv:7: time = 1e+08 s (must be in 0..1e+07"));
  EXPECT_THAT(text, HasSubstr("flood.csv:8: 'nan' in column discharge_m3_s"));
}

TEST(HydrographCsv, SaysWhatAHeaderLacks) {
  EXPECT_THAT(refusal("time_s,dischrge_m3_s\n0,1\n"),
              AllOf(HasSubstr("flood.csv:1: column 'dischrge_m3_s' is not known. Did you mean "
                              "discharge_m3_s?"),
                    HasSubstr("no column discharge_m3_s"), Not(HasSubstr("flood.csv:2"))));
  EXPECT_THAT(refusal("time,discharge_m3_s\n0,1\n"), HasSubstr("Did you mean time_"));
  EXPECT_THAT(refusal("time_s;discharge_m3_s\n0;1\n"), HasSubstr("separated by ';'"));
  EXPECT_THAT(refusal("time_s,time_h,discharge_m3_s\n0,0,1\n"), HasSubstr("another column"));
  EXPECT_THAT(refusal(""), HasSubstr("is empty"));
  EXPECT_THAT(refusal("0,1\n1,2\n"), HasSubstr("column '0' is not known"));
}

TEST(HydrographCsv, RefusesWhatBringsNothing) {
  EXPECT_THAT(refusal("time_s,discharge_m3_s\n0,1\n"), HasSubstr("fewer than two rows"));
  EXPECT_THAT(refusal("time_s,discharge_m3_s\n0,0\n9,0\n"), HasSubstr("brings no volume"));
  EXPECT_THAT(refusal("time_s,discharge_m3_s\n0,1e-300\n9,0\n"), HasSubstr("brings no volume"));
  EXPECT_THAT(refusal("time_s,discharge_m3_s,solid_fraction\n0,1,0.5\n9,1,55\n"),
              HasSubstr("flood.csv:3: solid_fraction = 55 (must be in 0.05..0.85"));
  EXPECT_THAT(refusal(std::string("time_s,discharge_m3_s\n0,\0001\n", 27)),
              HasSubstr("flood.csv:2"));
}

}  // namespace
}  // namespace sturz::test
