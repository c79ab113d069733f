// SPDX-License-Identifier: Apache-2.0
#include "io/site/overlays/orthophoto.hpp"

#include "engine/core/error.hpp"
#include "io/gdal/gdal_handles.hpp"
#include "io/gdal/input_files.hpp"

#include <cpl_vsi.h>
#include <fmt/format.h>
#include <gdal_utils.h>

#include <algorithm>
#include <memory>
#include <string>

namespace sturz {
namespace {

constexpr const char* key = "report.orthophoto";
constexpr const char* jpeg_file = "/vsimem/sturz_orthophoto.jpg";

struct WarpOptionsFree {
  void operator()(GDALWarpAppOptions* o) const { GDALWarpAppOptionsFree(o); }
};
struct TranslateOptionsFree {
  void operator()(GDALTranslateOptions* o) const { GDALTranslateOptionsFree(o); }
};

OpenDataset open_photo(const Scenario& scenario, std::string& label) {
  const InputFile file = find_input(key, scenario.report.orthophoto, scenario.directory);
  label = file.label;
  OpenDataset photo = open_dataset(file.path, file.label, GDAL_OF_RASTER);
  const bool colours =
      photo->GetRasterCount() >= 3 && photo->GetRasterBand(1)->GetRasterDataType() == GDT_Byte;
  require(colours, fmt::format("{} (has {} bands; a picture needs red, green and blue of one byte "
                               "each). Convert it with `gdal_translate -ot Byte`.",
                               file.label, photo->GetRasterCount()));
  require(photo->GetSpatialRef() != nullptr,
          fmt::format("{} (has no coordinate system). Give it one with `gdal_edit -a_srs`.",
                      file.label));
  return photo;
}

/// Warped to `view` in memory: three bands, white where the photo has nothing.
DatasetPtr warped(GDALDataset& photo, const Grid& view, const std::string& label) {
  const double width = view.east_m() - view.west_m, height = view.north_m - view.south_m();
  const double scale = most_photo_pixels / std::max(width, height);
  const auto text = [](double v) { return fmt::format("{:.17g}", v); };
  const std::vector<std::string> words = {
      "-of",
      "MEM",
      "-t_srs",
      view.crs_wkt,
      "-te",
      text(view.west_m),
      text(view.south_m()),
      text(view.east_m()),
      text(view.north_m),
      "-ts",
      std::to_string(std::max(1, static_cast<int>(scale * width))),
      std::to_string(std::max(1, static_cast<int>(scale * height))),
      "-r",
      "average",
      "-wo",
      "INIT_DEST=255",
      "-wm",
      "64"};
  std::vector<char*> list;
  for (const std::string& word : words) list.push_back(const_cast<char*>(word.c_str()));
  list.push_back(nullptr);
  const std::unique_ptr<GDALWarpAppOptions, WarpOptionsFree> options(
      GDALWarpAppOptionsNew(list.data(), nullptr));
  GDALDatasetH source = &photo;
  DatasetPtr out(
      static_cast<GDALDataset*>(GDALWarp("", nullptr, 1, &source, options.get(), nullptr)));
  require(out != nullptr,
          fmt::format("{} (cannot be moved to the terrain's system: {}).", label, gdal_reason()));
  return out;
}

std::vector<std::uint8_t> as_jpeg(GDALDataset& picture, const std::string& label) {
  const char* words[] = {"-of", "JPEG", "-co", "QUALITY=78", "-b",   "1",
                         "-b",  "2",    "-b",  "3",          nullptr};
  const std::unique_ptr<GDALTranslateOptions, TranslateOptionsFree> options(
      GDALTranslateOptionsNew(const_cast<char**>(words), nullptr));
  DatasetPtr out(
      static_cast<GDALDataset*>(GDALTranslate(jpeg_file, &picture, options.get(), nullptr)));
  require(out != nullptr, fmt::format("{} (cannot be made a JPEG: {}).", label, gdal_reason()));
  out.reset();
  vsi_l_offset size = 0;
  const GByte* bytes = VSIGetMemFileBuffer(jpeg_file, &size, FALSE);
  std::vector<std::uint8_t> jpeg(bytes, bytes + size);
  VSIUnlink(jpeg_file);
  return jpeg;
}

}  // namespace

void check_orthophoto(const Scenario& scenario) {
  if (scenario.report.orthophoto.empty()) return;
  const GdalScope scope;
  std::string label;
  open_photo(scenario, label);
}

std::vector<std::uint8_t> orthophoto_jpeg(const Scenario& scenario, const Grid& view) {
  if (scenario.report.orthophoto.empty() || view.crs_wkt.empty()) return {};
  const GdalScope scope;
  std::string label;
  const OpenDataset photo = open_photo(scenario, label);
  const DatasetPtr picture = warped(*photo.dataset, view, label);
  return as_jpeg(*picture, label);
}

}  // namespace sturz
