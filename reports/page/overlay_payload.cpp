// SPDX-License-Identifier: Apache-2.0
#include "reports/page/overlay_payload.hpp"

#include "reports/figures/codec.hpp"

#include <cmath>

namespace sturz {
namespace {

using Json = nlohmann::ordered_json;

double decimetre(double v) { return std::round(10 * v) / 10; }

Json point_json(const Vec2& p) { return {decimetre(p.x()), decimetre(p.y())}; }

Json line_json(const std::vector<Vec2>& line) {
  Json points = Json::array();
  for (const Vec2& p : line) points.push_back(point_json(p));
  return points;
}

Json place_json(const OverlayFeature& feature) {
  if (feature.kind == OverlayFeature::Kind::point) return point_json(feature.parts.front().front());
  if (feature.kind == OverlayFeature::Kind::line) return line_json(feature.parts.front());
  Json rings = Json::array();
  for (const auto& ring : feature.parts) rings.push_back(line_json(ring));
  return rings;
}

const char* kind_word(OverlayFeature::Kind kind) {
  switch (kind) {
    case OverlayFeature::Kind::point:
      return "point";
    case OverlayFeature::Kind::line:
      return "line";
    case OverlayFeature::Kind::polygon:
      break;
  }
  return "polygon";
}

}  // namespace

Json overlays_json(std::span<const Overlay> overlays) {
  Json all = Json::array();
  for (const Overlay& overlay : overlays) {
    Json features = Json::array();
    for (const OverlayFeature& feature : overlay.features) {
      Json one = {{"kind", kind_word(feature.kind)}, {"at", place_json(feature)}};
      if (!feature.name.empty()) one["name"] = feature.name;
      features.push_back(std::move(one));
    }
    all.push_back({{"name", overlay.name}, {"features", std::move(features)}});
  }
  return all;
}

Json orthophoto_json(const ReportInput& input, const Grid& view) {
  if (!input.orthophoto) return nullptr;
  const std::vector<std::uint8_t> jpeg = input.orthophoto(view);
  if (jpeg.empty()) return nullptr;
  return {{"west", view.west_m},
          {"south", view.south_m()},
          {"east", view.east_m()},
          {"north", view.north_m},
          {"picture", "data:image/jpeg;base64," + base64(jpeg)}};
}

}  // namespace sturz
