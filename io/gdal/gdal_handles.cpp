// SPDX-License-Identifier: Apache-2.0
#include "io/gdal/gdal_handles.hpp"

#include "engine/core/error.hpp"
#include "io/gdal/input_trust.hpp"
#include "io/netcdf/netcdf_file.hpp"

#include <cpl_string.h>
#include <fmt/core.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>

namespace sturz {
namespace {

/// Of raster blocks that are read, in place of a share of the machine's memory: everything is read
/// once, from one end to the other.
constexpr long long block_cache_bytes = 128LL << 20;

/// Formats whose drivers call HDF5 or netCDF, which must not run beside our own calls.
bool rests_on_hdf5(const std::string& driver) {
  for (const char* name : {"netCDF", "HDF5", "HDF5Image", "BAG", "KEA", "S102", "GMT"})
    if (driver == name) return true;
  return false;
}

}  // namespace

GdalScope::GdalScope() : quiet_(CPLQuietErrorHandler) {
  static std::once_flag once;
  std::call_once(once, [] {
    GDALSetCacheMax64(block_cache_bytes);
    GDALAllRegister();
    close_network();
  });
  CPLErrorReset();
}

std::string gdal_reason(const char* otherwise) {
  std::string text = CPLGetLastErrorMsg();
  while (!text.empty() && (text.back() == '.' || text.back() == '\n')) text.pop_back();
  return text.empty() ? otherwise : text;
}

OpenDataset open_dataset(const std::string& path, const std::string& label, unsigned open_flags) {
  OpenDataset opened;
  GDALDriverH driver = GDALIdentifyDriverEx(path.c_str(), open_flags, nullptr, nullptr);
  if (driver != nullptr && rests_on_hdf5(GDALGetDescription(driver)))
    opened.hdf5 = std::unique_lock(netcdf_mutex());
  CPLErrorReset();
  opened.dataset.reset(
      GDALDataset::Open(path.c_str(), open_flags | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR));
  if (!opened.dataset)
    throw SetupError(fmt::format("{}: cannot be opened ({}). Does `{}` understand the file?", label,
                                 gdal_reason("no driver recognises it"),
                                 (open_flags & GDAL_OF_VECTOR) != 0 ? "ogrinfo" : "gdalinfo"));
  return opened;
}

std::vector<std::string> files_of(GDALDataset& dataset) {
  std::vector<std::string> files;
  char** list = dataset.GetFileList();
  for (char** name = list; name != nullptr && *name != nullptr; ++name) {
    std::error_code error;
    if (std::filesystem::is_regular_file(*name, error)) files.emplace_back(*name);
  }
  CSLDestroy(list);
  return files;
}

std::array<double, 6> affine_of(const Grid& grid) {
  return {grid.west_m, grid.cell_m, 0, grid.north_m, 0, -grid.cell_m};
}

DatasetPtr wrap_in_memory(void* values, GDALDataType type, int n_cols, int n_rows,
                          const double* affine) {
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("MEM");
  expect(driver != nullptr, "GDAL has its in-memory driver");
  DatasetPtr dataset(driver->Create("", n_cols, n_rows, 0, type, nullptr));
  expect(dataset != nullptr, "an in-memory raster without bands can be made");
  CPLStringList options;
  options.SetNameValue("DATAPOINTER",
                       fmt::format("{}", reinterpret_cast<std::uintptr_t>(values)).c_str());
  expect(dataset->AddBand(type, options.List()) == CE_None, "memory becomes a band");
  double copy[6];
  std::copy(affine, affine + 6, copy);
  dataset->SetGeoTransform(copy);
  return dataset;
}

}  // namespace sturz
