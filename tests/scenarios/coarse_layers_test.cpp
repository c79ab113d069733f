// SPDX-License-Identifier: Apache-2.0
#include "scenarios/layers/coarse_layers.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace sturz {
namespace {

TEST(CoarseLayers, HoldTheMostSevereValueOfTheirCells) {
  LayerStack s;
  s.grid = {301, 203, 100, 900, 2, ""};
  std::mt19937 random(4);
  const auto noise = [&] {
    std::vector<float> values(s.grid.n_cells());
    for (float& v : values) v = random() % 3 == 0 ? nan_f : static_cast<float>(random() % 1000);
    return values;
  };
  Layer speed{"speed_mean", {Quantity::speed, Statistic::mean}, "", "", "m s-1", "", "", {},
              noise()};
  Layer arrival{"arrival", {Quantity::arrival, Statistic::peak}, "", "", "s", "", "", {}, noise()};
  Layer bound{"x_lower", {Quantity::speed, Statistic::lower_bound}, "", "", "1", "", "", {},
              noise()};
  s.layers = {speed, bound, arrival};
  const LayerStack coarse = coarse_layers(StackSource(s), 5000);
  EXPECT_EQ(coarse.joined, 4);
  EXPECT_EQ(coarse.grid.n_cols, 76);
  EXPECT_EQ(coarse.grid.n_rows, 51);
  EXPECT_EQ(coarse.grid.cell_m, 8);
  ASSERT_EQ(coarse.layers.size(), 2U) << "bounds are not for the page";
  for (int row = 0; row < coarse.grid.n_rows; ++row)
    for (int col = 0; col < coarse.grid.n_cols; ++col) {
      float most = nan_f, first = nan_f;
      for (int r = 4 * row; r < std::min(4 * row + 4, 203); ++r)
        for (int c = 4 * col; c < std::min(4 * col + 4, 301); ++c) {
          most = std::fmax(most, speed.values[s.grid.index(r, c)]);
          first = std::fmin(first, arrival.values[s.grid.index(r, c)]);
        }
      const std::size_t i = coarse.grid.index(row, col);
      EXPECT_TRUE(coarse.layers[0].values[i] == most ||
                  (std::isnan(most) && std::isnan(coarse.layers[0].values[i])));
      EXPECT_TRUE(coarse.layers[1].values[i] == first ||
                  (std::isnan(first) && std::isnan(coarse.layers[1].values[i])));
    }
}

TEST(CoarseLayers, HoldTheDifferenceFarthestFromZeroAndTheClasses) {
  LayerStack s;
  s.grid = {2, 2, 0, 2, 1, ""};
  Layer less;
  less.name = "difference";
  less.meaning = {Quantity::reached, Statistic::difference};
  less.values = {0.1F, -0.6F, nan_f, 0.5F};
  Layer field;
  field.name = "field";
  field.classes = {{4, "low"}, {9, "high"}};
  field.values = {4, 0, nan_f, 4};
  s.layers = {less, field};
  const LayerStack coarse = coarse_layers(StackSource(s), 1);
  EXPECT_EQ(coarse.joined, 2);
  EXPECT_EQ(coarse.layers[0].values, std::vector<float>{-0.6F});
  EXPECT_EQ(coarse.layers[1].values, std::vector<float>{4});
  EXPECT_EQ(coarse.layers[1].classes, field.classes);
}

TEST(CoarseLayers, AreTheLayersThemselvesWhereTheyFit) {
  LayerStack s;
  s.grid = {3, 2, 0, 2, 1, ""};
  s.layers = {{"deposit_mean", {}, "", "", "m", "", "", {}, {1, 2, 3, 4, 5, 6}}};
  const LayerStack coarse = coarse_layers(StackSource(s), 6);
  EXPECT_EQ(coarse.joined, 1);
  EXPECT_EQ(coarse.layers[0].values, s.layers[0].values);
}

}  // namespace
}  // namespace sturz
