// SPDX-License-Identifier: Apache-2.0
// Windows of an elevation raster have the bits of the whole, whatever was done to get it onto its
// working grid.
#include "io/gdal/gdal_raster.hpp"
#include "tests/io/io_fixture.hpp"

#include <cmath>
#include <cstring>
#include <random>

namespace sturz::test {
namespace {

using ::testing::HasSubstr;

class ElevationWindow : public IoTest {
 protected:
  RasterFile file(int n_cols, int n_rows, std::array<double, 6> affine,
                  const std::string& crs = "EPSG:32633") const {
    RasterFile f;
    f.n_cols = n_cols, f.n_rows = n_rows;
    f.affine = affine;
    f.crs = crs;
    f.nodata = -5;
    for (int r = 0; r < n_rows; ++r)
      for (int c = 0; c < n_cols; ++c)
        f.values.push_back(c % 97 == 3 && r % 53 == 8
                               ? -5.0
                               : 900 + 40 * std::sin(c / 31.0) * std::cos(r / 23.0) + 0.1 * r);
    return f;
  }

  void expect_same(const RasterFile& f, std::optional<double> cell = {}) {
    write_raster(path("dem.tif"), f);
    RasterRequest request;
    request.path = path("dem.tif");
    request.cell_size_m = cell;
    const Raster<double> all = read_elevation(request).raster;
    ElevationRaster raster(request);
    ASSERT_TRUE(raster.grid().same_place(all.grid));
    std::mt19937 random(7);
    for (int k = 0; k < 6; ++k) {
      const auto within = [&](int n) {
        return std::uniform_int_distribution<int>(0, n - 1)(random);
      };
      const int r0 = within(all.grid.n_rows), r1 = within(all.grid.n_rows);
      const int c0 = within(all.grid.n_cols), c1 = within(all.grid.n_cols);
      const Window w{std::min(r0, r1), std::min(c0, c1), std::abs(r1 - r0) + 1,
                     std::abs(c1 - c0) + 1};
      const RasterRead part = raster.read(w);
      ASSERT_EQ(part.raster.values.size(), w.n_cells());
      EXPECT_EQ(window_of(part.raster.grid, all.grid), w);
      for (int r = 0; r < w.n_rows; ++r)
        ASSERT_EQ(std::memcmp(&part.raster.at(r, 0), &all.at(w.row0 + r, w.col0),
                              static_cast<std::size_t>(w.n_cols) * sizeof(double)),
                  0)
            << "row " << r << " of window " << k;
    }
  }
};

TEST_F(ElevationWindow, CellByCell) {
  expect_same(file(300, 270, {500000.3, 2, 0, 4600000.7, 0, -2}));
}

TEST_F(ElevationWindow, StoredSouthUpAndFromTheEast) {
  expect_same(file(211, 300, {500000, 2, 0, 4600000, 0, 2}));
  expect_same(file(211, 300, {500600, -2, 0, 4600000, 0, -2}));
}

TEST_F(ElevationWindow, CoarserAndFinerCells) {
  expect_same(file(800, 700, {500000.3, 2, 0, 4600000.7, 0, -2}), 5);
  // More than one block of the grid in both directions.
  expect_same(file(620, 560, {500000.3, 2, 0, 4600000.7, 0, -2}), 0.9);
}

TEST_F(ElevationWindow, OblongAndRotatedCells) {
  expect_same(file(300, 400, {500000, 3, 0, 4600000, 0, -2}));
  expect_same(file(300, 400, {500000, 1.8, 0.6, 4600000, 0.6, -1.8}));
}

TEST_F(ElevationWindow, Degrees) {
  expect_same(file(400, 300, {15.1, 1e-4, 0, 46.2, 0, -1e-4}, "EPSG:4326"));
}

TEST_F(ElevationWindow, TheIdentityGrowsAndChangesNoWholeBlock) {
  write_raster(path("dem.tif"), file(900, 800, {500000, 2, 0, 4600000, 0, -2}));
  RasterRequest request;
  request.path = path("dem.tif");
  ElevationRaster raster(request);
  const auto small = raster.read({250, 250, 270, 270}).identity.parts;
  const auto large = raster.read({100, 100, 600, 700}).identity.parts;
  ASSERT_TRUE(small.contains("1/1"));
  EXPECT_EQ(small.at("1/1"), large.at("1/1"));
  EXPECT_GT(large.size(), small.size());
}

TEST_F(ElevationWindow, ALargeRasterIsOpenedAndNotReadWhole) {
  write_raster(path("dem.tif"), file(300, 270, {500000, 2, 0, 4600000, 0, -2}));
  RasterRequest request;
  request.path = path("dem.tif");
  request.max_cells = 1000;
  ElevationRaster raster(request);
  EXPECT_EQ(raster.read({10, 10, 20, 20}).raster.values.size(), 400u);
  EXPECT_THAT(message_of([&] { raster.read(whole_of(raster.grid())); }), HasSubstr("too many"));
}

}  // namespace
}  // namespace sturz::test
