// SPDX-License-Identifier: Apache-2.0
#include "io/gdal/cog.hpp"

#include "engine/core/error.hpp"
#include "io/files/atomic_file.hpp"
#include "io/files/io_error.hpp"
#include "io/gdal/crs.hpp"
#include "io/gdal/gdal_handles.hpp"
#include "io/gdal/planes/plane_dataset.hpp"
#include "scenarios/layers/plane_name.hpp"

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

/// GDAL asks now and then whether it shall go on.
int go_on(double /*share*/, const char* /*message*/, void* cancel) {
  return static_cast<const CancelFlag*>(cancel)->raised() ? FALSE : TRUE;
}

/// Encodes `dataset` by `driver_name` in memory and writes the bytes in one stroke.
void write_encoded(const fs::path& target, GDALDataset& dataset, const char* driver_name,
                   const CPLStringList& options, CancelFlag cancel = {}) {
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName(driver_name);
  expect(driver != nullptr, "GDAL has its GeoTIFF drivers");
  const MemoryFile memory(&dataset);
  CPLErrorReset();
  DatasetPtr encoded(
      driver->CreateCopy(memory.name.c_str(), &dataset, FALSE, options.List(), go_on, &cancel));
  const bool made = encoded != nullptr;
  encoded.reset();
  cancel.check();
  if (const auto* plane = dynamic_cast<const PlaneDataset*>(&dataset)) plane->rethrow();
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

void describe(GDALDataset& dataset, const Layer& layer, std::size_t plane,
              const LayerStack& stack) {
  for (const auto& [name, value] : stack.attributes)
    dataset.SetMetadataItem(name.c_str(), value.c_str());
  GDALRasterBand& band = *dataset.GetRasterBand(1);
  band.SetDescription(layer.name.c_str());
  const auto item = [&](const char* name, const std::string& value) {
    if (!value.empty()) band.SetMetadataItem(name, value.c_str());
  };
  item("sturz_quantity", std::string(to_string(layer.meaning.quantity)));
  item("sturz_statistic", std::string(to_string(layer.meaning.statistic)));
  item("long_name", layer.long_name);
  item("cell_methods", layer.cell_methods);
  item("comment", layer.comment);
  if (layer.confidence > 0) item("confidence_level", fmt::format("{}", layer.confidence));
  if (layer.n_censored > 0) item("sturz_censored_members", std::to_string(layer.n_censored));
  if (!layer.axis.values.empty())
    item(layer.axis.name.c_str(), fmt::format("{} {}", layer.axis.values[plane], layer.axis.units));
}

/// Between two classes lies none: their overviews take one of the four.
CPLStringList cog_options(const Layer& layer) {
  CPLStringList options;
  options.SetNameValue("COMPRESS", "DEFLATE");
  options.SetNameValue("PREDICTOR", "YES");
  options.SetNameValue("NUM_THREADS", "1");
  options.SetNameValue("BIGTIFF", "IF_SAFER");
  options.SetNameValue("OVERVIEW_RESAMPLING", layer.classes.empty() ? "AVERAGE" : "MODE");
  return options;
}

}  // namespace

std::vector<PlaneFile> cog_files(const fs::path& folder, const LayerStack& about) {
  std::vector<PlaneFile> files;
  for (std::size_t l = 0; l < about.layers.size(); ++l) {
    const Layer& layer = about.layers[l];
    if (layer.is_count()) continue;
    const fs::path place = layer.meaning.is_bound() ? folder / "bounds" : folder;
    for (std::size_t plane = 0; plane < layer.n_planes(); ++plane)
      files.push_back({l, plane, place / (plane_file_name(layer, plane) + ".tif")});
  }
  return files;
}

void write_cog(const fs::path& file, const LayerSource& maps, std::size_t layer, std::size_t plane,
               CancelFlag cancel) {
  const GdalScope scope;
  const LayerStack& about = maps.about();
  PlaneDataset dataset(maps, layer, plane);
  describe(dataset, about.layers[layer], plane, about);
  write_encoded(file, dataset, "COG", cog_options(about.layers[layer]), cancel);
}

std::vector<PlaneFile> write_cogs(const fs::path& folder, const LayerSource& maps,
                                  CancelFlag cancel) {
  std::vector<PlaneFile> files = cog_files(folder, maps.about());
  for (const PlaneFile& file : files) {
    cancel.check();
    make_folder(file.path.parent_path());
    write_cog(file.path, maps, file.layer, file.plane, cancel);
  }
  return files;
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
