// SPDX-License-Identifier: Apache-2.0
#include "reports/page/sections/sections.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sturz {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

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

TEST(GaugesSection, IsNotThereWithoutGauges) {
  const GaugeFindings none;
  ReportInput input;
  EXPECT_THAT(gauges_html(input), IsEmpty());
  input.gauges = &none;
  EXPECT_THAT(gauges_html(input), IsEmpty());
}

}  // namespace
}  // namespace sturz
