// SPDX-License-Identifier: Apache-2.0
/// Maps as CF-1.10 netCDF: opens with its coordinate system in QGIS, gdalinfo, xarray, cdo.
///
/// Float maps are [axis][y][x] float32 with _FillValue NaN, counts int32. A layer's extra axis is a
/// coordinate variable; thresholds carry spp__relative_to_threshold = "greater_than" (the shape in
/// which the Met Office's IMPROVER stores exceedance probabilities). What a map shows stands in its
/// attributes sturz_quantity, sturz_statistic and sturz_intensity_class, words of
/// scenarios/layers/layer_meaning.hpp.
/// No unlimited dimensions, no time stamps: the same layers give the same bytes.
#pragma once

#include "engine/simulation/history.hpp"
#include "io/netcdf/netcdf_file.hpp"
#include "scenarios/layers/layer_stream.hpp"

#include <filesystem>
#include <vector>

namespace sturz {

/// Writes maps as they come; nothing has the file's name before commit(). Cells that are never put
/// are missing. Global attributes Conventions, title, source and history are added where the stack
/// has none.
class LayersFileWriter final : public LayerSink {
 public:
  /// \throws IoError when the disk refuses
  explicit LayersFileWriter(std::filesystem::path file, NetcdfMedium medium = NetcdfMedium::disk);
  /// \throws SetupError for layers that contradict each other (two axes of one name with other
  ///   values, axis not increasing); IoError
  void begin(const LayerStack& about) override;
  void put(std::size_t layer, std::size_t plane, const Window& window,
           std::span<const float> values) override;
  /// For what else the file is to hold, behind the maps.
  NetcdfWriter& file() { return file_; }
  /// The history of the member whose maps these are (see history_netcdf.hpp), and the end. How long
  /// it took to compute is not in it: the file says what the mass did, and two machines should
  /// agree on it; computing times are in the member's file. \throws IoError
  void commit(const MemberHistory& history = {});

 private:
  NetcdfWriter file_;
  std::vector<int> variables_;  // of each layer
  std::vector<bool> is_count_, has_axis_;
};

/// Reads the maps that were written so, window by window. \throws IoError, also where a map does
/// not say what it shows
class LayersFileReader final : public LayerSource {
 public:
  explicit LayersFileReader(const std::filesystem::path& file);
  const LayerStack& about() const override { return about_; }
  void read(std::size_t layer, std::size_t plane, const Window& window,
            std::span<float> out) const override;

 private:
  NetcdfReader file_;
  LayerStack about_;
};

/// Writes a whole stack, built in memory. \throws as LayersFileWriter; SetupError also for a wrong
/// number of values
void write_layers(const std::filesystem::path& file, const LayerStack& stack,
                  const MemberHistory& history = {});

/// Reads all maps into memory. \throws as LayersFileReader
LayerStack read_layers(const std::filesystem::path& file);

}  // namespace sturz
