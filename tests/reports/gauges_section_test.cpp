// SPDX-License-Identifier: Apache-2.0
#include "reports/page/sections/sections.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace sturz {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

TEST(GaugesSection, RoundsNumbersAndKeepsWhatTheyAreKnownAs) {
  GaugeFindings gauges;
  gauges.quantiles = {0.05, 0.5, 0.95};
  gauges.rows = {{"bridge <1>", "arrival", "s", 12, 9, 2, {"52.1942", "> 120", "never"}},
                 {"bridge <1>",
                  "peak_momentum_flux",
                  "N m-1",
                  12,
                  9,
                  2,
                  {"2254.26", ">= 8970.79", "not known"}}};
  ReportInput input;
  input.gauges = &gauges;
  const std::string html = gauges_html(input);
  EXPECT_THAT(html, HasSubstr("<td>bridge &lt;1&gt;</td><td>arrival</td><td>s</td>"
                              "<td class=\"n\">9 of 12, 2 not known</td><td class=\"n\">52.2</td>"
                              "<td class=\"n\">&gt; 120</td><td class=\"n\">never</td>"));
  EXPECT_THAT(html, HasSubstr("<td>kN/m</td><td class=\"n\">9 of 12, 2 not known</td>"
                              "<td class=\"n\">2.25</td><td class=\"n\">\u2265\u00A0"
                              "8.97</td>"
                              "<td class=\"n\">not known</td>"));
}

TEST(GaugesSection, DrawsAGapWhereNothingIsKnown) {
  GaugeFindings gauges;
  gauges.quantiles = {0.5};
  gauges.rows = {{"road", "peak_discharge", "m3 s-1", 4, 4, 2, {"12"}}};
  GaugeBand band{"road", "discharge", "m3 s-1", {0, 1, 2, 3}, {4, 4, 2, 0}, {}};
  band.values = {{0, 8, 12, std::numeric_limits<double>::quiet_NaN()}};
  gauges.bands = {band};
  ReportInput input;
  input.gauges = &gauges;
  const std::string html = gauges_html(input);
  const std::size_t line = html.find("class=\"line paint-rear\" d=\"");
  ASSERT_NE(line, std::string::npos);
  const std::string path = html.substr(line, html.find("/>", line) - line);
  EXPECT_EQ(std::count(path.begin(), path.end(), 'L'), 2) << "three instants are known: " << path;
  EXPECT_THAT(path, Not(HasSubstr("nan")));
  EXPECT_THAT(html, HasSubstr("From 2 s on the lines are of fewer than all 4 simulations"));
  gauges.bands.front().members = {4, 4, 4, 4};
  gauges.bands.front().values = {{0, 8, 12, 0}};
  EXPECT_THAT(gauges_html(input), Not(HasSubstr("From ")));
}

TEST(GaugesSection, IsNotThereWithoutGauges) {
  const GaugeFindings none;
  ReportInput input;
  EXPECT_THAT(gauges_html(input), IsEmpty());
  input.gauges = &none;
  EXPECT_THAT(gauges_html(input), IsEmpty());
}

}  // namespace
}  // namespace sturz
