// SPDX-License-Identifier: Apache-2.0
/// The assets of a scene as they were read: where each lies on the maps, what it is worth.
#pragma once

#include "engine/terrain/raster.hpp"
#include "scenarios/assets/damage_curve.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace sturz {

/// How much of an asset the maps can speak of.
enum class AssetPlace { inside, partly_outside, outside };

struct Asset {
  std::string name;
  std::string vulnerability_class;   ///< empty: no classes were asked for
  double value = nan_d;              ///< in Assets::value_unit; NaN: no values were asked for
  std::optional<std::size_t> curve;  ///< in Assets::curves
  std::string wkb;                   ///< its geometry in the maps' system, ISO WKB, little endian
  /// Cells of the whole maps' grid that it touches, rising; empty: it lies beyond the maps.
  std::vector<std::size_t> cells;
  bool partly_beyond = false;    ///< a part of it lies beyond the maps, or where no ground is known
  bool on_known_ground = false;  ///< the ground is known at the centre of at least one of `cells`

  AssetPlace place() const {
    if (cells.empty() || !on_known_ground) return AssetPlace::outside;
    return partly_beyond ? AssetPlace::partly_outside : AssetPlace::inside;
  }
};

struct Assets {
  std::vector<Asset> list;  ///< in the order of the file; names differ
  std::vector<DamageCurve> curves;
  bool has_classes = false, has_values = false;
  std::string value_unit;
};

}  // namespace sturz
