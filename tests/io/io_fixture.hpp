// SPDX-License-Identifier: Apache-2.0
/// Small files for io tests: a folder that goes away, rasters by GDAL, messages of errors.
#pragma once

#include "engine/core/error.hpp"
#include "engine/simulation/member_result.hpp"
#include "engine/terrain/raster.hpp"
#include "scenarios/scenario.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace sturz::test {

class IoTest : public ::testing::Test {
 public:
  IoTest(const IoTest&) = delete;
  IoTest& operator=(const IoTest&) = delete;

 protected:
  IoTest();
  ~IoTest() override;

  std::filesystem::path folder() const { return folder_; }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  void write(const std::string& name, const std::string& text) const;
  std::vector<std::string> names() const;  ///< of all files, sorted

  /// File of the shared data, or an empty path when it is not there.
  static std::filesystem::path shared(const std::string& name);

 private:
  std::filesystem::path folder_;
};

/// A scene on 50 x 40 cells of 10 m, south-west corner at 500000, 4600000 of UTM 33N.
class SceneOnAPlane : public IoTest {
 protected:
  SceneOnAPlane();
  Scenario scene;
};

/// What a raster file shall hold.
struct RasterFile {
  int n_cols = 0, n_rows = 0;
  std::array<double, 6> affine{0, 1, 0, 0, 0, -1};
  std::string crs = "EPSG:32633";  ///< empty: none
  std::optional<double> nodata;
  std::vector<double> values;  ///< as stored, first row first
  std::string unit;
  bool as_float32 = false;
};
void write_raster(const std::string& path, const RasterFile& file);

/// 5 x 5 cells of 10 m with the values 0, 1, 2, ... 24, north-west corner at 500000, 4600050.
RasterFile five_by_five();

/// A plane on a grid of square cells, UTM 33N.
Raster<double> plane(int n_cols, int n_rows, double cell, double west, double north);

/// Text of the SetupError that `call` throws; fails the test if it throws none.
template <class Call>
std::string message_of(Call call) {
  try {
    call();
  } catch (const SetupError& error) {
    return error.what();
  }
  ADD_FAILURE() << "no SetupError";
  return "";
}

/// A GeoJSON feature.
std::string feature(const std::string& type, const std::string& coordinates,
                    const std::string& properties = "{}");
/// A ring: a square of `edge` metres whose south-west corner lies x, y from 500000, 4600000.
std::string square(double x, double y, double edge);
/// GeoJSON of features in a system; empty: none is named.
std::string collection(const std::string& features, const std::string& crs = "EPSG::32633");

/// Largest size of a file that this process may write, while this lives: a disk that fills up.
class SmallDisk {
 public:
  explicit SmallDisk(std::size_t bytes);
  ~SmallDisk();
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

 private:
  std::array<unsigned long, 2> before_{};
};

/// Exit code and output of a shell command.
struct ShellResult {
  int exit_code = -1;
  std::string output;
};
ShellResult shell(const std::string& command);

/// Rows in which no two numbers are equal.
MemberHistory made_up_history(std::size_t n_rows, bool with_states);
/// A member with maps over a 3 x 4 window of a 10 x 12 grid; values differ by member.
MemberResult made_up_member(std::int64_t number);

/// WKT2:2019 of an EPSG code.
std::string wkt2(int epsg);
std::string utm33_wkt();

}  // namespace sturz::test
