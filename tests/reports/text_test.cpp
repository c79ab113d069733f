// SPDX-License-Identifier: Apache-2.0
#include "reports/page/text.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace sturz {
namespace {

TEST(ReportText, EscapesMarkup) {
  EXPECT_EQ(html_escape("a<b>&\"'"), "a&lt;b&gt;&amp;&quot;&#39;");
}

TEST(ReportText, LeavesNoLessThanSignInsideScripts) {
  const std::string safe = script_safe(R"({"x":"</script><!--"})");
  EXPECT_EQ(safe.find('<'), std::string::npos);
  EXPECT_EQ(safe, R"({"x":"\u003c/script>\u003c!--"})");
}

TEST(ReportText, RoundsToSignificantDigits) {
  EXPECT_EQ(shown_number(0.123456), "0.123");
  EXPECT_EQ(shown_number(2.0), "2");
  EXPECT_EQ(shown_number(1234.5), "1234");
  EXPECT_EQ(shown_number(1234567), "1\u202F234\u202F567");
  EXPECT_EQ(shown_number(-0.5), "\u22120.5");
  EXPECT_EQ(shown_number(0), "0");
  EXPECT_EQ(shown_number(0.0999999), "0.1");
  EXPECT_EQ(shown_number(std::numeric_limits<double>::quiet_NaN()), "\u2013");
  EXPECT_EQ(shown_number(1e-9), "1.00\u00A0\u00D7\u00A010\u207B\u2079");
}

TEST(ReportText, NeverRoundsAChanceToNothingOrCertainty) {
  EXPECT_EQ(percent_text(0), "0\u00A0%");
  EXPECT_EQ(percent_text(0.004), "<\u00A01\u00A0%");
  EXPECT_EQ(percent_text(0.996), ">\u00A099\u00A0%");
  EXPECT_EQ(percent_text(1), "100\u00A0%");
  EXPECT_EQ(percent_text(0.47), "47\u00A0%");
}

TEST(ReportText, WritesDurationsInTheUnitThatReadsBest) {
  EXPECT_EQ(duration_text(4.25), "4.2 s");
  EXPECT_EQ(duration_text(48), "48 s");
  EXPECT_EQ(duration_text(725), "12 min 5 s");
  EXPECT_EQ(duration_text(12000), "3 h 20 min");
  EXPECT_EQ(duration_text(200000), "2 d 7 h");
  EXPECT_EQ(duration_text(-1), "\u2013");
}

TEST(ReportText, ShowsEngineersUnits) {
  EXPECT_EQ(with_unit(1.5e6, "J m-2"), "1500\u00A0kJ/m²");
  EXPECT_EQ(with_unit(100, "kJ m-2"), "100\u00A0kJ/m²");
  EXPECT_EQ(with_unit(30000, "Pa"), "30\u00A0kPa");
  EXPECT_EQ(with_unit(0.5, "1"), "0.5");
  EXPECT_EQ(with_unit(3, "furlong"), "3\u00A0furlong");
  EXPECT_EQ(area_text(4.2e5), "42\u00A0ha");
  EXPECT_EQ(area_text(7e4, 2.5e6), "0.07\u00A0\u2013\u00A02.5\u00A0km²");
  EXPECT_EQ(area_text(8.15e5, 1.08e6, 9.3e5), "81.5\u00A0\u2013\u00A0108\u00A0ha");
  EXPECT_EQ(shown_number(8.69e-12), "8.69\u00A0\u00D7\u00A010\u207B\u00B9\u00B2");
}

}  // namespace
}  // namespace sturz
