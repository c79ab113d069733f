// SPDX-License-Identifier: Apache-2.0
#include "io/site/release/release_features.hpp"

#include "engine/core/error.hpp"
#include "io/site/release/named_features.hpp"
#include "io/site/release/release_requests.hpp"

namespace sturz {

std::vector<std::string> release_features(const Scenario& scenario) {
  const GdalScope scope;
  const PolygonRequest request = release_polygon_request(scenario);
  PolygonLayer layer = open_polygon_layer(request);
  std::vector<std::string> names = feature_names(layer, request);
  require(!names.empty(), layer.label +
                              ": has no features (a region needs one at least). Draw the "
                              "release polygons.");
  return names;
}

}  // namespace sturz
