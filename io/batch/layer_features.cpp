// SPDX-License-Identifier: Apache-2.0
#include "io/batch/layer_features.hpp"

#include "engine/core/error.hpp"
#include "io/site/polygon_layer.hpp"

namespace sturz {

std::vector<std::string> layer_features(const Scenario& scenario) {
  require(!scenario.release.polygon.empty(),
          "features: each (the scenario has no release.polygon whose features could be told "
          "apart). Remove it.");
  const GdalScope scope;
  PolygonRequest request;
  request.path = scenario.release.polygon;
  request.layer = scenario.release.layer;
  request.directory = scenario.directory;
  const PolygonLayer open = open_polygon_layer(request);
  std::vector<std::string> ids;
  for (const auto& feature : *open.layer) ids.push_back(std::to_string(feature->GetFID()));
  require(!ids.empty(), open.label + ": the layer is empty (there is no feature to compute).");
  return ids;
}

}  // namespace sturz
