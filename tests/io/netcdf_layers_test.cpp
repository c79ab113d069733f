// SPDX-License-Identifier: Apache-2.0
#include "io/netcdf/netcdf_layers.hpp"

#include "io/files/io_error.hpp"
#include "io/files/text_files.hpp"
#include "io/gdal/gdal_raster.hpp"
#include "io/netcdf/grid_netcdf.hpp"
#include "io/netcdf/history_netcdf.hpp"
#include "io/netcdf/netcdf_file.hpp"
#include "tests/io/io_fixture.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <random>
#include <thread>

#if defined(__SANITIZE_ADDRESS__)
#define STURZ_LEAKS_ARE_SOUGHT 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define STURZ_LEAKS_ARE_SOUGHT 1
#endif
#endif
#ifdef STURZ_LEAKS_ARE_SOUGHT
#include <sanitizer/lsan_interface.h>
#endif

namespace sturz::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::vector<std::uint32_t> bits(const std::vector<float>& values) {
  std::vector<std::uint32_t> all;
  for (const float v : values) all.push_back(std::bit_cast<std::uint32_t>(v));
  return all;
}

/// What is allocated while one of these is there may leak.
struct NoLeakCheck {
#ifdef STURZ_LEAKS_ARE_SOUGHT
  NoLeakCheck() { __lsan_disable(); }
  ~NoLeakCheck() { __lsan_enable(); }
#else
  NoLeakCheck() = default;
  ~NoLeakCheck() = default;
#endif
  NoLeakCheck(const NoLeakCheck&) = delete;
  NoLeakCheck& operator=(const NoLeakCheck&) = delete;
};

/// 5 x 6 cells with every kind of layer.
LayerStack every_kind() {
  LayerStack s;
  s.grid = {6, 5, 403000.1, 4629500.3, 2.5, utm33_wkt()};
  s.attributes = {{"title", "Test maps"}, {"scenario", "a: 1\nb: µ"}};
  const auto values = [](std::size_t n, float scale) {
    std::vector<float> v(n);
    for (std::size_t i = 0; i < n; ++i)
      v[i] = scale * static_cast<float>(i) / static_cast<float>(n);
    v[n / 2] = nan_f;
    return v;
  };
  Layer count{"number_of_valid_members",
              {Quantity::members, Statistic::count},
              "valid members",
              "",
              "1",
              "",
              "",
              {},
              values(30, 300)};
  for (float& v : count.values) v = std::floor(v);
  Layer probability;
  probability.name = "probability_of_peak_thickness_above_threshold";
  probability.meaning = {Quantity::intensity, Statistic::probability, IntensityClass::high};
  probability.units = "1";
  probability.comment = "thresholds below half a particle are not resolved";
  probability.axis = {"thickness_threshold", "", "m", {0.1, 0.5, 2}};
  probability.values = values(90, 1);
  Layer quantile{"peak_speed_quantile",
                 {Quantity::speed, Statistic::quantile},
                 "peak speed",
                 "",
                 "m s-1",
                 "area: mean",
                 "",
                 {"quantile", "", "1", {0.05, 0.5, 0.95}},
                 values(90, 40)};
  Layer energy{"peak_energy_quantile",
               {Quantity::energy, Statistic::quantile},
               "peak energy",
               "",
               "J m-2",
               "",
               "",
               {"quantile", "", "1", {0.05, 0.5, 0.95}},
               values(90, 1e5F)};
  Layer mean{
      "deposit_mean", {Quantity::deposit, Statistic::mean}, "mean deposit", "", "m", "", "", {},
      values(30, 3)};
  Layer classes;
  classes.name = "matrix_field";
  classes.units = "1";
  classes.classes = {{4, "medium intensity low probability"}, {9, "strong"}};
  classes.values.assign(30, 4);
  s.layers = {count, probability, quantile, energy, mean, classes};
  return s;
}

class NetcdfLayers : public IoTest {
 protected:
  std::string written(const LayerStack& stack, const std::string& name = "hazard.nc") const {
    write_layers(path(name), stack);
    return path(name);
  }
  static ShellResult cf_lint(const std::string& file) {
    return shell("/usr/bin/python3 " STURZ_SOURCE_DIR "/tests/support/cf_lint.py " + file);
  }
  static bool has_python() {
    return shell("/usr/bin/python3 -c 'import netCDF4, xarray'").exit_code == 0;
  }
};

