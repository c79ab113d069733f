// SPDX-License-Identifier: Apache-2.0
// How far grains and liquid come, as lines and words of the page.
#include "reports/figures/figures.hpp"
#include "reports/layer_titles.hpp"
#include "reports/page/report.hpp"
#include "tests/reports/made_up_results.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

bool holds(std::string_view page, std::string_view text) {
  return page.find(text) != std::string_view::npos;
}

testing::MadeUpScene wet() {
  testing::MadeUpScene scene;
  scene.phases = true;
  return scene;
}

double east_of(const FrontMark& front) {
  double x = -INFINITY;
  for (const MapLine& l : front.lines) x = std::max({x, l.x0, l.x1});
  return x;
}

TEST(ReportFronts, AreWhereHalfOfTheMembersCome) {
  const auto results = testing::make_up_results(wet());
  const Grid& grid = results.hazard.grid;
  const std::vector<FrontMark> fronts = front_marks(results.hazard);
  ASSERT_EQ(fronts.size(), 2U);
  EXPECT_EQ(fronts[0].phase, Phase::grains);
  EXPECT_EQ(fronts[1].phase, Phase::liquid);
  double farthest = -INFINITY;
  const Layer& likely = *results.hazard.find("probability_of_solid_reach");
  for (std::size_t k = 0; k < likely.values.size(); ++k)
    if (likely.values[k] >= 0.5F)
      farthest = std::max(farthest, grid.x_center(static_cast<int>(k % grid.n_cols)));
  EXPECT_NEAR(east_of(fronts[0]), farthest + grid.cell_m / 2, 1e-6);
  EXPECT_GT(east_of(fronts[1]), east_of(fronts[0])) << "the liquid runs farther";
  EXPECT_TRUE(front_marks(testing::make_up_results().hazard).empty());
  const std::string page = make_report(results.ensemble_input());
  EXPECT_TRUE(holds(page, "swatch front-grains"));
  EXPECT_TRUE(holds(page, "liquid arrives with a probability of 50"));
}

TEST(ReportFronts, OfASingleRunAreWhatItReached) {
  const auto results = testing::make_up_results(wet());
  const std::vector<FrontMark> fronts = front_marks(results.peaks);
  ASSERT_EQ(fronts.size(), 2U);
  EXPECT_EQ(fronts[0].label, "reached by grains");
  EXPECT_TRUE(holds(make_report(results.single_input()), "<section id=\"phases\""));
  EXPECT_FALSE(holds(make_report(testing::make_up_results().single_input()), "id=\"phases\""));
}

TEST(LayerTitles, NameEachMaterialInPlainWords) {
  Layer layer;
  layer.meaning = {Quantity::solid_reached, Statistic::probability};
  EXPECT_EQ(plane_title(layer, 0), "Probability that grains arrive");
  EXPECT_EQ(plane_label(layer, 0), "reached");
  layer.meaning = {Quantity::liquid_pressure, Statistic::peak};
  EXPECT_EQ(plane_title(layer, 0), "Peak dynamic pressure of the liquid");
  EXPECT_EQ(short_title(Quantity::liquid_pressure), "Pressure");
  EXPECT_EQ(short_title(Quantity::solid), "Thickness");
  EXPECT_EQ(short_title(Quantity::energy), "Energy");
  EXPECT_EQ(short_title(Quantity::liquid_fraction), "Share of liquid");
}

}  // namespace
}  // namespace sturz
