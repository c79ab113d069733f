// SPDX-License-Identifier: Apache-2.0
// The page of a multilevel ensemble: three numbers under each mean, maps with bounds, levels.
#include "reports/fidelity/multilevel_page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace sturz {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

LayerStack maps() {
  LayerStack stack;
  stack.grid = {6, 4, 0, 40, 10, ""};
  for (const Statistic s :
       {Statistic::probability, Statistic::lower_bound, Statistic::upper_bound}) {
    const char* end = s == Statistic::probability   ? ""
                      : s == Statistic::lower_bound ? "_lower"
                                                    : "_upper";
    Layer layer =
        plain_layer(std::string("probability_of_reach").append(end), {Quantity::reached, s},
                    "probability that the flow reaches the cell", "1", "");
    layer.values.assign(stack.grid.n_cells(), 0.4F);
    stack.layers.push_back(layer);
  }
  return stack;
}

TEST(MultilevelPage, ShowsThreeNumbersUnderEachMean) {
  const LayerStack stack = maps();
  MultilevelPage page;
  page.title = "Slope <A>";
  page.sentences = {"3 minutes of one core in all."};
  page.results = {{"runout_m", "m", 812, 9.4, 9.4, 31, nan_d, {{0.5, 800, 790, 815}}}};
  page.levels = {{"full_stress_6m", true, 24, 4.5, 0.8, {0.7, 0.6}},
                 {"depth_averaged_18m", false, 16, 0.01, 0.001, {}}};
  page.maps = &stack;
  page.warnings = {"thin & flow"};
  const std::string html = make_multilevel_page(page);
  for (const char* words :
       {"Slope &lt;A&gt;", "3 minutes of one core", "run-out", "812\u00A0m", "\u00B1 9.4\u00A0m",
        "\u00B1 31\u00A0m", "unknown", "790\u00A0m", "full stress 6m", "tried, not used",
        "70\u00A0%", "thin &amp; flow", "script-src 'none'"})
    EXPECT_THAT(html, HasSubstr(words));
  // Probability, lower and upper bound.
  std::size_t figures = 0;
  for (auto at = html.find("<figure>"); at != std::string::npos; at = html.find("<figure>", at + 1))
    ++figures;
  EXPECT_EQ(figures, 3U);
  EXPECT_THAT(html, Not(HasSubstr("<script")));
  EXPECT_THAT(html, Not(HasSubstr(" style=")));
}

TEST(MultilevelPage, SaysOnWhichSideAMeanMayBeFartherOff) {
  MultilevelPage page;
  page.results = {{"runout_m", "m", 812, 4.2, 13, nan_d, nan_d, {}}};
  EXPECT_THAT(make_multilevel_page(page), HasSubstr("\u2212 4.2\u00A0m, + 13\u00A0m"));
}

TEST(MultilevelPage, SaysThatNoColourOfAnUpperBoundIsNotZero) {
  LayerStack stack = maps();
  stack.layers.back().values[3] = nan_f;
  MultilevelPage page;
  page.maps = &stack;
  page.upper_bound_note = "13 % are all that is known";
  page.results = {{"runout_m", "m", 812, 9, 9, 31, nan_d, {{0.95, 900, 850, HUGE_VAL}}}};
  const std::string html = make_multilevel_page(page);
  EXPECT_THAT(html, HasSubstr("No colour: not told, which is not 0.</strong> 13 % are all"));
  EXPECT_THAT(html, HasSubstr("above 850\u00A0m"));
}

TEST(MultilevelPage, LeavesOutWhatIsNotThere) {
  MultilevelPage page;
  page.title = "A";
  const std::string html = make_multilevel_page(page);
  EXPECT_THAT(html, Not(HasSubstr("id=\"maps\"")));
  EXPECT_THAT(html, Not(HasSubstr("Quantiles")));
}

TEST(MultilevelPage, HasATableOfAssets) {
  MultilevelPage page;
  page.title = "Slope";
  EXPECT_THAT(make_multilevel_page(page), Not(HasSubstr("<section id=\"assets\">")));
  page.exceedances = {"pressure > 30 kPa"};
  page.assets = {{"bridge <1>", {{0.4, 0.21, 0.6}, {0.1, 0, 0.3, true}}},
                 {"hut", {{0.2, 0.1, 0.5, true}, {0.05, 0, 0.3, true}}},
                 {"away", {{nan_d, nan_d, nan_d}, {nan_d, nan_d, nan_d}}}};
  const std::string html = make_multilevel_page(page);
  EXPECT_THAT(html, HasSubstr("pressure &gt; 30 kPa"));
  EXPECT_THAT(html, HasSubstr("bridge &lt;1&gt;"));
  EXPECT_THAT(html, HasSubstr("40\u00A0% (21\u00A0% \u2013 60\u00A0%)"));
  EXPECT_THAT(html, HasSubstr("\u2265 20\u00A0%"));
  EXPECT_THAT(html, HasSubstr("\u2265 10\u00A0%"));
  EXPECT_THAT(html, Not(HasSubstr("\u2265 40\u00A0%")));
  EXPECT_THAT(html, HasSubstr("not known"));
}

}  // namespace
}  // namespace sturz
