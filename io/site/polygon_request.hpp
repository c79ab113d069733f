// SPDX-License-Identifier: Apache-2.0
/// Which polygons to read, and what the scenario says about them.
#pragma once

#include <string>

namespace sturz {

struct PolygonRequest {
  std::string path;                     ///< as written; relative paths start at `directory`
  std::string layer;                    ///< empty: the first
  std::string thickness_attribute;      ///< numeric field [m]; empty: shares only
  std::string volume_attribute;         ///< numeric field [m3]; empty: none
  std::string start_time_attribute;     ///< numeric field [s]; empty: none
  std::string feature;                  ///< the only one that is read; empty: all
  std::string feature_field;            ///< whose value `feature` is; empty: the FID
  std::string key = "release.polygon";  ///< scenario key, for messages
  std::string directory;
  std::string crs;                      ///< replaces the layer's own system; empty: not given
  std::string crs_key = "release.crs";  ///< empty: no key could give it
  std::string fallback_crs;             ///< stands in only when the layer has none; empty: refuse
  std::string fallback_crs_key;
  std::string layer_key = "release.layer";
  /// The terrain could not be read: everything is checked but what needs its place.
  bool without_terrain = false;
  std::string what = "release";  ///< what the polygons outline, for messages
};

}  // namespace sturz
