// SPDX-License-Identifier: Apache-2.0
/// GeoTIFFs of any type, layout, scale and system, for tests of what files may hold.
#pragma once

#include "tests/io/io_fixture.hpp"

#include <gdal_priv.h>

#include <string>
#include <vector>

namespace sturz::test {

struct TypedRaster {
  int n_cols = 0, n_rows = 0;
  std::vector<double> values;  ///< first band; others hold the same
  GDALDataType type = GDT_Float32;
  int bands = 1;
  double west = 500000, north = 4600000, cell = 10;
  std::string crs = "EPSG:32633";
  double scale = 1;
  std::vector<std::string> options;  ///< of the driver: "TILED=YES"
};

inline void write_typed(const std::string& path, const TypedRaster& r) {
  GDALAllRegister();
  std::vector<char*> options;
  std::vector<std::string> words = r.options;
  for (std::string& word : words) options.push_back(word.data());
  options.push_back(nullptr);
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  std::unique_ptr<GDALDataset> dataset(
      driver->Create(path.c_str(), r.n_cols, r.n_rows, r.bands, r.type, options.data()));
  ASSERT_NE(dataset, nullptr);
  double affine[]{r.west, r.cell, 0, r.north, 0, -r.cell};
  dataset->SetGeoTransform(affine);
  if (!r.crs.empty()) {
    OGRSpatialReference crs;
    ASSERT_EQ(crs.SetFromUserInput(r.crs.c_str()), OGRERR_NONE);
    crs.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    dataset->SetSpatialRef(&crs);
  }
  auto values = r.values;
  ASSERT_EQ(values.size(), static_cast<std::size_t>(r.n_cols) * r.n_rows);
  for (int band = 1; band <= r.bands; ++band) {
    GDALRasterBand& to = *dataset->GetRasterBand(band);
    if (r.scale != 1) to.SetScale(r.scale);
    ASSERT_EQ(to.RasterIO(GF_Write, 0, 0, r.n_cols, r.n_rows, values.data(), r.n_cols, r.n_rows,
                          GDT_Float64, 0, 0, nullptr),
              CE_None);
  }
}

/// A slope with a bump, heights 500 to about 1500 m: nothing about it is doubtful.
inline TypedRaster slope(int n = 60, double cell = 10) {
  TypedRaster r;
  r.n_cols = r.n_rows = n;
  r.cell = cell;
  for (int row = 0; row < n; ++row)
    for (int col = 0; col < n; ++col)
      r.values.push_back(500 + 0.31 * cell * row + 0.173 * cell * col +
                         3 * std::sin(0.21 * col) * std::cos(0.17 * row));
  return r;
}

}  // namespace sturz::test
