// SPDX-License-Identifier: Apache-2.0
/// What a page draws over its maps besides results: roads, houses, names. No member knows of it.
#pragma once

#include "engine/core/vec.hpp"

#include <string>
#include <vector>

namespace sturz {

/// One point, line or polygon in the maps' system.
struct OverlayFeature {
  enum class Kind { point, line, polygon };
  Kind kind = Kind::point;
  std::vector<std::vector<Vec2>> parts;  ///< [m]: one point, one line, or closed rings
  std::string name;                      ///< of the layer's field "name"; may be empty
};

struct Overlay {
  std::string name;  ///< as the scenario calls it
  std::vector<OverlayFeature> features;
};

/// Corners of all features.
inline std::size_t corners_of(const Overlay& overlay) {
  std::size_t n = 0;
  for (const OverlayFeature& feature : overlay.features)
    for (const auto& part : feature.parts) n += part.size();
  return n;
}

}  // namespace sturz
