// SPDX-License-Identifier: Apache-2.0
// Ways of the front from times of arrival: down a bent channel whose answer is known.
#include "ensemble/workflow/results/gis/flow_lines.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <variant>
#include <vector>

namespace sturz::workflow {
namespace {

/// Cells of 10 m; the flow goes 8 cells east in row 2 and then 5 cells south in column 8, one cell
/// a second. Its last three cells are reached by few members.
struct Bent {
  LayerStack maps;
  Raster<std::uint8_t> release;

  Bent() {
    maps.grid = {
        .n_cols = 12, .n_rows = 10, .west_m = 1000, .north_m = 2000, .cell_m = 10, .crs_wkt = ""};
    Layer reached = plain_layer("probability_of_reach", {Quantity::reached, Statistic::probability},
                                "", "1", "");
    Layer arrival =
        plain_layer("arrival_quantile", {Quantity::arrival, Statistic::quantile}, "", "s", "");
    arrival.axis = {"quantile", "", "1", {0.05, 0.5}};
    const std::size_t n = maps.grid.n_cells();
    reached.values.assign(n, 0);
    arrival.values.assign(2 * n, nan_f);
    const auto put = [&](int row, int col, float time) {
      reached.values[maps.grid.index(row, col)] = time > 10 ? 0.1F : 1;
      arrival.values[n + maps.grid.index(row, col)] = time;
    };
    for (int col = 1; col <= 8; ++col) put(2, col, static_cast<float>(col - 1));
    for (int row = 3; row <= 8; ++row) put(row, 8, static_cast<float>(row + 5));
    maps.layers = {reached, arrival};
    Grid cell = maps.grid;
    cell.n_cols = cell.n_rows = 1;
    cell.west_m += 10, cell.north_m -= 20;
    release = Raster<std::uint8_t>(cell, 1);
  }
};

const std::vector<double>& column(const FeatureTable& table, std::size_t k) {
  return std::get<std::vector<double>>(table.columns.at(k).values);
}

TEST(FlowLines, FollowTheBendAndNotTheStraightLine) {
  const Bent bent;
  const FeatureTable lines = flow_lines(bent.maps, bent.release);
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_THAT(column(lines, 1), ::testing::ElementsAre(0.9, 0.5, 0.05));
  // The corner is cut by one diagonal.
  EXPECT_NEAR(column(lines, 2)[2], 10 * (6 + 5 + std::sqrt(2.0)), 1e-9);
  EXPECT_EQ(column(lines, 3)[2], 13);
  EXPECT_LT(column(lines, 2)[0], column(lines, 2)[2]) << "few members come to the end";
  EXPECT_EQ(column(lines, 3)[0], 10);
}

TEST(FlowLines, NeedTimesAndARelease) {
  Bent bent;
  EXPECT_EQ(flow_lines(bent.maps, {}).size(), 0U);
  bent.maps.layers.pop_back();
  EXPECT_EQ(flow_lines(bent.maps, bent.release).size(), 0U);
}

}  // namespace
}  // namespace sturz::workflow
