// SPDX-License-Identifier: Apache-2.0
#include "io/gdal/cog.hpp"

#include "engine/core/error.hpp"
#include "io/files/atomic_file.hpp"
#include "io/files/io_error.hpp"
#include "io/files/stored_count.hpp"
#include "io/gdal/crs.hpp"
#include "io/gdal/gdal_handles.hpp"

#include <cpl_string.h>
#include <cpl_vsi.h>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace sturz {
namespace fs = std::filesystem;
namespace {

/// A file in GDAL's memory that goes away with the scope.
struct MemoryFile {
  std::string name;
  explicit MemoryFile(const void* unique) : name(fmt::format("/vsimem/sturz/{}.tif", unique)) {}
  ~MemoryFile() { VSIUnlink(name.c_str()); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
};

/// Encodes `dataset` by `driver_name` in memory and writes the bytes in one stroke.
void write_encoded(const fs::path& target, GDALDataset& dataset, const char* driver_name,
                   const CPLStringList& options) {
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName(driver_name);
  expect(driver != nullptr, "GDAL has its GeoTIFF drivers");
  const MemoryFile memory(&dataset);
  CPLErrorReset();
  DatasetPtr encoded(
      driver->CreateCopy(memory.name.c_str(), &dataset, FALSE, options.List(), nullptr, nullptr));
  const bool made = encoded != nullptr;
  encoded.reset();
  vsi_l_offset size = 0;
  const GByte* bytes = VSIGetMemFileBuffer(memory.name.c_str(), &size, FALSE);
  if (!made || bytes == nullptr)
    throw IoError(fmt::format("cannot make {} ({}). Is there enough memory?", target.string(),
                              gdal_reason()));
  write_bytes_atomic(target, std::as_bytes(std::span(bytes, static_cast<std::size_t>(size))));
}

void set_place(GDALDataset& dataset, const Grid& grid) {
  if (grid.crs_wkt.empty()) return;
  const OGRSpatialReference crs = crs_from_wkt(grid.crs_wkt);
  dataset.SetSpatialRef(&crs);
}

std::string plane_name(const Layer& layer, std::size_t plane) {
  if (layer.axis.values.empty()) return layer.name + ".tif";
  return fmt::format("{}_{:g}.tif", layer.name, layer.axis.values[plane]);
}

void describe(GDALDataset& dataset, const Layer& layer, std::size_t plane,
              const LayerStack& stack) {
  for (const auto& [name, value] : stack.attributes)
    dataset.SetMetadataItem(name.c_str(), value.c_str());
  GDALRasterBand& band = *dataset.GetRasterBand(1);
  band.SetDescription(layer.name.c_str());
  band.SetUnitType(layer.units.c_str());
  const auto item = [&](const char* name, const std::string& value) {
    if (!value.empty()) band.SetMetadataItem(name, value.c_str());
  };
  item("sturz_quantity", std::string(to_string(layer.meaning.quantity)));
  item("sturz_statistic", std::string(to_string(layer.meaning.statistic)));
  item("long_name", layer.long_name);
  item("cell_methods", layer.cell_methods);
  item("comment", layer.comment);
  if (!layer.axis.values.empty())
    item(layer.axis.name.c_str(),
         fmt::format("{:g} {}", layer.axis.values[plane], layer.axis.units));
}

CPLStringList cog_options(bool is_count) {
  CPLStringList options;
  options.SetNameValue("COMPRESS", "DEFLATE");
  options.SetNameValue("PREDICTOR", "YES");
  options.SetNameValue("NUM_THREADS", "1");
  options.SetNameValue("BIGTIFF", "IF_SAFER");
  options.SetNameValue("OVERVIEW_RESAMPLING", is_count ? "NEAREST" : "AVERAGE");
  return options;
}

void write_plane(const fs::path& target, const LayerStack& stack, const Layer& layer,
                 std::size_t plane) {
  const Grid& grid = stack.grid;
  const auto first = layer.values.begin() + static_cast<std::ptrdiff_t>(plane * grid.n_cells());
  const auto end = first + static_cast<std::ptrdiff_t>(grid.n_cells());
  std::vector<float> floats;
  std::vector<std::int32_t> counts;
  if (layer.is_count())
    std::transform(first, end, std::back_inserter(counts), stored_count);
  else
    floats.assign(first, end);
  void* values = layer.is_count() ? static_cast<void*>(counts.data()) : floats.data();
  const DatasetPtr dataset = wrap_in_memory(values, layer.is_count() ? GDT_Int32 : GDT_Float32,
                                            grid.n_cols, grid.n_rows, affine_of(grid).data());
  dataset->GetRasterBand(1)->SetNoDataValue(layer.is_count() ? no_count : nan_d);
  set_place(*dataset, grid);
  describe(*dataset, layer, plane, stack);
  write_encoded(target, *dataset, "COG", cog_options(layer.is_count()));
}

}  // namespace

std::vector<std::string> cog_names(const LayerStack& stack) {
  std::vector<std::string> names;
  for (const Layer& layer : stack.layers)
    for (std::size_t plane = 0; plane < layer.n_planes(); ++plane)
      names.push_back(plane_name(layer, plane));
  return names;
}

std::vector<fs::path> write_cogs(const fs::path& folder, const LayerStack& stack) {
  const GdalScope scope;
  make_folder(folder);
  std::vector<fs::path> written;
  for (const Layer& layer : stack.layers) {
    require(layer.values.size() == layer.n_planes() * stack.grid.n_cells(),
            fmt::format("layer '{}' does not fill its planes. Fill every plane.", layer.name));
    for (std::size_t plane = 0; plane < layer.n_planes(); ++plane) {
      written.push_back(folder / plane_name(layer, plane));
      write_plane(written.back(), stack, layer, plane);
    }
  }
  return written;
}

void write_geotiff(const fs::path& file, const Raster<double>& raster, const TextPairs& metadata) {
  const GdalScope scope;
  std::vector<double> values = raster.values;  // GDAL wants memory that it may write to
  const DatasetPtr dataset = wrap_in_memory(values.data(), GDT_Float64, raster.grid.n_cols,
                                            raster.grid.n_rows, affine_of(raster.grid).data());
  dataset->GetRasterBand(1)->SetNoDataValue(nan_d);
  dataset->GetRasterBand(1)->SetUnitType("m");
  for (const auto& [name, value] : metadata) dataset->SetMetadataItem(name.c_str(), value.c_str());
  set_place(*dataset, raster.grid);
  CPLStringList options;
  options.SetNameValue("COMPRESS", "DEFLATE");
  options.SetNameValue("PREDICTOR", "3");
  options.SetNameValue("TILED", "YES");
  options.SetNameValue("BIGTIFF", "IF_SAFER");
  write_encoded(file, *dataset, "GTiff", options);
}

}  // namespace sturz
