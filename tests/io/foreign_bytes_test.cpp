// SPDX-License-Identifier: Apache-2.0
// Files whose numbers make no sense: each is refused by name before a number becomes an index or a
// size. What the fuzz targets found stands here.
#include "io/files/io_error.hpp"
#include "io/files/seal.hpp"
#include "io/gdal/gdal_raster.hpp"
#include "io/gdal/gdal_vector.hpp"
#include "io/members/member_file.hpp"
#include "io/members/member_store.hpp"
#include "io/netcdf/grid_netcdf.hpp"
#include "io/netcdf/netcdf_file.hpp"
#include "io/netcdf/netcdf_layers.hpp"
#include "io/site/bed/bed_raster.hpp"
#include "io/site/thickness_raster.hpp"
#include "io/site/zone_cells.hpp"
#include "tests/io/io_fixture.hpp"
#include "tests/support/netcdf_document.hpp"

#include <netcdf.h>

#include <cmath>
#include <limits>

namespace sturz::test {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;

using Affine = std::array<double, 6>;
constexpr double inf = std::numeric_limits<double>::infinity();

class ForeignBytes : public IoTest {
 protected:
  RasterRequest request(const RasterFile& file) const {
    write_raster(path("in.tif"), file);
    RasterRequest r;
    r.path = path("in.tif");
    return r;
  }
  /// A member one of whose attributes has another number.
  std::string changed_member(const std::string& attribute, double number) const {
    write_member(folder(), made_up_member(3));
    Document document = read_document(path("000003.nc"));
    for (Attribute& a : document.attributes)
      if (a.name == attribute) a.numbers = {number};
    const std::vector<unsigned char> bytes = bytes_of(document);
    // Sealed, as if this program had written such a thing.
    write("000003.nc",
          std::string(bytes.begin(), bytes.end()) + seal_of(std::as_bytes(std::span(bytes))));
    return path("000003.nc");
  }
  static void expect_refused(const std::string& file, const std::string& why) {
    try {
      read_member(file);
      ADD_FAILURE() << "no IoError: " << why;
    } catch (const IoError& error) {
      EXPECT_THAT(error.what(), AllOf(HasSubstr("000003.nc"), HasSubstr(why)));
    }
    const MemberStore store(std::filesystem::path(file).parent_path());
    EXPECT_THAT(store.members(), ::testing::IsEmpty());
    EXPECT_THAT(store.problems(), Contains(HasSubstr(why)));
  }
};

const std::vector<Affine>& absurd_places() {
  static const std::vector<Affine> all = {
      {500000, 1e300, 0, 4600050, 0, -10},    {500000, 10, 0, 4600050, 0, -1e300},
      {1e300, 10, 0, 4600050, 0, -10},        {500000, 10, 0, -1e18, 0, -10},
      {500000, 1e-300, 0, 4600050, 0, -10},   {500000, 1e-9, 0, 4600050, 0, -1e-9},
      {500000, 1.7e308, 0, 4600050, 0, -10},  {500000, 10, 1e200, 4600050, 1e-200, -10},
      {500000, 10, 0, 14600050, 0, -4e6},  // in UTM, yet too large to be measured there
      {500000, 2e9, 1e10, 4600050, -1e9, -10}};
  return all;
}

TEST_F(ForeignBytes, AbsurdGeotransformsAreRefused) {
  const Grid terrain{60, 60, 499813.3, 4600211.7, 7, utm33_wkt()};
  for (const Affine& affine : absurd_places()) {
    RasterFile file = five_by_five();
    file.affine = affine;
    const RasterRequest r = request(file);
    const auto refusal = AllOf(HasSubstr("in.tif"), HasSubstr("broken geotransform"));
    EXPECT_THAT(message_of([&] { read_elevation(r); }), refusal) << affine[1];
    if (affine[5] == -4e6) continue;  // a thickness is not measured
    BedRasterLimits limits;
    limits.key = find_key("basal.friction_coefficient");
    EXPECT_THAT(message_of([&] { BedRasterFile(r, limits, terrain); }), refusal) << affine[1];
    EXPECT_THAT(message_of([&] { read_thickness(r, terrain); }), refusal) << affine[1];
  }
}

TEST_F(ForeignBytes, AThicknessFarFromTheTerrainIsSaidToLieOutside) {
  RasterFile file = five_by_five();
  // Two hundred billion of the terrain's cells away, on each side of it.
  for (const Affine& affine : {Affine{9e8, 10, 0, 4600050, 0, -10},
                               {-9e8, 10, 0, -9e8, 0, -10},
                               {500000, 10, 0, 9e8, 0, -10},
                               {-9e8, 3e8, 0, 9e8, 0, -3e8}}) {
    file.affine = affine;
    const Grid terrain{60, 60, 499813.3, 4600211.7, 0.005, utm33_wkt()};
    EXPECT_THAT(message_of([&] { read_thickness(request(file), terrain); }),
                HasSubstr("lie outside the terrain"));
  }
}

TEST_F(ForeignBytes, ScalesBeyondAllSenseLeaveNoElevation) {
  RasterFile file = five_by_five();
  RasterRequest r = request(file);
  const ShellResult made = shell("gdal_translate -q -of GTiff -a_scale 1e300 -a_offset 1 " +
                                 path("in.tif") + " " + path("scaled.tif"));
  ASSERT_EQ(made.exit_code, 0) << made.output;
  r.path = path("scaled.tif");
  const std::vector<double> values = read_elevation(r).raster.values;
  EXPECT_EQ(values[0], 1);
  EXPECT_TRUE(std::isnan(values[1])) << values[1];
}

TEST_F(ForeignBytes, PolygonsBeyondTheEarthAreRefused) {
  const Grid terrain{10, 10, 500000, 4600100, 10, utm33_wkt()};
  for (const char* far : {"1e300", "-1e12", "1e999"}) {
    const std::string ring =
        std::string("[[500000,4600000],[") + far + ",4600000],[500050,4600050],[500000,4600000]]";
    write("far.geojson", collection(feature("Polygon", "[" + ring + "]")));
    PolygonRequest r;
    r.path = path("far.geojson");
    const auto refusal = AllOf(HasSubstr("far.geojson"), HasSubstr("no place on the earth"));
    EXPECT_THAT(message_of([&] { read_release_polygons(r, terrain); }), refusal) << far;
    EXPECT_THAT(message_of([&] { read_zone_cells(r, terrain); }), refusal) << far;
  }
}

TEST_F(ForeignBytes, AChangedAttributeThatMakesSenseIsRead) {
  EXPECT_EQ(read_member(changed_member("window_row0", 2)).window.row0, 2);
}

TEST_F(ForeignBytes, AMembersWindowMustLieInItsGrid) {
  expect_refused(changed_member("window_row0", 0x1p40), "window_row0");
  expect_refused(changed_member("window_col0", -1), "window_col0");
  expect_refused(changed_member("window_n_rows", -3), "window_n_rows");
  expect_refused(changed_member("window_row0", std::numeric_limits<int>::max()),
                 "reach beyond its grid");
  expect_refused(changed_member("window_n_cols", 0x1p30), "reach beyond its grid");
}

TEST_F(ForeignBytes, AMembersGridMustBeOne) {
  for (const auto& [name, value] :
       std::vector<std::pair<const char*, double>>{{"grid_n_cols", 0x1p62},
                                                   {"grid_n_rows", -1},
                                                   {"grid_cell_m", 0},
                                                   {"grid_cell_m", inf},
                                                   {"grid_west_m", std::nan("")},
                                                   {"grid_north_m", -1e18}})
    expect_refused(changed_member(name, value), "its grid of");
}

TEST_F(ForeignBytes, AMapOfAnotherShapeIsRefused) {
  write_member(folder(), made_up_member(3));
  const NetcdfReader file(path("000003.nc"));
  std::vector<float> out(100);
  EXPECT_THROW(file.floats("peak_speed", {0}, {2}, out), IoError);
  EXPECT_THROW(file.floats("peak_speed", {0, 0, 0}, {1, 1, 1}, out), IoError);
  EXPECT_THROW(file.floats("peak_speed", {0, 0}, {std::size_t{1} << 63, 4}, out), IoError);
  EXPECT_THROW(file.floats("peak_speed", {3, 0}, {1, 4}, out), IoError);
  EXPECT_THROW(file.floats("peak_speed", {0, 0}, {3, 4}, std::span(out).first(11)), IoError);
  EXPECT_NO_THROW(file.floats("peak_speed", {0, 0}, {3, 4}, std::span(out).first(12)));
}

TEST_F(ForeignBytes, WhatAHeaderPromisesMustFitIntoTheFile) {
  int id = -1, dimension = -1, variable = -1;
  ASSERT_EQ(nc_create(path("long.nc").c_str(), NC_NETCDF4, &id), NC_NOERR);
  ASSERT_EQ(nc_def_dim(id, "time", std::size_t{1} << 45, &dimension), NC_NOERR);
  ASSERT_EQ(nc_def_var(id, "speed", NC_FLOAT, 1, &dimension, &variable), NC_NOERR);
  const std::size_t chunk = 1024;
  ASSERT_EQ(nc_def_var_chunking(id, variable, NC_CHUNKED, &chunk), NC_NOERR);
  ASSERT_EQ(nc_close(id), NC_NOERR);
  const NetcdfReader file(path("long.nc"));
  EXPECT_THROW(file.doubles("speed"), IoError);
  EXPECT_THROW(file.integers("speed"), IoError);
  EXPECT_THROW(file.require_room(1e12, "speed"), IoError);
}

TEST_F(ForeignBytes, AMapThatIsNotOnItsFilesGridIsRefused) {
  {
    NetcdfWriter file(folder() / "maps.nc");
    write_grid_attributes(file, {4, 3, 0, 30, 10, ""});
    const int y = file.dimension("y", 3), x = file.dimension("x", 5);
    file.put(file.variable("speed", NcType::float32, {y, x}), std::vector<float>(15, 1.0F));
    file.commit();
  }
  EXPECT_THROW(read_layers(path("maps.nc")), IoError);
}

}  // namespace
}  // namespace sturz::test
