// SPDX-License-Identifier: Apache-2.0
#include "reports/figures/posterior_figures.hpp"
#include "reports/page/report.hpp"
#include "reports/page/sections/sections.hpp"
#include "tests/reports/made_up_results.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace sturz {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

PosteriorShown found() {
  PosteriorShown p;
  p.origin = "By emulator, from 40 members";
  p.rows = {{"basal.friction_coefficient", "basal.pore_pressure_ratio"}, {"1", "1"}, {}};
  for (int i = 0; i < 50; ++i) p.rows.rows.push_back({0.3 + 0.001 * i, 0.2 + 0.002 * i});
  p.keys = {{{0.2, 0.3, 0.4}, {0.3, 0.325, 0.35}, 0.8},
            {{0.02, 0.15, 0.28}, {0.2, 0.25, 0.3}, 0.4}};
  p.quantities = {{"runout_m", "m", 770, {700, 760, 820}, true, {600, 750, 900}},
                  {"<b>", "1", 2, {1, 2, 3}, false, {}}};
  p.reliability = {{0.5, 1.0}, {0.9, 1.0}};
  p.ridges = {"Ridge: friction & pore pressure"};
  p.warnings = {"rough <bounds>"};
  return p;
}

TEST(PosteriorSection, HoldsBeforeAfterPairsAndWhatWasHeldOut) {
  const auto results = testing::make_up_results();
  ReportInput input = results.ensemble_input();
  EXPECT_EQ(posterior_html(input), "");
  const PosteriorShown p = found();
  input.posterior = &p;
  const std::string html = posterior_html(input);
  EXPECT_THAT(html, AllOf(HasSubstr("By emulator, from 40 members"), HasSubstr("80\u00A0%"),
                          HasSubstr("<th scope=\"row\">runout [m]</th>"),
                          HasSubstr("760 (700 \u2013 820)"), HasSubstr("750 (600 \u2013 900)"),
                          HasSubstr("pore pressure ratio against friction coefficient")));
  EXPECT_THAT(html, AllOf(HasSubstr("friction &amp; pore"), HasSubstr("&lt;bounds&gt;"),
                          HasSubstr("&lt;b&gt;"), Not(HasSubstr("style="))));
  EXPECT_THAT(make_report(input), HasSubstr("<a href=\"#posterior\">Calibration</a>"));
}

TEST(PosteriorSection, TellsBestFitEmulatorsAndDiscrepancy) {
  const auto results = testing::make_up_results();
  ReportInput input = results.ensemble_input();
  PosteriorShown p = found();
  p.discrepancy_scale = 0.1;
  p.discrepancies = {{"runout_m", 0.062, 0.01, 0.17}};
  input.posterior = &p;
  const std::string weighed = posterior_html(input);
  EXPECT_THAT(weighed, AllOf(Not(HasSubstr("best fit")), Not(HasSubstr("Q2")),
                             HasSubstr("prior scale 10\u00A0% of"),
                             HasSubstr("runout 6\u00A0% (1\u00A0% \u2013 17\u00A0%)")));
  p.keys[0].best = 0.317;
  p.keys[1].best = 0.22;
  p.quantities[0].best_expected = 768;
  p.quantities[0].best_member = 751;
  p.quantities[0].q2 = 0.934;
  p.quantities[0].has_step = true;
  p.quantities[1].best_expected = 1.9;
  p.quantities[1].best_computed = "not known";
  p.quantities[1].ends_at_zero = true;
  const std::string html = posterior_html(input);
  EXPECT_THAT(html, AllOf(HasSubstr(">0.317<"), HasSubstr("768; member 751"),
                          HasSubstr("1.9; member not known"), HasSubstr("0.93 (two sides)"),
                          HasSubstr("none gives what lies between"),
                          HasSubstr("A predicted 0 is the least"), Not(HasSubstr("nan"))));
  p.discrepancy_scale = 0;
  EXPECT_THAT(posterior_html(input), HasSubstr("none was allowed"));
}

/// Pascals are stored, kilopascals are what the label says.
TEST(PosteriorSection, ShowsNumbersAndAxesInTheUnitOfTheirLabel) {
  const auto results = testing::make_up_results();
  ReportInput input = results.ensemble_input();
  PosteriorShown p = found();
  p.rows = {{"basal.cohesion_pa", "basal.turbulence_m_s2"}, {"Pa", "m s-2"}, {}};
  for (int i = 0; i < 50; ++i) p.rows.rows.push_back({2000 + 40.0 * i, 400 + 8.0 * i});
  p.keys = {{{1000, 3000, 5000}, {2000, 2500, 3960}, 0.5}, {{200, 500, 800}, {400, 600, 792}, 0.2}};
  p.quantities = {{"pressure_pa", "Pa", 30000, {20000, 31000, 41000}, true, {10000, 32000, 52000}}};
  input.samples = {p.rows.columns, p.rows.units, {{1000, 200}, {5000, 800}}};
  input.posterior = &p;
  const std::string html = posterior_html(input);
  EXPECT_THAT(html, AllOf(HasSubstr("[kPa]"), HasSubstr("3 (1 \u2013 5)"),
                          HasSubstr("2.5 (2 \u2013 3.96)"), HasSubstr(">30<"),
                          HasSubstr("31 (20 \u2013 41)"), HasSubstr("32 (10 \u2013 52)")));
  EXPECT_THAT(html, AllOf(HasSubstr(">5</text>"), HasSubstr(">800</text>"), Not(HasSubstr("5000")),
                          Not(HasSubstr("5\u202F000")), Not(HasSubstr("5\u00A0000"))));
}

TEST(PosteriorFigures, DrawWhatThereIsAndNothingOfNothing) {
  const std::vector<double> none, one{3, 3, 3}, some{1, 2, NAN, 4}, more{1.5, 2.5};
  EXPECT_EQ(marginal_svg(none, none, "x"), "");
  EXPECT_EQ(marginal_svg(one, one, "x"), "");  // no axis to draw on
  EXPECT_THAT(marginal_svg(some, more, "x"), AllOf(HasSubstr("<svg"), Not(HasSubstr("nan"))));
  EXPECT_EQ(pair_svg(some, one, more, one, "x", "y"), "");
  const std::string dots = pair_svg(some, some, more, more, "x", "y");
  EXPECT_THAT(dots, AllOf(HasSubstr("<circle"), Not(HasSubstr("nan"))));
}

/// Numbers beside the axis end where it begins, and none begins left of the picture.
TEST(PosteriorFigures, LeaveRoomForLongNumbersBesideTheAxis) {
  const std::vector<double> x{0.1, 0.2}, large{1234567, 89012345}, small{-0.000123, 0.000456};
  const auto axis = [](const std::string& svg) {
    const std::size_t at = svg.find("<path d=\"M") + 10;
    return std::stod(svg.substr(at));
  };
  const double short_numbers = axis(pair_svg(x, x, x, x, "x", "y"));
  EXPECT_GT(axis(pair_svg(x, large, x, large, "x", "y")), short_numbers + 10);
  EXPECT_GT(axis(pair_svg(x, small, x, small, "x", "y")), short_numbers + 5);
  for (const auto& y : {large, small}) {
    const std::string svg = pair_svg(x, y, x, y, "x", "y");
    const double room = axis(svg) - 4;
    EXPECT_GE(room, 6 * 9);  // nine characters of 11 px
    EXPECT_THAT(svg, HasSubstr(fmt::format("<text x=\"{:.1f}\"", room)));
  }
}

}  // namespace
}  // namespace sturz
