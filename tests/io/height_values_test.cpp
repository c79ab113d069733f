// SPDX-License-Identifier: Apache-2.0
// What stored numbers become: units, directions, fill values, pictures.
#include "io/gdal/gdal_raster.hpp"
#include "io/site/thickness_raster.hpp"
#include "tests/io/typed_raster.hpp"

#include <algorithm>
#include <cmath>

namespace sturz::test {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class HeightValues : public IoTest {
 protected:
  RasterRequest request(const TypedRaster& r) const {
    write_typed(path("bed.tif"), r);
    RasterRequest request;
    request.path = "bed.tif";
    request.directory = folder().string();
    return request;
  }
  RasterRead read(const TypedRaster& r, const std::string& crs = "") const {
    RasterRequest wanted = request(r);
    wanted.crs = crs;
    return read_elevation(wanted);
  }
  std::string refusal(const TypedRaster& r) const {
    const RasterRequest wanted = request(r);
    return message_of([&] { read_elevation(wanted); });
  }
  static TypedRaster flat(double value, GDALDataType type = GDT_Float32) {
    TypedRaster r = slope(20);
    r.values.assign(400, value);
    r.type = type;
    return r;
  }
  static std::size_t blanks(const RasterRead& read) {
    const auto& v = read.raster.values;
    return static_cast<std::size_t>(
        std::count_if(v.begin(), v.end(), [](double z) { return std::isnan(z); }));
  }
};

TEST_F(HeightValues, FeetAreNamedByTheKeysVerticalSystem) {
  TypedRaster r = flat(3000);
  r.crs.clear();
  // UTM in metres, heights in US survey feet: the place stays, the heights change.
  const RasterRead survey = read(r, "EPSG:32618+6360");
  EXPECT_NEAR(survey.raster.values[210], 3000 * 1200.0 / 3937, 1e-9);
  EXPECT_THAT(survey.notes, Contains(HasSubstr("from US survey foot to metres")));
  EXPECT_THAT(survey.warnings, IsEmpty());
  const RasterRead foot = read(r, "EPSG:32618+8228");  // NAVD88 in international feet
  EXPECT_NEAR(foot.raster.values[210], 914.4, 1e-9);
  EXPECT_NEAR(read(r, "EPSG:32618+5703").raster.values[210], 3000, 1e-9);  // NAVD88 in metres
}

TEST_F(HeightValues, FeetOfTheMapAloneAreAskedAbout) {
  TypedRaster r = flat(3000);
  r.crs.clear();
  r.west = 980000, r.north = 200000;
  const RasterRead read = this->read(r, "EPSG:2263");  // New York, US survey feet
  EXPECT_NEAR(read.raster.values[read.raster.values.size() / 2], 3000, 1e-6);
  EXPECT_THAT(read.warnings, Contains(AllOf(HasSubstr("its map is in US survey foot"),
                                            HasSubstr("taken as metres"))));
}

TEST_F(HeightValues, TheSystemOfTheKeyOverrulesTheBandsWordAndSaysSo) {
  TypedRaster r = flat(1000);
  r.crs = "EPSG:32633+5773";  // EGM96 in metres: the band says metre
  const RasterRead read = this->read(r, "EPSG:32633+6360");
  EXPECT_NEAR(read.raster.values[7], 1000 * 1200.0 / 3937, 1e-9);
  EXPECT_THAT(read.warnings, Contains(HasSubstr("the system's unit is used")));
}

TEST_F(HeightValues, DepthsBecomeHeights) {
  TypedRaster r = slope(20);
  r.crs = "EPSG:32633+5715";  // MSL depth
  const RasterRead read = this->read(r);
  EXPECT_NEAR(read.raster.values[0], -r.values[0], 1e-4);
  EXPECT_THAT(read.warnings, Contains(HasSubstr("points down, so its values are depths; turned "
                                                "into heights of -")));
  // The way out that the warning names.
  EXPECT_NEAR(this->read(r, "EPSG:32633").raster.values[0], r.values[0], 1e-4);
  r.crs = "EPSG:32633";  // depths by the key alone
  EXPECT_NEAR(this->read(r, "EPSG:32633+5715").raster.values[0], -r.values[0], 1e-4);
}

TEST_F(HeightValues, FillValuesOfEveryTypeBecomeNodata) {
  const auto with = [&](GDALDataType type, double fill) {
    TypedRaster r = slope(20);
    r.type = type;
    for (double& v : r.values) v = std::round(v);
    r.values[30] = r.values[31] = fill;
    return r;
  };
  for (const auto& [type, fill] : {std::pair{GDT_Float32, 1e20},
                                   {GDT_Float64, 1e20},
                                   {GDT_Float32, 32767.0},
                                   {GDT_Int16, 32767.0},
                                   {GDT_UInt16, 65535.0},
                                   {GDT_Float32, 65535.0},
                                   {GDT_Float32, -12000.0},
                                   {GDT_Int32, -2147483648.0},
                                   {GDT_Float32, 9999.0},
                                   {GDT_Int16, -32768.0},
                                   {GDT_Float32, -9999.0}}) {
    const RasterRead read = this->read(with(type, fill));
    EXPECT_EQ(blanks(read), 2U) << fill;
    EXPECT_THAT(read.notes, Contains(HasSubstr("2 cells hold"))) << fill;
  }
}

TEST_F(HeightValues, LimitsAreThoseOfTheEarthInMetres) {
  TypedRaster r = slope(20);
  r.type = GDT_Int32;
  r.scale = 0.01;
  for (double& v : r.values) v = std::round(-v * 100);  // -500 to -700 m, stored as centimetres
  const RasterRead sea = read(r);
  EXPECT_EQ(blanks(sea), 0U);
  EXPECT_NEAR(sea.raster.values[0], r.values[0] / 100, 1e-9);
  r.scale = 1;
  r.type = GDT_Float32;
  std::fill(r.values.begin(), r.values.end(), 8848);
  r.values[5] = 9001;
  r.values[6] = -10935;
  const RasterRead peak = read(r);
  EXPECT_EQ(blanks(peak), 1U);
  EXPECT_EQ(peak.raster.values[6], -10935);
}

TEST_F(HeightValues, AWrongUnitOfAllIsRefused) {
  EXPECT_THAT(refusal(flat(145000)), AllOf(HasSubstr("values reach from 145000 to 145000 m"),
                                           HasSubstr("centimetres or feet")));
}

TEST_F(HeightValues, PicturesAreRefused) {
  TypedRaster r = flat(200, GDT_Byte);
  r.bands = 3;
  r.options = {"PHOTOMETRIC=RGB"};
  EXPECT_THAT(refusal(r), HasSubstr("is a colour picture (3 bands, the first is Red"));
  r.type = GDT_UInt16;
  EXPECT_THAT(refusal(r), HasSubstr("is a colour picture"));
  TypedRaster grey = flat(200, GDT_Byte);
  EXPECT_THAT(read(grey).warnings, Contains(HasSubstr("is it a hillshade")));
  TypedRaster bands = slope(20);  // heights and their error, say
  bands.bands = 2;
  EXPECT_THAT(read(bands).notes, Contains(HasSubstr("band 1 of 2 is used")));
}

TEST_F(HeightValues, MasksAndCentimetresAreNoThickness) {
  const Grid ground{60, 60, 500000, 4600000, 10, utm33_wkt()};
  const auto thickness = [&](double value, GDALDataType type, double factor = 1) {
    TypedRaster r = slope(20);
    r.type = type;
    std::fill(r.values.begin(), r.values.end(), 0);
    for (int row = 5; row < 10; ++row)
      for (int col = 5; col < 10; ++col) r.values[row * 20 + col] = value;
    RasterRequest wanted = request(r);
    wanted.key = "release.thickness_raster";
    wanted.factor = factor;
    return wanted;
  };
  const RasterRequest mask = thickness(255, GDT_Byte);
  EXPECT_THAT(message_of([&] { read_thickness(mask, ground); }),
              HasSubstr("all 25 cells above zero hold 255 (a mask"));
  EXPECT_NEAR(read_thickness(thickness(255, GDT_Byte, 2.0 / 255), ground).volume_m3, 5000, 1e-6);
  const ThicknessRead metres = read_thickness(thickness(4, GDT_Float32), ground);
  EXPECT_THAT(metres.warnings, IsEmpty());
  const ThicknessRead cm = read_thickness(thickness(400, GDT_Float32), ground);
  EXPECT_THAT(cm.warnings, Contains(HasSubstr("set release.thickness_factor: 0.01")));
}

}  // namespace
}  // namespace sturz::test