TEST_F(NetcdfLayers, RoundTripsEveryBit) {
  const LayerStack out = every_kind();
  const LayerStack in = read_layers(written(out));
  EXPECT_TRUE(in.grid.same_place(out.grid));
  EXPECT_EQ(in.grid.crs_wkt, out.grid.crs_wkt);
  ASSERT_EQ(in.layers.size(), out.layers.size());
  for (std::size_t i = 0; i < in.layers.size(); ++i) {
    EXPECT_EQ(in.layers[i].name, out.layers[i].name);
    EXPECT_EQ(in.layers[i].units, out.layers[i].units);
    EXPECT_EQ(in.layers[i].comment, out.layers[i].comment);
    EXPECT_EQ(in.layers[i].cell_methods, out.layers[i].cell_methods);
    EXPECT_EQ(in.layers[i].meaning, out.layers[i].meaning);
    EXPECT_EQ(in.layers[i].classes, out.layers[i].classes);
    EXPECT_EQ(in.layers[i].axis.name, out.layers[i].axis.name);
    EXPECT_EQ(in.layers[i].axis.values, out.layers[i].axis.values);
    EXPECT_EQ(bits(in.layers[i].values), bits(out.layers[i].values)) << in.layers[i].name;
  }
  EXPECT_THAT(in.attributes, ::testing::IsSupersetOf(out.attributes));
}

TEST_F(NetcdfLayers, RefuseAFileThatDoesNotSayWhatItsMapsShow) {
  const auto one_map = [&](const char* name, const char* attribute, const char* word) {
    const LayerStack s = every_kind();
    NetcdfWriter file(path(name));
    write_grid_attributes(file, s.grid);
    const GridDimensions place = write_grid(file, s.grid);
    const int map = file.variable("deposit_mean", NcType::float32, {place.y, place.x});
    if (attribute != nullptr) file.text(map, attribute, word);
    file.put(map, s.layers[4].values);
    file.commit();
    return message_of([&] { read_layers(path(name)); });
  };
  EXPECT_THAT(one_map("old.nc", nullptr, ""),
              AllOf(HasSubstr("old.nc: map 'deposit_mean' has no attribute sturz_quantity"),
                    HasSubstr("`sturz merge`")));
  EXPECT_THAT(one_map("new.nc", "sturz_quantity", "erosion"),
              HasSubstr("has the unknown sturz_quantity 'erosion'"));
}

TEST_F(NetcdfLayers, HoldTheHistoryOfTheirMember) {
  const MemberHistory out = made_up_history(5, true);
  write_layers(path("peaks.nc"), every_kind(), out);
  const MemberHistory in = read_history(NetcdfReader(path("peaks.nc")));
  ASSERT_EQ(in.rows.size(), out.rows.size());
  EXPECT_TRUE(in.has_states && in.has_temperature);
  for (std::size_t i = 0; i < in.rows.size(); ++i)
    for (const HistoryColumn& column : history_table())
      EXPECT_EQ(in.rows[i].*column.field, out.rows[i].*column.field) << column.name;
  EXPECT_EQ(read_layers(path("peaks.nc")).layers.size(), every_kind().layers.size())
      << "the history is no map";
  EXPECT_TRUE(read_history(NetcdfReader(written(every_kind()))).rows.empty());
  if (!has_python()) GTEST_SKIP() << "python3 with netCDF4 and xarray is not installed";
  const ShellResult lint = cf_lint(path("peaks.nc"));
  EXPECT_EQ(lint.exit_code, 0) << lint.output;
}

TEST_F(NetcdfLayers, TheSameLayersGiveTheSameBytes) {
  const std::string a = read_text(written(every_kind(), "a.nc"));
  const std::string b = read_text(written(every_kind(), "b.nc"));
  EXPECT_EQ(a == b, true);
}

TEST_F(NetcdfLayers, PassTheProjectsCfLint) {
  if (!has_python()) GTEST_SKIP() << "python3 with netCDF4 and xarray is not installed";
  const ShellResult lint = cf_lint(written(every_kind()));
  EXPECT_EQ(lint.exit_code, 0) << lint.output;
  LayerStack bare = every_kind();
  bare.grid.crs_wkt = "";
  const ShellResult bare_lint = cf_lint(written(bare, "bare.nc"));
  EXPECT_EQ(bare_lint.exit_code, 0) << bare_lint.output;
}

TEST_F(NetcdfLayers, CfLintFindsWhatIsWrong) {
  if (!has_python()) GTEST_SKIP() << "python3 with netCDF4 and xarray is not installed";
  LayerStack s = every_kind();
  s.layers[2].units = "furlong per fortnight?";
  s.layers[1].values[5] = 1.5F;
  s.layers[4].cell_methods = "nonsense";
  const ShellResult lint = cf_lint(written(s));
  EXPECT_EQ(lint.exit_code, 1);
  EXPECT_THAT(lint.output,
              AllOf(HasSubstr("peak_speed_quantile: units 'furlong per fortnight?' are not known"),
                    HasSubstr("probabilities reach from 0.0 to 1.5"),
                    HasSubstr("deposit_mean: cell_methods 'nonsense'")));
}

