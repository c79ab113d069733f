// SPDX-License-Identifier: Apache-2.0
#include "io/site/zone_cells.hpp"

#include "engine/core/error.hpp"
#include "io/site/polygon_cells.hpp"
#include "io/site/polygon_layer.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace sturz {
namespace {

/// Feature by feature: where two of them overlap, both would count as a hole of the other.
/// \return how many there are, beyond the window too
std::size_t add_cells(const OGRMultiPolygon& polygons, const Grid& terrain, const Window& held,
                      std::vector<std::size_t>& all) {
  PolygonCells cells(terrain, held);
  for (const OGRPolygon* polygon : polygons)
    for (const OGRLinearRing* ring : *polygon) cells.add_ring(points_of(*ring));
  const std::vector<std::size_t> listed = cells.finish();
  all.insert(all.end(), listed.begin(), listed.end());
  return cells.count();
}

}  // namespace

ZoneCells read_zone_cells(const PolygonRequest& request, const Grid& terrain, const Window& held) {
  const GdalScope scope;
  PolygonLayer layer = open_polygon_layer(request);
  ZoneCells zone;
  OGREnvelope extent;
  std::size_t count = 0;
  const auto features = read_features(layer, request, terrain);
  if (request.without_terrain) return zone;
  for (const auto& feature : features) {
    OGREnvelope own;
    feature.polygons->getEnvelope(&own);
    extent.Merge(own);
    count += add_cells(*feature.polygons, terrain, held, zone.cells);
  }
  const std::size_t listed = zone.cells.size();
  std::sort(zone.cells.begin(), zone.cells.end());
  zone.cells.erase(std::unique(zone.cells.begin(), zone.cells.end()), zone.cells.end());
  zone.n_on_terrain = count - (listed - zone.cells.size());
  if (count == 0)
    throw SetupError(
        fmt::format("{}: holds the centre of no cell of the terrain ({}; cells of {:g} m). Is its "
                    "coordinate system right?",
                    layer.label, places_text(extent, terrain), terrain.cell_m));
  zone.notes = std::move(layer.notes);
  zone.warnings = std::move(layer.warnings);
  zone.identity = std::move(layer.identity);
  return zone;
}

}  // namespace sturz
