// SPDX-License-Identifier: Apache-2.0
#include "io/gdal/gdal_raster.hpp"

#include "tests/io/io_fixture.hpp"

#include <cmath>
#include <numeric>

namespace sturz::test {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class GdalRaster : public IoTest {
 protected:
  RasterRequest request(const std::string& name) const {
    RasterRequest r;
    r.path = name;
    r.directory = folder().string();
    return r;
  }
  RasterRead read(const RasterFile& file) const {
    write_raster(path("bed.tif"), file);
    return read_elevation(request("bed.tif"));
  }
  std::string refusal(const RasterRequest& r) const {
    return message_of([&] { read_elevation(r); });
  }
};

TEST_F(GdalRaster, KeepsASquareMetricGridCellByCell) {
  const RasterRead read = this->read(five_by_five());
  const Grid& g = read.raster.grid;
  EXPECT_EQ(g.n_cols, 5);
  EXPECT_EQ(g.n_rows, 5);
  EXPECT_EQ(g.west_m, 500000);
  EXPECT_EQ(g.north_m, 4600050);
  EXPECT_EQ(g.cell_m, 10);
  EXPECT_THAT(g.crs_wkt, AllOf(HasSubstr("PROJCRS"), HasSubstr("32633")));
  EXPECT_EQ(read.raster.values, five_by_five().values);
  EXPECT_THAT(read.notes, IsEmpty());
}

TEST_F(GdalRaster, TurnsSouthUpFilesNorthUp) {
  RasterFile file = five_by_five();
  file.affine = {500000, 10, 0, 4600000, 0, 10};  // first row is the southernmost
  const RasterRead read = this->read(file);
  EXPECT_EQ(read.raster.grid.north_m, 4600050);
  EXPECT_EQ(read.raster.at(4, 0), 0);
  EXPECT_EQ(read.raster.at(0, 0), 20);
  EXPECT_EQ(read.raster.at(0, 4), 24);
  EXPECT_THAT(read.notes, Contains(HasSubstr("south-up")));
}

TEST_F(GdalRaster, NodataNeverBecomesAnElevation) {
  RasterFile file = five_by_five();
  file.nodata = 7;
  file.values[3] = NAN;
  file.values[4] = -3.4028234663852886e38;  // undeclared
  file.values[5] = -9999;                   // undeclared
  const RasterRead read = this->read(file);
  for (const int i : {3, 4, 5, 7}) EXPECT_TRUE(std::isnan(read.raster.values[i])) << i;
  EXPECT_EQ(read.raster.values[8], 8);
  EXPECT_THAT(read.notes, Contains(HasSubstr("2 cells hold -3.40282e+38 or the like")));
}

TEST_F(GdalRaster, Float32NodataWrittenInDoubleDigitsIsRecognised) {
  RasterFile file = five_by_five();
  file.as_float32 = true;
  file.nodata = -3.4028234663852886e38;
  file.values[6] = *file.nodata;
  EXPECT_TRUE(std::isnan(read(file).raster.values[6]));
}

TEST_F(GdalRaster, ResamplingDoesNotSpreadNodataIntoElevations) {
  RasterFile file = five_by_five();
  file.values.assign(25, 100);
  file.nodata = -9999;
  file.values[12] = -9999;
  write_raster(path("bed.tif"), file);
  RasterRequest r = request("bed.tif");
  r.cell_size_m = 4;
  const RasterRead read = read_elevation(r);
  EXPECT_EQ(read.raster.grid.n_cols, 12);
  int n_nan = 0;
  for (const double v : read.raster.values) {
    n_nan += std::isnan(v);
    if (!std::isnan(v)) {
      EXPECT_NEAR(v, 100, 1e-9);
    }
  }
  EXPECT_GT(n_nan, 0);
}

TEST_F(GdalRaster, OblongCellsBecomeSquares) {
  RasterFile file = five_by_five();
  file.affine = {500000, 20, 0, 4600050, 0, -10};
  for (int row = 0; row < 5; ++row)  // a plane, which bilinear resampling keeps
    for (int col = 0; col < 5; ++col) file.values[row * 5 + col] = 2.0 * col * 20 - row * 10;
  const RasterRead read = this->read(file);
  const Grid& g = read.raster.grid;
  EXPECT_EQ(g.cell_m, 10);
  EXPECT_EQ(g.n_cols, 10);
  EXPECT_EQ(g.n_rows, 5);
  for (int col = 1; col < 9; ++col)  // between the outermost centres
    EXPECT_NEAR(read.raster.at(2, col), 2.0 * (col * 10 + 5 - 10) - 20, 1e-9);
  EXPECT_THAT(read.notes, Contains(HasSubstr("20 x 10 m cells to 10 m squares")));
}

TEST_F(GdalRaster, RotatedCellsBecomeNorthUp) {
  RasterFile file = five_by_five();
  const double c = 10 * std::cos(0.5), s = 10 * std::sin(0.5);
  file.n_cols = file.n_rows = 40;
  file.affine = {500000, c, s, 4600000, s, -c};
  file.values.clear();
  for (int row = 0; row < 40; ++row)
    for (int col = 0; col < 40; ++col) {
      const double x = c * (col + 0.5) + s * (row + 0.5), y = s * (col + 0.5) - c * (row + 0.5);
      file.values.push_back(0.3 * x - 0.2 * y);
    }
  const RasterRead read = this->read(file);
  const Grid& g = read.raster.grid;
  EXPECT_NEAR(g.cell_m, 10, 1e-9);
  int row = g.row_of(4600000 + 20 * (s - c)), col = g.col_of(500000 + 20 * (c + s));
  EXPECT_NEAR(read.raster.at(row, col),
              0.3 * (g.x_center(col) - 500000) - 0.2 * (g.y_center(row) - 4600000), 1e-6);
  EXPECT_TRUE(std::isnan(read.raster.at(0, 0)));
  EXPECT_THAT(read.notes, Contains(HasSubstr("rotated cells")));
}

TEST_F(GdalRaster, DegreesGoToTheUtmZoneOfTheCentre) {
  RasterFile file = five_by_five();
  file.n_cols = file.n_rows = 60;
  file.crs = "EPSG:4326";
  file.affine = {13.85, 1.0 / 3600, 0, 41.80, 0, -1.0 / 3600};
  file.values.clear();
  for (int row = 0; row < 60; ++row)
    for (int col = 0; col < 60; ++col) file.values.push_back(1000 + row + 2 * col);
  const RasterRead read = this->read(file);
  const Grid& g = read.raster.grid;
  EXPECT_THAT(g.crs_wkt, HasSubstr("UTM zone 33N"));
  EXPECT_NEAR(g.cell_m, 23.1, 0.051);  // one second of longitude at 41.8 degrees
  EXPECT_NEAR(g.west_m, 404450, 300);
  EXPECT_NEAR(read.raster.at(g.n_rows / 2, g.n_cols / 2), 1000 + 30 + 60, 3);
  EXPECT_THAT(read.notes, Contains(AllOf(HasSubstr("reprojected from WGS 84 (EPSG:4326)"),
                                         HasSubstr("because its coordinates are degrees"))));
}

TEST_F(GdalRaster, FeetBecomeMetres) {
  RasterFile file = five_by_five();
  file.n_cols = file.n_rows = 50;
  file.crs = "EPSG:2286";  // Washington South, US survey feet
  file.affine = {1180000, 30, 0, 400000, 0, -30};
  file.values.assign(2500, 1000);
  file.unit = "ft";
  const RasterRead read = this->read(file);
  EXPECT_NEAR(read.raster.grid.cell_m, 9.14, 0.02);
  EXPECT_NEAR(read.raster.at(25, 25), 304.8, 1e-9);
  EXPECT_THAT(read.notes, Contains(HasSubstr("US survey foot")));
  EXPECT_THAT(read.notes, Contains(HasSubstr("from ft to metres")));
}

TEST_F(GdalRaster, AMapThatStretchesLengthsIsReprojected) {
  RasterFile file = five_by_five();
  file.n_cols = file.n_rows = 30;
  file.crs = "EPSG:3857";  // web Mercator: 34 % too long at 41.8 degrees
  file.affine = {1541775, 30, 0, 5130000, 0, -30};
  file.values.assign(900, 500);
  const RasterRead read = this->read(file);
  EXPECT_NEAR(read.raster.grid.cell_m, 22.4, 0.1);
  EXPECT_THAT(read.notes, Contains(HasSubstr("lengths on this map are +34")));
}

TEST_F(GdalRaster, AWantedCellSizeResamples) {
  write_raster(path("bed.tif"), five_by_five());
  RasterRequest r = request("bed.tif");
  r.cell_size_m = 5;
  const RasterRead read = read_elevation(r);
  EXPECT_EQ(read.raster.grid.n_cols, 10);
  EXPECT_EQ(read.raster.grid.west_m, 500000);
  EXPECT_NEAR(read.raster.at(3, 3), 5 * 1.25 + 1.25, 1e-9);  // a plane is kept
}

TEST_F(GdalRaster, ScaleAndOffsetOfTheBandAreApplied) {
  write("bed.vrt",
        "<VRTDataset rasterXSize='5' rasterYSize='5'><SRS>EPSG:32633</SRS>"
        "<GeoTransform>500000,10,0,4600050,0,-10</GeoTransform>"
        "<VRTRasterBand dataType='Float64' band='1'><Scale>0.1</Scale><Offset>100</Offset>"
        "<SimpleSource><SourceFilename relativeToVRT='1'>raw.tif</SourceFilename></SimpleSource>"
        "</VRTRasterBand></VRTDataset>");
  write_raster(path("raw.tif"), five_by_five());
  EXPECT_NEAR(read_elevation(request("bed.vrt")).raster.values[24], 102.4, 1e-12);
}

TEST_F(GdalRaster, AMissingFileIsNamedWithItsNeighbour) {
  write_raster(path("bed.tif"), five_by_five());
  EXPECT_EQ(refusal(request("bde.tif")), "terrain.raster = bde.tif: no such file (looked for " +
                                             path("bde.tif") + "). Did you mean 'bed.tif'?");
}

TEST_F(GdalRaster, AMissingSystemIsRefusedUnlessGiven) {
  RasterFile file = five_by_five();
  file.crs = "";
  write_raster(path("bed.tif"), file);
  EXPECT_EQ(
      refusal(request("bed.tif")),
      "terrain.raster = bed.tif: has no coordinate system (so the result could not be put on "
      "a map). Add `terrain.crs: EPSG:xxxxx`, the system of its coordinates, or `terrain.crs: "
      "local` if they are metres that lie nowhere on the map.");
  RasterRequest r = request("bed.tif");
  r.crs = "EPSG:32633";
  EXPECT_THAT(read_elevation(r).raster.grid.crs_wkt, HasSubstr("32633"));
}

TEST_F(GdalRaster, MetresTaggedAsDegreesAreRefusedUnlessOverridden) {
  RasterFile file = five_by_five();
  file.crs = "EPSG:4326";
  write_raster(path("bed.tif"), file);
  EXPECT_EQ(refusal(request("bed.tif")),
            "terrain.raster = bed.tif: tagged as WGS 84 (EPSG:4326) (degrees), but its coordinates "
            "are x 500000 to 500050, y 4600000 to 4600050, outside +-180/90. These look like "
            "metres: give `terrain.crs: EPSG:xxxxx`, the projected system of the coordinates.");
  file.affine = {10, 1, 0, 60, 0, -1};  // small numbers, but cells of a degree
  write_raster(path("bed.tif"), file);
  EXPECT_THAT(refusal(request("bed.tif")), HasSubstr("its cells are 1 degrees wide, 111 km"));
  RasterRequest r = request("bed.tif");
  r.crs = "EPSG:32633";
  // At x = 10 UTM 33 is far outside its zone, so the lengths are off and another zone is taken;
  // what counts here: no refusal.
  EXPECT_NO_THROW(read_elevation(r));
}

TEST_F(GdalRaster, AnInvalidSystemIsNamed) {
  write_raster(path("bed.tif"), five_by_five());
  RasterRequest r = request("bed.tif");
  r.crs = "EPSG:999999";
  EXPECT_THAT(refusal(r), AllOf(HasSubstr("terrain.crs = EPSG:999999: not a coordinate system"),
                                HasSubstr("Write it like EPSG:32633.")));
  r.crs = "utm please";
  EXPECT_THAT(refusal(r), HasSubstr("terrain.crs = utm please: not a coordinate system"));
}

TEST_F(GdalRaster, AnOverrideReplacesTheFilesSystemAndSaysSo) {
  write_raster(path("bed.tif"), five_by_five());
  RasterRequest r = request("bed.tif");
  r.crs = "EPSG:32632";
  const RasterRead read = read_elevation(r);
  EXPECT_THAT(read.raster.grid.crs_wkt, HasSubstr("UTM zone 32N"));
  EXPECT_THAT(read.notes,
              Contains(HasSubstr("its own system WGS 84 / UTM zone 33N (EPSG:32633) replaced")));
}

TEST_F(GdalRaster, ALocalSystemIsRefused) {
  RasterFile file = five_by_five();
  file.crs = "LOCAL_CS[\"mine grid\",UNIT[\"metre\",1]]";
  write_raster(path("bed.tif"), file);
  EXPECT_THAT(refusal(request("bed.tif")), HasSubstr("'mine grid' is a local one"));
}

TEST_F(GdalRaster, FilesThatAreNoRastersAreRefused) {
  write("bed.tif", "not a raster at all");
  EXPECT_THAT(
      refusal(request("bed.tif")),
      AllOf(HasSubstr("terrain.raster = bed.tif: cannot be opened"), HasSubstr("gdalinfo")));
}

TEST_F(GdalRaster, ACutShortFileIsRefused) {
  RasterFile file = five_by_five();
  file.n_cols = file.n_rows = 100;
  file.values.assign(10000, 1);
  write_raster(path("bed.tif"), file);
  std::filesystem::resize_file(path("bed.tif"), 40000);
  EXPECT_THAT(refusal(request("bed.tif")), HasSubstr("terrain.raster = bed.tif: cannot be"));
}

TEST_F(GdalRaster, HugeRastersAreRefusedBeforeAllocation) {
  write("bed.vrt",
        "<VRTDataset rasterXSize='100000' rasterYSize='100000'><SRS>EPSG:32633</SRS>"
        "<GeoTransform>500000,1,0,4600000,0,-1</GeoTransform>"
        "<VRTRasterBand dataType='Float32' band='1'/></VRTDataset>");
  EXPECT_EQ(refusal(request("bed.vrt")),
            "terrain.raster = bed.vrt: 100000 x 100000 cells are too many (at most 400 million). "
            "Cut the area out or use larger cells.");
  write_raster(path("bed.tif"), five_by_five());
  RasterRequest r = request("bed.tif");
  r.cell_size_m = 1e-4;
  EXPECT_THAT(refusal(r), HasSubstr("500000 x 500000 cells are too many"));
}

TEST_F(GdalRaster, ARasterWithoutAnyElevationIsRefused) {
  RasterFile file = five_by_five();
  file.values.assign(25, -1);
  file.nodata = -1;
  write_raster(path("bed.tif"), file);
  EXPECT_THAT(refusal(request("bed.tif")), HasSubstr("holds no valid cell"));
}

TEST_F(GdalRaster, ARasterWithoutAPlaceIsRefused) {
  write("bed.pgm", "P5\n2 2\n255\nabcd");
  RasterRequest r = request("bed.pgm");
  EXPECT_THAT(refusal(r),
              HasSubstr("terrain.raster = bed.pgm: the file does not say where it lies"));
}

TEST_F(GdalRaster, OtherDriversReadTheSame) {
  write("bed.asc",
        "ncols 3\nnrows 2\nxllcorner 500000\nyllcorner 4600000\ncellsize 10\nNODATA_value -9999\n"
        "1 2 3\n4 -9999 6\n");
  RasterRequest r = request("bed.asc");
  r.crs = "EPSG:32633";
  const RasterRead read = read_elevation(r);
  EXPECT_EQ(read.raster.at(0, 2), 3);
  EXPECT_TRUE(std::isnan(read.raster.at(1, 1)));
  EXPECT_EQ(read.raster.grid.north_m, 4600020);
}

TEST_F(GdalRaster, RealTerrainKeepsEveryValue) {
  const auto file = shared("data/marsicano_tinitaly/marsicano_10m.tif");
  if (file.empty()) GTEST_SKIP() << "shared data marsicano_tinitaly is not there";
  const RasterRead read = read_elevation(request(file.string()));
  EXPECT_EQ(read.raster.grid.n_cols, 600);
  EXPECT_EQ(read.raster.grid.n_rows, 400);
  EXPECT_EQ(read.raster.grid.west_m, 403000);
  const auto [low, high] =
      std::minmax_element(read.raster.values.begin(), read.raster.values.end());
  EXPECT_NEAR(*low, 1016, 1);
  EXPECT_NEAR(*high, 2252, 1);
}

}  // namespace
}  // namespace sturz::test
