// SPDX-License-Identifier: Apache-2.0
/// What every use of GDAL in this folder shares: handles that close themselves, quiet errors.
/// Included by .cpp files only, so GDAL's types stay inside io.
#pragma once

#include "engine/terrain/raster.hpp"

#include <cpl_error.h>
#include <gdal_priv.h>

#include <array>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace sturz {

struct DatasetCloser {
  void operator()(GDALDataset* dataset) const { GDALClose(dataset); }
};
using DatasetPtr = std::unique_ptr<GDALDataset, DatasetCloser>;

/// GDAL in one scope: drivers registered, messages kept for gdal_reason() instead of printed.
class GdalScope {
 public:
  GdalScope();

 private:
  CPLErrorHandlerPusher quiet_;
};

/// The library's last message in this thread, or `otherwise` when it gave none.
std::string gdal_reason(const char* otherwise = "no reason given");

/// A dataset that is never shared: opened, used and closed by one call.
struct OpenDataset {
  std::unique_lock<std::recursive_mutex> hdf5;  ///< held for formats on HDF5, see netcdf_file.hpp
  DatasetPtr dataset;
  GDALDataset* operator->() const { return dataset.get(); }
};

/// \param open_flags GDAL_OF_RASTER or GDAL_OF_VECTOR; read-only
/// \throws SetupError "<label>: cannot be opened (<library text>)..."
OpenDataset open_dataset(const std::string& path, const std::string& label, unsigned open_flags);

/// The file and its companions (.prj, .aux.xml, ...), regular files only.
std::vector<std::string> files_of(GDALDataset& dataset);

/// A grid as a GDAL geotransform.
std::array<double, 6> affine_of(const Grid& grid);

/// A raster in memory whose single band is `values`, which must outlive it. No nodata value yet.
/// \param affine GDAL geotransform, 6 numbers
DatasetPtr wrap_in_memory(void* values, GDALDataType type, int n_cols, int n_rows,
                          const double* affine);

}  // namespace sturz
