// SPDX-License-Identifier: Apache-2.0
#include "tests/io/io_fixture.hpp"

#include "io/gdal/cog.hpp"

#include <gdal_priv.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <fstream>
#include <memory>

namespace sturz::test {
namespace fs = std::filesystem;

IoTest::IoTest() {
  std::string pattern = (fs::temp_directory_path() / "sturz_io_XXXXXX").string();
  folder_ = mkdtemp(pattern.data());
}

IoTest::~IoTest() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

void IoTest::write(const std::string& name, const std::string& text) const {
  std::ofstream(folder_ / name, std::ios::binary) << text;
}

std::vector<std::string> IoTest::names() const {
  std::vector<std::string> all;
  for (const auto& entry : fs::recursive_directory_iterator(folder_))
    if (entry.is_regular_file()) all.push_back(fs::relative(entry.path(), folder_).string());
  std::sort(all.begin(), all.end());
  return all;
}

fs::path IoTest::shared(const std::string& name) {
  const fs::path file = fs::path(STURZ_SHARED_DIR) / name;
  return fs::exists(file) ? file : fs::path();
}

void write_raster(const std::string& path, const RasterFile& file) {
  GDALAllRegister();
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  const GDALDataType type = file.as_float32 ? GDT_Float32 : GDT_Float64;
  std::unique_ptr<GDALDataset> dataset(
      driver->Create(path.c_str(), file.n_cols, file.n_rows, 1, type, nullptr));
  ASSERT_NE(dataset, nullptr);
  auto affine = file.affine;
  dataset->SetGeoTransform(affine.data());
  if (!file.crs.empty()) {
    OGRSpatialReference crs;
    crs.SetFromUserInput(file.crs.c_str());
    crs.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    dataset->SetSpatialRef(&crs);
  }
  GDALRasterBand& band = *dataset->GetRasterBand(1);
  if (file.nodata) band.SetNoDataValue(*file.nodata);
  if (!file.unit.empty()) band.SetUnitType(file.unit.c_str());
  auto values = file.values;
  ASSERT_EQ(values.size(), static_cast<std::size_t>(file.n_cols) * file.n_rows);
  ASSERT_EQ(band.RasterIO(GF_Write, 0, 0, file.n_cols, file.n_rows, values.data(), file.n_cols,
                          file.n_rows, GDT_Float64, 0, 0, nullptr),
            CE_None);
}

RasterFile five_by_five() {
  RasterFile file;
  file.n_cols = file.n_rows = 5;
  file.affine = {500000, 10, 0, 4600050, 0, -10};
  for (int i = 0; i < 25; ++i) file.values.push_back(i);
  return file;
}

Raster<double> plane(int n_cols, int n_rows, double cell, double west, double north) {
  Raster<double> raster(Grid{n_cols, n_rows, west, north, cell, utm33_wkt()});
  for (int row = 0; row < n_rows; ++row)
    for (int col = 0; col < n_cols; ++col) raster.at(row, col) = 100 + col - 2 * row;
  return raster;
}

SceneOnAPlane::SceneOnAPlane() {
  scene.directory = folder().string();
  scene.terrain.raster = "bed.tif";
  scene.release.box = ReleaseBox{{500200, 500250}, {4600200, 4600250}};
  scene.release.thickness_m = Uncertain(4);
  write_geotiff(path("bed.tif"), plane(50, 40, 10, 500000, 4600400), {});
}

SmallDisk::SmallDisk(std::size_t bytes) {
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit limit{};
  getrlimit(RLIMIT_FSIZE, &limit);
  before_ = {limit.rlim_cur, limit.rlim_max};
  limit.rlim_cur = bytes;
  setrlimit(RLIMIT_FSIZE, &limit);
}

SmallDisk::~SmallDisk() {
  const rlimit limit{before_[0], before_[1]};
  setrlimit(RLIMIT_FSIZE, &limit);
}

ShellResult shell(const std::string& command) {
  ShellResult result;
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return result;
  std::array<char, 4096> block{};
  while (const std::size_t n = fread(block.data(), 1, block.size(), pipe))
    result.output.append(block.data(), n);
  const int status = pclose(pipe);
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return result;
}

MemberHistory made_up_history(std::size_t n_rows, bool with_states) {
  MemberHistory history;
  history.has_states = history.has_temperature = with_states;
  history.rows.resize(n_rows);
  float value = 0.25F;
  for (std::size_t i = 0; i < n_rows; ++i)
    for (const HistoryColumn& column : history_table())
      if (history.has(column.part)) history.rows[i].*column.field = value += 0.1F;
  return history;
}

MemberResult made_up_member(std::int64_t number) {
  MemberResult m;
  m.member = number;
  m.outcome = Outcome::settled;
  if (number % 2 == 1) m.censoring = Censoring::left_terrain;
  m.binding_limit = "acoustic";
  m.warnings = "thin flow: 2.7 layers";
  m.state_hash = 0xfedcba9876543210ULL + static_cast<std::uint64_t>(number);
  double value = 0.1 * static_cast<double>(number + 1);
  for (const ScalarInfo& scalar : scalar_table()) m.scalars.*scalar.field = value *= 1.37;
  m.history = made_up_history(7, number % 2 == 0);
  m.pass_seconds = {{"pair sweep", 0.1 * static_cast<double>(number + 1)},
                    {"peak maps, history, limits", 1e-9}};
  m.effect_seconds = {{"grain stress", 0.25 * static_cast<double>(number + 1)},
                      {"bed", 0.1},
                      {"bookkeeping", 1e-9}};
  m.grid = {12, 10, 500000.1, 4600000.3, 2.5, utm33_wkt()};
  m.window = {4, 5, 3, 4};
  for (int layer = 0; layer < n_peak_layers; ++layer)
    for (std::size_t i = 0; i < m.window.n_cells(); ++i)
      m.layers[static_cast<std::size_t>(layer)].push_back(0.1F * static_cast<float>(number + 1) +
                                                          10.0F * static_cast<float>(layer) +
                                                          static_cast<float>(i) / 3);
  if (!has_left(m.censoring)) m.layer(PeakLayer::left).clear();
  m.layer(PeakLayer::arrival)[0] = nan_f;
  m.layer(PeakLayer::speed)[1] = -0.0F;
  m.layer(PeakLayer::energy)[2] = 1e-42F;  // subnormal
  return m;
}

std::string feature(const std::string& type, const std::string& coordinates,
                    const std::string& properties) {
  return R"({"type":"Feature","properties":)" + properties + R"(,"geometry":{"type":")" + type +
         R"(","coordinates":)" + coordinates + "}}";
}

std::string square(double x, double y, double edge) {
  const std::array<std::array<double, 2>, 5> corners = {
      {{0, 0}, {edge, 0}, {edge, edge}, {0, edge}, {0, 0}}};
  std::string ring;
  for (const auto& [dx, dy] : corners) {
    ring += ring.empty() ? "[[" : ",[";
    ring += std::to_string(500000 + x + dx) + "," + std::to_string(4600000 + y + dy) + "]";
  }
  return ring + "]";
}

std::string collection(const std::string& features, const std::string& crs) {
  const std::string system =
      crs.empty()
          ? ""
          : R"("crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:)" + crs + "\"}},";
  return R"({"type":"FeatureCollection",)" + system + R"("features":[)" + features + "]}";
}

std::string wkt2(int epsg) {
  OGRSpatialReference crs;
  crs.importFromEPSG(epsg);
  char* text = nullptr;
  const char* options[] = {"FORMAT=WKT2_2019", "MULTILINE=NO", nullptr};
  crs.exportToWkt(&text, options);
  std::string wkt = text;
  CPLFree(text);
  return wkt;
}

std::string utm33_wkt() { return wkt2(32633); }

}  // namespace sturz::test
