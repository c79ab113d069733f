// SPDX-License-Identifier: Apache-2.0
// Numbers of the bed from raster files to the terrain's cells.
#include "io/scenario/scenario_file.hpp"
#include "io/site/bed/bed_raster.hpp"
#include "io/site/scene_inputs.hpp"
#include "tests/io/io_fixture.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace sturz::test {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

/// A raster of `cell` metres over the plane of SceneOnAPlane or a part of it.
RasterFile over_the_plane(int n_cols, int n_rows, double cell, double west, double north,
                          const std::function<double(int row, int col)>& value) {
  RasterFile file;
  file.n_cols = n_cols, file.n_rows = n_rows;
  file.affine = {west, cell, 0, north, 0, -cell};
  file.nodata = -9999;
  for (int r = 0; r < n_rows; ++r)
    for (int c = 0; c < n_cols; ++c) file.values.push_back(value(r, c));
  return file;
}

class BedRasterInputs : public SceneOnAPlane {
 protected:
  void friction(const RasterFile& file) {
    write_raster(path("mu.tif"), file);
    scene.basal.rasters.friction_coefficient.path = "mu.tif";
  }
  /// The terrain's own 50 x 40 cells.
  void own_cells(const std::function<double(int row, int col)>& value) {
    friction(over_the_plane(50, 40, 10, 500000, 4600400, value));
  }
  const Raster<double>& mu(const SceneInputs& in) const { return *in.bed_layers.at(0).values; }
  std::string refusal() const {
    return message_of([&] { load_scene_inputs(scene); });
  }
};

TEST_F(BedRasterInputs, WithoutTheKeyThereIsNoArray) {
  EXPECT_THAT(load_scene_inputs(scene).bed_layers, IsEmpty());
}

TEST_F(BedRasterInputs, TheTerrainsOwnCellsAreTakenAsTheyAre) {
  own_cells([](int r, int c) { return r == 3 && c == 4 ? -9999 : 0.1 + 0.01 * c + 0.001 * r; });
  const SceneInputs in = load_scene_inputs(scene);
  ASSERT_EQ(in.bed_layers.size(), 1U);
  EXPECT_EQ(in.bed_layers[0].number, BedNumber::friction);
  EXPECT_TRUE(mu(in).grid.same_place(in.elevation->grid));
  EXPECT_EQ(mu(in).at(0, 0), 0.1);
  EXPECT_EQ(mu(in).at(7, 30), 0.1 + 0.01 * 30 + 0.001 * 7);
  EXPECT_TRUE(std::isnan(mu(in).at(3, 4)));
  EXPECT_THAT(in.notes,
              Contains("basal.rasters.friction_coefficient = mu.tif: 0.1 to 0.629 on 1999 "
                       "of 2000 cells; the others have basal.friction_coefficient"));
}

TEST_F(BedRasterInputs, OtherCellsGiveTheValueBelowTheCentre) {
  // 25 m cells over the middle: centres of 10 m cells at 5, 15, 25 (an edge: the eastern one), ...
  friction(over_the_plane(4, 2, 25, 500100, 4600300,
                          [](int r, int c) { return 0.1 * (1 + c + 4 * r); }));
  const Raster<double> fine = mu(load_scene_inputs(scene));
  EXPECT_EQ(fine.at(10, 10), 0.1) << "x 500105, y 4600295";
  EXPECT_EQ(fine.at(10, 11), 0.1);
  EXPECT_EQ(fine.at(10, 12), 0.2) << "x 500125 lies on the edge";
  EXPECT_EQ(fine.at(12, 10), 0.5) << "y 4600275 lies on the edge";
  EXPECT_EQ(fine.at(14, 19), 0.8);
  EXPECT_TRUE(std::isnan(fine.at(15, 19)));
  EXPECT_TRUE(std::isnan(fine.at(10, 9)));
  EXPECT_TRUE(std::isnan(fine.at(9, 10)));
}

TEST_F(BedRasterInputs, DegreesAreLookedUp) {
  RasterFile file;
  file.n_cols = 2, file.n_rows = 1;
  // Split at 15.003 degrees: 250 m east of the western edge.
  file.affine = {15.0, 0.003, 0, 41.5552, 0, -0.0036};
  file.crs = "EPSG:4326";
  file.values = {0.2, 0.4};
  friction(file);
  const SceneInputs in = load_scene_inputs(scene);
  EXPECT_EQ(mu(in).at(20, 24), 0.2);
  EXPECT_EQ(mu(in).at(20, 25), 0.4);
  EXPECT_THAT(in.notes,
              Contains(HasSubstr("mu.tif: looked up in WGS 84 (EPSG:4326) from WGS 84 / UTM")));
}

