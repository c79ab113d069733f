// SPDX-License-Identifier: Apache-2.0
#include "io/features/shapes.hpp"

#include "io/files/io_error.hpp"
#include "io/gdal/gdal_handles.hpp"

#include <fmt/core.h>
#include <ogr_geometry.h>

#include <memory>
#include <utility>

namespace sturz {
namespace {

[[noreturn]] void fail() {
  throw IoError(fmt::format("a shape of the map cannot be made ({}).", gdal_reason()));
}

std::string wkb_of(const OGRGeometry& geometry) {
  std::vector<unsigned char> wkb(geometry.WkbSize());
  if (geometry.exportToWkb(wkbNDR, wkb.data(), wkbVariantIso) != OGRERR_NONE) fail();
  return {wkb.begin(), wkb.end()};
}

}  // namespace

std::string point_as_wkb(Vec2 place) { return wkb_of(OGRPoint(place.x(), place.y())); }

std::string line_as_wkb(const std::vector<Vec2>& corners) {
  OGRLineString line;
  for (const Vec2& corner : corners) line.addPoint(corner.x(), corner.y());
  return wkb_of(line);
}

std::string rings_as_wkb(const std::vector<std::vector<Vec2>>& rings) {
  if (rings.empty()) return {};
  const GdalScope scope;
  std::vector<OGRGeometry*> areas;  // the library takes them over
  for (const auto& corners : rings) {
    auto ring = std::make_unique<OGRLinearRing>();
    for (const Vec2& corner : corners) ring->addPoint(corner.x(), corner.y());
    ring->closeRings();
    auto area = std::make_unique<OGRPolygon>();
    if (area->addRingDirectly(ring.release()) != OGRERR_NONE) fail();
    areas.push_back(area.release());
  }
  int is_valid = 0;
  const std::unique_ptr<OGRGeometry> all(OGRGeometryFactory::organizePolygons(
      areas.data(), static_cast<int>(areas.size()), &is_valid, nullptr));
  if (all == nullptr) fail();
  const std::unique_ptr<OGRGeometry> areas_of(
      OGRGeometryFactory::forceToMultiPolygon(all->clone()));
  return wkb_of(*areas_of);
}

}  // namespace sturz
