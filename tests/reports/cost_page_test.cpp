// SPDX-License-Identifier: Apache-2.0
// The page of what accuracy costs: every number in its place, nothing from outside.
#include "reports/fidelity/cost_page.hpp"

#include "reports/fidelity/error_chart.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace sturz {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

LadderAccuracy ladder() {
  LadderAccuracy l;
  l.formulation = "depth_averaged";
  l.spacings_m = {8, 4, 2};
  l.member_cpu_s = {0.02, 0.2, 2};
  l.members = {0, 1, 2};
  l.n_asked = 4;
  ResultAccuracy r;
  r.name = "runout_m";
  r.units = "m";
  r.n_members = 3;
  r.refinement = refine(l.spacings_m, {{118}, {114}, {112}}, 1);
  r.member_rms = {6, 2, 0};
  r.member_errors = ErrorCurve(l.spacings_m, {8.2, 4.1, 2.02});
  l.results.push_back(r);
  MapAccuracy map;
  map.threshold_m = 0.5;
  map.distances.resize(3);
  map.errors = ErrorCurve(l.spacings_m, {0.4, 0.2, 0.1});
  l.maps.push_back(map);
  return l;
}

TEST(CostPage, ShowsErrorsChoiceAndParts) {
  const LadderAccuracy l = ladder();
  CostPage page;
  page.title = "Slope <A>";
  page.planned = "512 planned members";
  page.ladders.push_back({&l, {"Within 5 %: 4 m."}, {{"runout_m", 0.01, 0.02, nan_d}}});
  page.warnings = {"thin & flow"};
  const std::string html = make_cost_page(page);
  EXPECT_THAT(html, HasSubstr("Slope &lt;A&gt;"));
  EXPECT_THAT(html, HasSubstr("Within 5 %: 4 m."));
  EXPECT_THAT(html, HasSubstr("thin &amp; flow"));
  EXPECT_THAT(html, HasSubstr("3 of 4 members"));
  EXPECT_THAT(html, HasSubstr("512 planned members"));
  // Shares of 112.
  for (const char* cell : {"7.3\u00A0%", "3.7\u00A0%", "1.8\u00A0%", "40\u00A0%"})
    EXPECT_THAT(html, HasSubstr(cell));
  EXPECT_THAT(html, Not(HasSubstr("Checked by")));
  EXPECT_THAT(html, HasSubstr("script-src 'none'"));
  EXPECT_THAT(html, Not(HasSubstr("http:")));
  EXPECT_THAT(html, Not(HasSubstr("<script")));
}

TEST(CostPage, ShowsWhatWasSaidBesideWhatWasFound) {
  LadderAccuracy l = ladder();
  l.held_out_m = 1;
  CheckedError c;
  c.name = "runout_m";
  c.spacing_m = 2;
  c.said = 0.034, c.found = 0.02, c.noise = 0;
  l.checked.push_back(c);
  CostPage page;
  page.ladders.push_back({&l, {}, {}});
  const std::string html = make_cost_page(page);
  for (const char* words : {"Checked by members at 1", "3.4\u00A0%", "1.7</td>", ">yes<"})
    EXPECT_THAT(html, HasSubstr(words));
  l.checked.front().found = nan_d;  // no member reaches it: no prediction was missed
  const std::string untold = make_cost_page(page);
  EXPECT_THAT(untold, Not(HasSubstr(">no<")));
  EXPECT_THAT(untold, Not(HasSubstr("nan")));
}

TEST(ErrorChart, PutsPowersOfTenWhereTheyBelong) {
  const std::vector<ErrorLine> lines{
      {"a", "front", {0.02, 0.2, 2}, {0.4, 0.04, nan_d}, {"8", "4", "2"}}};
  const ErrorAxes axes = axes_for(lines);
  EXPECT_DOUBLE_EQ(axes.least_s, 0.01);
  EXPECT_NEAR(axes.most_s, 1, 1e-12);  // the point without an error has no place
  EXPECT_NEAR(axes.least_error, 0.01, 1e-15);
  EXPECT_NEAR(axes.most_error, 1, 1e-12);
  const std::string svg = error_chart_svg("x", lines, axes, 0.05);
  std::size_t dots = 0;
  for (std::size_t at = svg.find("<circle"); at != std::string::npos;
       at = svg.find("<circle", at + 1))
    ++dots;
  EXPECT_EQ(dots, 2U);
  EXPECT_THAT(svg, HasSubstr("class=\"wanted\""));
  EXPECT_THAT(error_chart_svg("x", lines, axes, 0), Not(HasSubstr("class=\"wanted\"")));
}

TEST(ErrorChart, OnePointHasAxesToo) {
  const ErrorAxes axes = axes_for({{"a", "front", {1}, {0.1}, {"8"}}});
  EXPECT_GT(axes.most_s, axes.least_s);
  EXPECT_GT(axes.most_error, axes.least_error);
  EXPECT_GT(axes_for({}).most_s, 0);
}

}  // namespace
}  // namespace sturz