TEST_F(BedRasterInputs, AValueOutOfRangeIsNamedWithItsCell) {
  own_cells([](int r, int c) { return r == 2 && c == 5 ? 21.5 : 0.3; });
  EXPECT_EQ(refusal(),
            "basal.rasters.friction_coefficient = mu.tif: 21.5 at row 2, column 5 (x 500055, y "
            "4600375; rows from the north, from 0) must be in 0..2, as basal.friction_coefficient. "
            "Correct it or set such cells to nodata.");
  own_cells([](int r, int) { return r < 2 ? -0.1 : 0.3; });
  EXPECT_THAT(refusal(), HasSubstr("-0.1 at row 0, column 0"));
  EXPECT_THAT(refusal(), HasSubstr("; so are 99 values more."));
  own_cells([](int, int) { return -9999; });
  EXPECT_THAT(refusal(), HasSubstr("holds no value (all of it is nodata)"));
}

TEST_F(BedRasterInputs, WhatAFactorMakesOfItHasToBeInRangeToo) {
  write_raster(path("ru.tif"), over_the_plane(50, 40, 10, 500000, 4600400, [](int r, int c) {
                 return r == 1 && c == 1 ? 0.6 : 0.2;
               }));
  scene.basal.rasters.pore_pressure_ratio = {"ru.tif", Uncertain(1.6)};
  EXPECT_THAT(load_scene_inputs(scene).bed_layers.at(0).most, ::testing::DoubleEq(0.2))
      << "the release does not come there";
  scene.basal.rasters.pore_pressure_ratio.factor = Uncertain(2);
  EXPECT_EQ(refusal(),
            "basal.rasters.pore_pressure_ratio = ru.tif: 0.6 at row 1, column 1 (x 500015, y "
            "4600385; rows from the north, from 0) becomes 1.2 with "
            "basal.rasters.pore_pressure_ratio_factor = 2 (must be in 0..0.99). Give the factor "
            "less room or correct the raster.");
}

TEST_F(BedRasterInputs, AllFilesAreLookedAtInOneRound) {
  own_cells([](int, int) { return 3; });
  write_raster(path("xi.tif"),
               over_the_plane(50, 40, 10, 500000, 4600400, [](int, int) { return 0; }));
  scene.basal.rasters.turbulent_coefficient_m_s2.path = "xi.tif";
  scene.basal.rasters.cohesion_pa.path = "co.tif";
  scene.basal.zones.push_back({"no.geojson", "", 0.3, {}, {}});
  const std::string all = refusal();
  EXPECT_THAT(all, HasSubstr("mu.tif: 3 at row 0, column 0"));
  EXPECT_THAT(all, HasSubstr("xi.tif: 0 m s-2 at row 0"));
  EXPECT_THAT(all, HasSubstr("must be > 0, as basal.turbulent_coefficient_m_s2; so are 1999"));
  EXPECT_THAT(all, HasSubstr("basal.rasters.cohesion_pa = co.tif: no such file"));
  EXPECT_THAT(all, HasSubstr("no.geojson"));
  std::filesystem::remove(path("bed.tif"));
  EXPECT_THAT(refusal(),
              AllOf(HasSubstr("bed.tif"), HasSubstr("mu.tif: 3 at"), HasSubstr("co.tif")));
}

TEST_F(BedRasterInputs, ARasterElsewhereOrWithoutASystemIsRefused) {
  friction(over_the_plane(5, 5, 10, 700000, 4600400, [](int, int) { return 0.3; }));
  EXPECT_THAT(refusal(), HasSubstr("has no value on any of the"));
  EXPECT_THAT(refusal(), HasSubstr("Is its coordinate system right?"));
  RasterFile bare = over_the_plane(50, 40, 10, 500000, 4600400, [](int, int) { return 0.3; });
  bare.crs.clear();
  friction(bare);
  EXPECT_THAT(refusal(), HasSubstr("basal.rasters.crs"));
  scene.basal.rasters.crs = "EPSG:32633";
  EXPECT_EQ(mu(load_scene_inputs(scene)).at(3, 4), 0.3);
}