TEST_F(NetcdfLayers, XarrayFindsTheCoordinateSystem) {
  if (!has_python()) GTEST_SKIP() << "python3 with netCDF4 and xarray is not installed";
  const ShellResult opened = shell(
      "/usr/bin/python3 -c \"import xarray; d = xarray.open_dataset('" + written(every_kind()) +
      "', decode_coords='all'); v = d['probability_of_peak_thickness_above_threshold']; "
      "print(v.dims, sorted(v.coords), d.crs.grid_mapping_name, float(v.x[0]), float(v.y[0]), "
      "float(v.isel(thickness_threshold=2).isnull().sum()))\"");
  EXPECT_EQ(opened.exit_code, 0);
  EXPECT_EQ(opened.output,
            "('thickness_threshold', 'y', 'x') ['crs', 'thickness_threshold', 'x', 'y'] "
            "transverse_mercator 403001.35 4629499.05 0.0\n");
}

TEST_F(NetcdfLayers, GdalinfoShowsThePlaceAndTheCode) {
  const ShellResult info = shell("gdalinfo NETCDF:" + written(every_kind()) + ":deposit_mean");
  if (info.exit_code == 127) GTEST_SKIP() << "gdalinfo is not installed";
  EXPECT_THAT(info.output, AllOf(HasSubstr("ID[\"EPSG\",32633]"), HasSubstr("Size is 6, 5"),
                                 HasSubstr("Origin = (403000.09999999997671"),
                                 HasSubstr("Pixel Size = (2.5"), HasSubstr(",-2.5")));
  EXPECT_EQ(info.output.find("Warning"), std::string::npos) << info.output;
}

TEST_F(NetcdfLayers, ProjectionsOfTheWorldPassTheLint) {
  if (!has_python()) GTEST_SKIP() << "python3 with netCDF4 and xarray is not installed";
  std::string files;
  for (const int code : {32149, 2056, 3035, 31287, 3413, 3031, 5070, 28992, 2193, 3577, 32761}) {
    LayerStack s = every_kind();
    s.grid.crs_wkt = wkt2(code);
    files += " " + written(s, std::to_string(code) + ".nc");
  }
  const ShellResult lint = cf_lint(files);
  EXPECT_EQ(lint.exit_code, 0) << lint.output;
}

TEST_F(NetcdfLayers, PassByInBlocksInAnyOrder) {
  const LayerStack s = every_kind();
  const StackSource source(s);
  LayersFileWriter file(path("parts.nc"));
  file.begin(s);
  std::vector<float> values;
  for (const Window& w : {Window{3, 0, 2, 6}, Window{0, 4, 3, 2}, Window{0, 0, 3, 4}})
    for (std::size_t l = 0; l < s.layers.size(); ++l)
      for (std::size_t plane = 0; plane < s.layers[l].n_planes(); ++plane) {
        values.resize(w.n_cells());
        source.read(l, plane, w, values);
        file.put(l, plane, w, values);
      }
  EXPECT_FALSE(std::filesystem::exists(path("parts.nc"))) << "it has its name too early";
  file.commit();
  const LayerStack back = read_layers(path("parts.nc")), whole = read_layers(written(s));
  ASSERT_EQ(back.layers.size(), whole.layers.size());
  for (std::size_t l = 0; l < back.layers.size(); ++l) {
    EXPECT_EQ(back.layers[l].name, whole.layers[l].name);
    EXPECT_EQ(back.layers[l].units, whole.layers[l].units);
    ASSERT_EQ(back.layers[l].values.size(), whole.layers[l].values.size());
    EXPECT_EQ(std::memcmp(back.layers[l].values.data(), whole.layers[l].values.data(),
                          back.layers[l].values.size() * sizeof(float)),
              0);
  }
}

TEST_F(NetcdfLayers, ADiskThatFillsUpOnTheWayLeavesNothingAndTheNextFileIsWhole) {
  LayerStack s;
  s.grid = {600, 600, 403000, 4629500, 10, ""};
  Layer noise{"speed_mean", {Quantity::speed, Statistic::mean}, "", "", "m s-1", "", "", {}, {}};
  std::mt19937 random(1);
  for (int i = 0; i < 360000; ++i) noise.values.push_back(static_cast<float>(random()));
  s.layers = {noise};
  const auto write = [&](const std::string& name) {
    LayersFileWriter file(path(name));
    file.begin(s);
    for (int row = 0; row < 600; row += 128) {
      const int n = std::min(128, 600 - row);
      file.put(
          0, 0, {row, 0, n, 600},
          std::span(noise.values)
              .subspan(static_cast<std::size_t>(row) * 600, static_cast<std::size_t>(n) * 600));
    }
    file.commit();
  };
  {
    const SmallDisk disk(300000);
    [[maybe_unused]] const NoLeakCheck
        netcdf;  // it forgets its tables of a file that it cannot close
    EXPECT_THAT(message_of([&] { write("a.nc"); }), AllOf(HasSubstr("cannot write " + path("a.nc")),
                                                          HasSubstr("(File too large). A limit")));
  }
  EXPECT_THAT(names(), ::testing::IsEmpty());
  write("b.nc");
  EXPECT_EQ(read_layers(path("b.nc")).layers[0].values, noise.values);
}

