// SPDX-License-Identifier: Apache-2.0
#include "io/site/thickness_raster.hpp"

#include "tests/io/io_fixture.hpp"

#include <cmath>
#include <numeric>
#include <random>

namespace sturz::test {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;

double volume(const Raster<double>& r) {
  return std::accumulate(r.values.begin(), r.values.end(), 0.0) * r.grid.cell_m * r.grid.cell_m;
}

class ThicknessRaster : public IoTest {
 protected:
  ThicknessRead read(const RasterFile& file, const Grid& terrain) const {
    write_raster(path("h.tif"), file);
    return read_thickness(request(), terrain);
  }
  RasterRequest request() const {
    RasterRequest r;
    r.path = "h.tif";
    r.key = "release.thickness_raster";
    r.directory = folder().string();
    r.crs_key = "release.crs";
    return r;
  }
  std::string refusal(const RasterFile& file, const Grid& terrain) const {
    return message_of([&] { read(file, terrain); });
  }
  /// 60 x 60 cells of 7 m around the file of five_by_five().
  static Grid terrain() { return {60, 60, 499813.3, 4600211.7, 7, utm33_wkt()}; }
};

/// Random thickness with holes of nodata, on the cells of five_by_five().
RasterFile random_thickness() {
  RasterFile file = five_by_five();
  std::mt19937 random(7);
  for (double& v : file.values) v = std::uniform_real_distribution<>(0, 30)(random);
  file.nodata = -9999;
  file.values[3] = -9999;
  file.values[11] = NAN;
  file.values[12] = 0;
  return file;
}

double source_volume(const RasterFile& file) {
  double sum = 0;
  for (const double v : file.values)
    if (v > 0) sum += v;
  return sum * std::abs(file.affine[1] * file.affine[5] - file.affine[2] * file.affine[4]);
}

TEST_F(ThicknessRaster, AShiftedGridKeepsTheVolume) {
  const RasterFile file = random_thickness();
  const ThicknessRead read = this->read(file, terrain());
  EXPECT_NEAR(read.volume_m3 / source_volume(file), 1, 1e-12);
  EXPECT_NEAR(volume(read.thickness) / source_volume(file), 1, 1e-9);
  EXPECT_EQ(read.area_m2, 22 * 100);
  EXPECT_THAT(read.notes, Contains(HasSubstr("carried over by overlapping areas")));
}

TEST_F(ThicknessRaster, CoarserFinerOblongAndRotatedGridsKeepTheVolume) {
  for (const double cell : {0.9, 3.0, 10.0, 42.0}) {
    Grid grid = terrain();
    grid.cell_m = cell;
    grid.n_cols = grid.n_rows = static_cast<int>(420 / cell);
    const RasterFile file = random_thickness();
    EXPECT_NEAR(volume(read(file, grid).thickness) / source_volume(file), 1, 1e-9) << cell;
  }
  RasterFile oblong = random_thickness();
  oblong.affine = {500000, 13, 0, 4600050, 0, -4};
  EXPECT_NEAR(volume(read(oblong, terrain()).thickness) / source_volume(oblong), 1, 1e-9);
  RasterFile rotated = random_thickness();
  rotated.affine = {500000, 8, 6, 4600050, 6, -8};
  EXPECT_NEAR(volume(read(rotated, terrain()).thickness) / source_volume(rotated), 1, 1e-9);
}

TEST_F(ThicknessRaster, TheCentreOfMassStaysToo) {
  const RasterFile file = random_thickness();
  const ThicknessRead read = this->read(file, terrain());
  double mass = 0, mx = 0, my = 0, source_mass = 0, source_x = 0, source_y = 0;
  const Grid& g = read.thickness.grid;
  for (int row = 0; row < g.n_rows; ++row)
    for (int col = 0; col < g.n_cols; ++col) {
      const double v = read.thickness.at(row, col);
      mass += v;
      mx += v * (g.x_center(col) - 500000);
      my += v * (g.y_center(row) - 4600000);
    }
  for (int i = 0; i < 25; ++i) {
    const double v = std::max(0.0, std::isnan(file.values[i]) ? 0 : file.values[i]);
    source_mass += v;
    source_x += v * (10 * (i % 5) + 5);
    source_y += v * (50 - 10 * (i / 5) - 5);
  }
  EXPECT_NEAR(mx / mass, source_x / source_mass, 0.7);  // a tenth of a cell
  EXPECT_NEAR(my / mass, source_y / source_mass, 0.7);
}

TEST_F(ThicknessRaster, TheSameGridIsCopied) {
  const RasterFile file = random_thickness();
  const Grid same{5, 5, 500000, 4600050, 10, utm33_wkt()};
  const ThicknessRead read = this->read(file, same);
  EXPECT_EQ(read.thickness.values[0], file.values[0]);
  EXPECT_EQ(read.thickness.values[3], 0);   // nodata means zero
  EXPECT_EQ(read.thickness.values[11], 0);  // NaN means zero
  EXPECT_NEAR(read.volume_m3, source_volume(file), 1e-9);
}

TEST_F(ThicknessRaster, AnotherSystemKeepsTheVolumeOfItsOwnMetres) {
  RasterFile file = random_thickness();
  file.crs = "EPSG:3035";  // the same place in a system that is turned against UTM 33
  file.affine = {4736000, 10, 0, 2084000, 0, -10};
  Grid grid = terrain();
  grid = {400, 400, 0, 0, 5, utm33_wkt()};
  const ThicknessRead read = [&] {
    // Where that is in UTM 33 comes from the refusal, as a user would find out.
    const std::string text = refusal(file, grid);
    double west = 0, north = 0;
    const auto x = text.find("within x "), y = text.find(", y ");
    west = std::stod(text.substr(x + 9));
    north = std::stod(text.substr(text.find(" to ", y) + 4));
    grid.west_m = west - 500;
    grid.north_m = north + 500;
    return this->read(file, grid);
  }();
  EXPECT_NEAR(volume(read.thickness) / source_volume(file), 1, 1e-9);
  EXPECT_THAT(read.notes, Contains(HasSubstr("reprojected from ETRS89-extended / LAEA Europe")));
}

TEST_F(ThicknessRaster, DegreesAreMeasuredInTheTerrainsMetres) {
  RasterFile file = five_by_five();
  file.crs = "EPSG:4326";
  const double second = 1.0 / 3600;  // 23.17 x 30.86 m here
  file.affine = {15, second, 0, 41.5525, 0, -second};
  file.values.assign(25, 3);
  const Grid grid{100, 100, 499900.5, 4600250.5, 4, utm33_wkt()};
  const ThicknessRead read = this->read(file, grid);
  EXPECT_NEAR(read.area_m2, 25 * 23.17 * 30.86, 30);
  EXPECT_NEAR(read.volume_m3, 3 * read.area_m2, 1e-6);
  EXPECT_NEAR(volume(read.thickness) / read.volume_m3, 1, 1e-9);
}

TEST_F(ThicknessRaster, NegativeThicknessIsRefusedWithItsCell) {
  RasterFile file = random_thickness();
  file.values[13] = -2.5;
  EXPECT_EQ(refusal(file, terrain()),
            "release.thickness_raster = h.tif: thickness -2.5 m at row 2, column 3 (x 500035, y "
            "4600025; rows from the north, from 0) is negative. Set such cells to nodata or zero.");
}

TEST_F(ThicknessRaster, ThicknessOutsideTheTerrainIsRefusedWithHowMuchAndWhere) {
  RasterFile file = five_by_five();
  file.values.assign(25, 2);
  const Grid half{4, 10, 500000, 4600075, 10, utm33_wkt()};  // the last column sticks out
  EXPECT_EQ(refusal(file, half),
            "release.thickness_raster = h.tif: 1000 of 5000 m3 (20 %) lie outside the terrain, in "
            "cells within x 500040 to 500050, y 4600000 to 4600050 (terrain x 500000 to 500040, y "
            "4599975 to 4600075). Use a larger terrain or cut the raster.");
  file.values.assign(25, 0);
  file.values[0] = 2;
  EXPECT_NO_THROW(read(file, half));  // zeros may lie where they like
}

TEST_F(ThicknessRaster, AnEmptyReleaseIsRefused) {
  RasterFile file = five_by_five();
  file.values.assign(25, 0);
  EXPECT_THAT(refusal(file, terrain()), HasSubstr("holds no thickness above zero"));
}

TEST_F(ThicknessRaster, AMissingSystemIsRefusedOrTakenFromTheTerrainsKey) {
  RasterFile file = random_thickness();
  file.crs = "";
  EXPECT_THAT(refusal(file, terrain()),
              AllOf(HasSubstr("has no coordinate system"), HasSubstr("`release.crs: EPSG:xxxxx`")));
  RasterRequest r = request();
  r.fallback_crs = "EPSG:32633";
  r.fallback_crs_key = "terrain.crs";
  const ThicknessRead read = read_thickness(r, terrain());
  EXPECT_THAT(read.notes,
              Contains(HasSubstr("taken to be in terrain.crs = WGS 84 / UTM zone 33N")));
  Grid bare = terrain();
  bare.crs_wkt = "";
  EXPECT_NO_THROW(this->read(file, bare));
}

TEST_F(ThicknessRaster, RealSourceKeepsItsVolumeOnAFinerGrid) {
  const auto file = shared("data/s1000_sthelens/landslide_depth.asc");
  if (file.empty()) GTEST_SKIP() << "shared data s1000_sthelens is not there";
  RasterRequest r = request();
  r.path = file.string();
  r.crs = "EPSG:32149";
  Grid anywhere = terrain();
  EXPECT_THAT(message_of([&] { read_thickness(r, anywhere); }),
              AllOf(HasSubstr("thickness -5.88302 m at row 34, column 23 (x 361250.5956, y 71098"),
                    HasSubstr("like all its 30 values. If these are depths counted downwards")));
  RasterRequest bed = r;
  r.factor = -1;  // what the message advises
  bed.directory.clear();
  bed.path = shared("data/s1000_sthelens/pre_runout_DEM.asc").string();
  bed.cell_size_m = 3;
  const RasterRead terrain = read_elevation(bed);
  const ThicknessRead read = read_thickness(r, terrain.raster.grid);
  EXPECT_NEAR(read.area_m2, 3000, 1e-6);
  EXPECT_NEAR(read.volume_m3, 22481, 1);
  EXPECT_NEAR(volume(read.thickness) / read.volume_m3, 1, 1e-9);
}

}  // namespace
}  // namespace sturz::test