TEST_F(BedRasterInputs, AnyWindowHasTheValuesOfTheWhole) {
  RasterFile file = over_the_plane(61, 47, 7.3, 500011, 4600390, [](int r, int c) {
    return (r * 61 + c) % 7 == 0 ? -9999 : 0.0001 * (r * 61 + c);
  });
  write_raster(path("mu.tif"), file);
  RasterRequest request;
  request.path = path("mu.tif"), request.key = "basal.rasters.friction_coefficient";
  BedRasterLimits limits;
  limits.key = find_key("basal.friction_coefficient");
  const Grid terrain = plane(50, 40, 10, 500000, 4600400).grid;
  const BedRasterFile raster(request, limits, terrain);
  const Raster<double> all = raster.on(whole_of(terrain));
  for (const Window& w : {Window{3, 5, 20, 11}, Window{0, 0, 1, 50}, Window{39, 49, 1, 1}}) {
    const Raster<double> part = raster.on(w);
    for (int r = 0; r < w.n_rows; ++r)
      for (int c = 0; c < w.n_cols; ++c) {
        const double a = part.at(r, c), b = all.at(w.row0 + r, w.col0 + c);
        EXPECT_TRUE(a == b || (std::isnan(a) && std::isnan(b))) << r << ' ' << c;
      }
  }
  const KnownRange range = known_range(all);
  // 45 x 34 centres lie on it, and about each seventh cell is a gap.
  EXPECT_NEAR(static_cast<double>(range.count), 45 * 34 * 6 / 7.0, 10);
  EXPECT_LT(range.most, 0.2867);
}

TEST_F(BedRasterInputs, OnlyWhatTheEnergyLineMeetsLengthensIt) {
  // The plane rises by 1 in 10 to the east and south-west of it is down: 0.2 m a metre southward.
  own_cells([](int, int) { return 0.5; });
  const double plain = load_scene_inputs(scene).reach->length_m;
  own_cells([](int r, int c) { return r == 0 && c == 0 ? 0.01 : 0.5; });
  const SceneInputs corner = load_scene_inputs(scene);
  EXPECT_EQ(corner.reach->length_m, plain) << "the flow never comes there";
  EXPECT_EQ(corner.bed_layers.at(0).least, 0.5);
  own_cells([](int r, int c) { return r == 19 && c == 22 ? 0.01 : 0.5; });
  const SceneInputs below = load_scene_inputs(scene);
  EXPECT_EQ(below.bed_layers.at(0).least, 0.01) << "below the release";
  EXPECT_GT(below.reach->length_m, 1.5 * plain);
}

TEST_F(BedRasterInputs, ItsIdentityIsItsValues) {
  own_cells([](int, int) { return 0.3; });
  const auto was = load_scene_inputs(scene).identities;
  ASSERT_EQ(was.size(), 2U);
  EXPECT_EQ(was[1].role, "basal.rasters.friction_coefficient");
  own_cells([](int r, int c) { return r == 39 && c == 0 ? 0.31 : 0.3; });
  const auto changed = input_differences(was, load_scene_inputs(scene).identities);
  ASSERT_EQ(changed.size(), 1U);
  EXPECT_THAT(changed[0], StartsWith("input basal.rasters.friction_coefficient = mu.tif: other "));
}

TEST_F(BedRasterInputs, AScenarioWrittenElsewhereNamesTheSameFile) {
  own_cells([](int, int c) { return 0.2 + 0.001 * c; });
  Distribution d;
  d.kind = Distribution::Kind::uniform, d.min = 0.9, d.max = 1.1;
  scene.basal.rasters.friction_coefficient.factor.emplace().distribution = d;
  scene.basal.samosat.emplace();
  scene.grains.emplace().friction_angle_deg = Uncertain(30);
  scene.numerics.spacing_m = 5;
  const auto elsewhere = folder() / "out" / "run";
  std::filesystem::create_directories(elsewhere);
  const Scenario again =
      read_scenario_text(write_scenario(scene, elsewhere), "scenario.yaml", elsewhere);
  EXPECT_EQ(again.basal.rasters.friction_coefficient.path, "../../mu.tif");
  EXPECT_EQ(again.basal.rasters.friction_coefficient.factor,
            scene.basal.rasters.friction_coefficient.factor);
  EXPECT_EQ(again.basal.samosat, scene.basal.samosat);
  const SceneInputs a = load_scene_inputs(scene), b = load_scene_inputs(again);
  EXPECT_EQ(a.bed_layers.at(0).values->values, b.bed_layers.at(0).values->values);
}

}  // namespace
}  // namespace sturz::test
