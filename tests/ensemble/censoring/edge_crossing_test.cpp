// SPDX-License-Identifier: Apache-2.0
#include "ensemble/censoring/edge_crossing.hpp"

#include <gtest/gtest.h>

namespace sturz {
namespace {

const Grid terrain{
    .n_cols = 100, .n_rows = 80, .west_m = 500000, .north_m = 4000800, .cell_m = 10, .crs_wkt = ""};

LayerStack map_with(std::initializer_list<std::pair<int, int>> cells, float share = 0.5F) {
  LayerStack maps;
  maps.grid = terrain;
  Layer left;
  left.meaning = {Quantity::left, Statistic::probability};
  left.values.assign(terrain.n_cells(), 0);
  for (const auto& [row, col] : cells) left.values[terrain.index(row, col)] = share;
  maps.layers.push_back(left);
  return maps;
}

TEST(EdgeCrossing, NamesTheSideAndItsStretch) {
  EXPECT_EQ(where_mass_left(map_with({{20, 99}, {24, 99}, {22, 98}}), terrain),
            "over the eastern edge (y 4000550 to 4000600)");
  EXPECT_EQ(where_mass_left(map_with({{0, 10}, {0, 12}}), terrain),
            "over the northern edge (x 500100 to 500130)");
}

TEST(EdgeCrossing, PutsTheSideFirstThatMostCrossed) {
  EXPECT_EQ(where_mass_left(map_with({{79, 50}, {40, 0}, {41, 0}}), terrain),
            "over the western edge (y 4000380 to 4000400) and over the southern edge (x 500500 to "
            "500510)");
}

TEST(EdgeCrossing, KnowsHolesFromSides) {
  EXPECT_EQ(where_mass_left(map_with({{40, 50}}), terrain),
            "where the raster holds no elevation (x 500500 to 500510, y 4000390 to 4000400)");
}

TEST(EdgeCrossing, IsSilentWhereNothingLeft) {
  EXPECT_EQ(where_mass_left(map_with({}), terrain), "");
  EXPECT_EQ(where_mass_left({}, terrain), "");
  EXPECT_EQ(where_mass_left(map_with({{0, 0}}, nan_f), terrain), "");
}

}  // namespace
}  // namespace sturz
