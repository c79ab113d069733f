// SPDX-License-Identifier: Apache-2.0
/// A raster that gives a number of the bed cell by cell: friction, pore pressure, ...
#pragma once

#include "engine/terrain/raster.hpp"
#include "io/gdal/raster_request.hpp"
#include "scenarios/input_identity.hpp"
#include "scenarios/schema/schema.hpp"

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace sturz {

/// What its values may be, and what members multiply them by.
struct BedRasterLimits {
  const KeyInfo* key = nullptr;            ///< range and units
  std::pair<double, double> factor{1, 1};  ///< least and most
  std::string factor_key;                  ///< for messages
};

/// Least, most and mean of some values; `count` of them are known.
struct KnownRange {
  std::size_t count = 0;
  double least = 0, most = 0, mean = 0;
};
KnownRange known_range(const Raster<double>&);

/// An open raster. A cell of the terrain has the value of the raster's cell that holds its centre;
/// NaN where that is nodata or beyond the raster. No window changes that.
class BedRasterFile {
 public:
  /// Looks through the whole file, strip by strip, so that one wrong value is told before anything
  /// is computed, and gives it an identity.
  /// \param terrain without a system of its own the coordinates are taken as they are
  /// \throws SetupError naming key and file: missing or unreadable file; no coordinate system; a
  ///   value, or what a factor makes of it, out of the key's range (with its cell); no value at all
  BedRasterFile(const RasterRequest&, const BedRasterLimits&, const Grid& terrain);
  ~BedRasterFile();
  BedRasterFile(const BedRasterFile&) = delete;
  BedRasterFile& operator=(const BedRasterFile&) = delete;

  const std::string& label() const;
  /// \pre the window lies on the terrain
  Raster<double> on(const Window&) const;

  std::vector<std::string> notes;
  std::vector<std::string> warnings;
  InputIdentity identity;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// What can be said of it without a terrain. \throws SetupError
void check_bed_raster(const RasterRequest&, const BedRasterLimits&, bool terrain_is_local);

}  // namespace sturz