TEST_F(NetcdfLayers, GdalReadsAMapBackAsTerrain) {
  LayerStack s = every_kind();
  s.layers = {s.layers[4]};
  s.layers[0].values[15] = 1;
  RasterRequest request;
  request.path = written(s);
  const Raster<double> bed = read_elevation(request).raster;
  EXPECT_NEAR(bed.grid.west_m, s.grid.west_m, 1e-9);
  EXPECT_NEAR(bed.grid.north_m, s.grid.north_m, 1e-9);
  EXPECT_EQ(bed.grid.n_rows, 5);
  for (std::size_t i = 0; i < bed.values.size(); ++i)
    EXPECT_EQ(static_cast<float>(bed.values[i]), s.layers[0].values[i]);
}

TEST_F(NetcdfLayers, LayersThatContradictEachOtherAreRefused) {
  LayerStack s = every_kind();
  s.layers[3].axis.values = {0.1, 0.5, 0.9};
  EXPECT_THAT(message_of([&] { write_layers(path("x.nc"), s); }),
              HasSubstr("axis 'quantile' has different values in two layers"));
  s = every_kind();
  s.layers[1].axis.values = {0.5, 0.1, 2};
  EXPECT_THAT(message_of([&] { write_layers(path("x.nc"), s); }),
              HasSubstr("axis 'thickness_threshold' does not increase strictly"));
  s = every_kind();
  s.layers[4].values.pop_back();
  EXPECT_THAT(message_of([&] { write_layers(path("x.nc"), s); }),
              HasSubstr("layer 'deposit_mean' has 29 values"));
  EXPECT_TRUE(names().empty());
}

TEST_F(NetcdfLayers, AFullDiskLeavesTheOldFileAndOneMessage) {
  const std::string file = written(every_kind());
  const std::string before = read_text(file);
  std::string message;
  {
    const SmallDisk disk(2000);
    message = message_of([&] { write_layers(file, every_kind()); });
  }
  EXPECT_THAT(message,
              AllOf(HasSubstr("cannot write " + file), HasSubstr("(File too large). A limit"),
                    HasSubstr("files already there are unharmed")));
  EXPECT_EQ(read_text(file) == before, true);
  EXPECT_THAT(names(), ::testing::ElementsAre("hazard.nc"));
  EXPECT_NO_THROW(written(every_kind(), "after.nc"));  // and the library still works
}

TEST_F(NetcdfLayers, DamagedFilesAreRefusedByName) {
  const std::string file = written(every_kind());
  write("text.nc", "not a netCDF file");
  EXPECT_THAT(message_of([&] { read_layers(path("text.nc")); }),
              AllOf(HasSubstr("text.nc: is not netCDF in the HDF5 layout"),
                    HasSubstr("Is the file complete?")));
  std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
  EXPECT_THAT(message_of([&] { read_layers(file); }), HasSubstr("hazard.nc: opening failed"));
}

TEST_F(NetcdfLayers, ThreadsMayWriteAndReadSideBySide) {
  std::vector<std::thread> threads;
  std::vector<int> good(4, 0);
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      for (int i = 0; i < 5; ++i) {
        const std::string file = path(std::to_string(t) + ".nc");
        write_layers(file, every_kind());
        good[static_cast<std::size_t>(t)] +=
            read_layers(file).layers.size() == every_kind().layers.size();
      }
    });
  for (auto& thread : threads) thread.join();
  EXPECT_THAT(good, ::testing::Each(5));
}

TEST_F(NetcdfLayers, DamageFoundInAnotherThreadPrintsNothing) {
  written(every_kind());
  write("text.nc", "not a netCDF file");
  write("cut.nc", read_text(path("hazard.nc")).substr(0, 3000));
  ::testing::internal::CaptureStderr();
  std::thread([&] {
    for (const char* name : {"text.nc", "cut.nc"}) EXPECT_THROW(read_layers(path(name)), IoError);
  }).join();
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace sturz::test
