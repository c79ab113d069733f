// SPDX-License-Identifier: Apache-2.0
// How deep a bed can be taken along, from files to the terrain's cells.
#include "io/site/bed/bed_inputs.hpp"

#include "io/site/scene_inputs.hpp"
#include "tests/io/io_fixture.hpp"

#include <numeric>

namespace sturz::test {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

class BedInputs : public SceneOnAPlane {
 protected:
  BedInputs() { scene.erosion.emplace().growth_rate_per_m = Uncertain(1e-3); }

  /// A raster of one value on square cells whose south-west corner lies x, y from the terrain's.
  void depths(double value, int n_cols, int n_rows, double cell, double x, double y) {
    RasterFile file;
    file.n_cols = n_cols, file.n_rows = n_rows;
    file.affine = {500000 + x, cell, 0, 4600000 + y + n_rows * cell, 0, -cell};
    file.values.assign(static_cast<std::size_t>(n_cols) * n_rows, value);
    write_raster(path("depths.tif"), file);
    scene.erosion->depth_raster = "depths.tif";
  }
  static double volume(const SceneInputs& in) {
    const auto& v = in.bed_supply->values;
    return std::accumulate(v.begin(), v.end(), 0.0) * in.bed_supply->grid.cell_m *
           in.bed_supply->grid.cell_m;
  }
  std::string refusal() const {
    return message_of([&] { load_scene_inputs(scene); });
  }
};

TEST_F(BedInputs, ARasterOfOtherCellsKeepsItsVolume) {
  depths(0.5, 30, 20, 4, 103, 98);
  const SceneInputs in = load_scene_inputs(scene);
  ASSERT_NE(in.bed_supply, nullptr);
  EXPECT_NEAR(volume(in), 0.5 * 30 * 20 * 16, 1e-6);
  EXPECT_THAT(in.notes, Contains(HasSubstr("erosion.depth_raster depths.tif: 4800 m3 on 9600 m2")));
}

TEST_F(BedInputs, WhatLiesBeyondTheTerrainIsLeftOut) {
  depths(0.5, 70, 60, 10, -100, -100);  // a hundred metres more on all sides
  const SceneInputs in = load_scene_inputs(scene);
  EXPECT_NEAR(volume(in), 0.5 * 500 * 400, 1e-6);
  EXPECT_THAT(in.notes,
              Contains(HasSubstr("erosion.depth_raster depths.tif: 100000 m3 on 200000 m2")));
  for (const double depth : in.bed_supply->values) ASSERT_NEAR(depth, 0.5, 1e-12);

  depths(2, 11, 9, 37, -51, 203);  // cut by an edge, on cells that are not its own
  const SceneInputs cut = load_scene_inputs(scene);
  EXPECT_NEAR(volume(cut), 2 * (11 * 37 - 51) * (400 - 203.0), 1e-6);

  depths(1, 5, 5, 10, 1e5, 0);
  EXPECT_THAT(refusal(),
              AllOf(HasSubstr("erosion.depth_raster"), HasSubstr("outside the terrain")));
}

TEST_F(BedInputs, AMaskIsRefusedUntilAFactorSaysWhatItStandsFor) {
  depths(255, 30, 20, 10, 100, 100);
  EXPECT_THAT(refusal(), HasSubstr("erosion.depth_factor: 0.0078431 makes it 2 m"));
  scene.erosion->depth_factor = Uncertain(0.0078431);
  EXPECT_NEAR(volume(load_scene_inputs(scene)), 255.0 * 30 * 20 * 100, 1e-3)
      << "the factor is a member's own";
}

TEST_F(BedInputs, DepthsCountDownwards) {
  depths(-1, 30, 20, 10, 100, 100);
  EXPECT_THAT(refusal(),
              AllOf(HasSubstr("is negative, like all its 600 values"),
                    HasSubstr("give them as positive numbers"), Not(HasSubstr("factor: -1"))));
}

TEST_F(BedInputs, APolygonTakesTheCellsByTheirCentres) {
  write("channel.geojson", collection(feature("Polygon", "[" + square(104, 104, 50) + "]")));
  scene.erosion->polygon = "channel.geojson";
  scene.erosion->depth_m = Uncertain(2);
  const SceneInputs in = load_scene_inputs(scene);
  EXPECT_NEAR(volume(in), 2500, 1e-9) << "a share: the depth is a member's own";
  EXPECT_THAT(in.notes, Contains("erosion.polygon channel.geojson: 25 cells, 2500 m2"));
  write("channel.geojson", collection(feature("Polygon", "[" + square(9000, 104, 50) + "]")));
  EXPECT_THAT(refusal(), AllOf(HasSubstr("erosion.polygon"), HasSubstr("no cell of the terrain")));
}

}  // namespace
}  // namespace sturz::test
