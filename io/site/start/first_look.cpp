// SPDX-License-Identifier: Apache-2.0
#include "io/site/start/first_look.hpp"

#include "engine/core/error.hpp"
#include "io/gdal/crs.hpp"
#include "io/gdal/gdal_handles.hpp"
#include "io/gdal/input_files.hpp"
#include "scenarios/schema/number_text.hpp"

#include <fmt/core.h>
#include <ogrsf_frmts.h>

namespace sturz {
namespace {

bool is_number(const OGRFieldDefn& field) {
  const OGRFieldType type = field.GetType();
  return type == OFTReal || type == OFTInteger || type == OFTInteger64;
}

ReleaseFile about_layer(OGRLayer& layer) {
  ReleaseFile file;
  file.n_features = layer.GetFeatureCount();
  const OGRFeatureDefn& fields = *layer.GetLayerDefn();
  for (int k = 0; k < fields.GetFieldCount(); ++k)
    if (is_number(*fields.GetFieldDefn(k)))
      file.number_fields.emplace_back(fields.GetFieldDefn(k)->GetNameRef());
  return file;
}

}  // namespace

ReleaseFile look_at_release(const std::string& path, const std::string& directory) {
  const GdalScope scope;
  const InputFile file = find_input("release", path, directory);
  try {
    const OpenDataset vector = open_dataset(file.path, file.label, GDAL_OF_VECTOR);
    if (vector->GetLayerCount() > 0) return about_layer(*vector->GetLayer(0));
  } catch (const SetupError&) {
    // Not a vector: a raster then, or nothing that is known.
  }
  const OpenDataset raster = open_dataset(file.path, file.label, GDAL_OF_RASTER);
  ReleaseFile found;
  found.is_raster = true;
  return found;
}

std::string grid_text(const Grid& grid) {
  const std::string crs =
      grid.crs_wkt.empty() ? "local coordinates" : crs_name(crs_from_wkt(grid.crs_wkt));
  return fmt::format("{} x {} cells of {} m, {}", grid.n_cols, grid.n_rows,
                     number_text(grid.cell_m), crs);
}

}  // namespace sturz
