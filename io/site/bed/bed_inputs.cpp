// SPDX-License-Identifier: Apache-2.0
#include "io/site/bed/bed_inputs.hpp"

#include "engine/core/error.hpp"
#include "io/site/stand_in_crs.hpp"
#include "io/site/thickness_raster.hpp"
#include "io/site/zone_cells.hpp"

#include <fmt/format.h>

#include <utility>

namespace sturz {
namespace {

/// A depth raster is read as a thickness of the release is; what is said of it names these keys.
std::string in_words_of_erosion(std::string text) {
  static constexpr std::pair<const char*, const char*> words[] = {
      {"If these are depths counted downwards, set `release.thickness_factor: -1`",
       "Depths count downwards: give them as positive numbers"},
      {"release.thickness_factor", "erosion.depth_factor"},
      {"release.thickness_m", "erosion.depth_m"},
      {"release.polygon", "erosion.polygon"},
      {"release.crs", "erosion.crs"},
      {" (an empty release)", " (nothing to take)"},
      {"; slides are below 0.2", ""}};
  for (const auto& [theirs, ours] : words)
    for (std::size_t at = text.find(theirs); at != std::string::npos; at = text.find(theirs))
      text.replace(at, std::string(theirs).size(), ours);
  return text;
}

template <class Call>
auto in_words(Call call) {
  try {
    return call();
  } catch (const SetupError& problem) {
    throw SetupError(in_words_of_erosion(problem.what()));
  }
}

PolygonRequest polygon_request(const Scenario& scenario) {
  const ErosionSpec& spec = *scenario.erosion;
  PolygonRequest request;
  request.path = spec.polygon;
  request.layer = spec.layer;
  request.key = "erosion.polygon";
  request.directory = scenario.directory;
  request.crs = spec.crs;
  request.crs_key = "erosion.crs";
  request.layer_key = "erosion.layer";
  request.what = "erodible bed";
  stand_in_with_terrain(request, scenario.terrain);
  return request;
}

RasterRequest raster_request(const Scenario& scenario) {
  const ErosionSpec& spec = *scenario.erosion;
  RasterRequest request;
  request.path = spec.depth_raster;
  request.key = "erosion.depth_raster";
  request.directory = scenario.directory;
  request.crs = spec.crs;
  request.crs_key = "erosion.crs";
  request.is_scaled_later = spec.depth_factor.has_value();
  request.may_reach_beyond = true;  // no mass comes there
  stand_in_with_terrain(request, scenario.terrain);
  return request;
}

BedSupplyInput read_polygon(const Scenario& scenario, const Grid& terrain, const Window& held) {
  ZoneCells read = read_zone_cells(polygon_request(scenario), terrain, held);
  Window box;
  const auto place = [&](std::size_t cell) {
    const auto n = static_cast<std::size_t>(held.n_cols);
    return Window{held.row0 + static_cast<int>(cell / n), held.col0 + static_cast<int>(cell % n), 1,
                  1};
  };
  for (const std::size_t cell : read.cells) box = joined(box, place(cell));
  BedSupplyInput out;
  out.pattern = Raster<double>(grid_of(box, terrain), 0.0);
  for (const std::size_t cell : read.cells) {
    const Window at = place(cell);
    out.pattern.at(at.row0 - box.row0, at.col0 - box.col0) = 1;
  }
  out.notes = std::move(read.notes);
  out.warnings = std::move(read.warnings);
  out.identity = std::move(read.identity);
  const auto n = static_cast<double>(read.n_on_terrain);
  out.notes.push_back(fmt::format("erosion.polygon {}: {} cells, {:.9g} m2",
                                  scenario.erosion->polygon, read.n_on_terrain,
                                  n * terrain.cell_m * terrain.cell_m));
  return out;
}

BedSupplyInput read_raster(const Scenario& scenario, const Grid& terrain) {
  ThicknessRead read = in_words([&] { return read_thickness(raster_request(scenario), terrain); });
  BedSupplyInput out;
  out.pattern = std::move(read.thickness);
  for (std::string& warning : read.warnings)
    out.warnings.push_back(in_words_of_erosion(std::move(warning)));
  out.notes = std::move(read.notes);
  out.identity = std::move(read.identity);
  out.notes.push_back(fmt::format("erosion.depth_raster {}: {:.9g} m3 on {:.9g} m2",
                                  scenario.erosion->depth_raster, read.volume_m3, read.area_m2));
  return out;
}

}  // namespace

PolygonRequest zone_request(const Scenario& scenario, std::size_t i) {
  const BasalZone& zone = scenario.basal.zones[i];
  const std::string name = fmt::format("basal.zones[{}]", i);
  PolygonRequest request;
  request.path = zone.polygon;
  request.layer = zone.layer;
  request.key = name + ".polygon";
  request.directory = scenario.directory;
  request.crs_key.clear();  // no key of its own
  stand_in_with_terrain(request, scenario.terrain);
  request.layer_key = name + ".layer";
  request.what = "zone";
  return request;
}

bool has_bed_supply_file(const Scenario& s) {
  return s.erosion && !(s.erosion->polygon.empty() && s.erosion->depth_raster.empty());
}

BedSupplyInput read_bed_supply(const Scenario& s, const Grid& terrain, const Window& held) {
  return s.erosion->polygon.empty() ? read_raster(s, terrain) : read_polygon(s, terrain, held);
}

void check_bed_supply(const Scenario& s) {
  if (!has_bed_supply_file(s)) return;
  if (!s.erosion->depth_raster.empty())
    return in_words([&] { check_thickness(raster_request(s), s.terrain.crs == local_crs); });
  PolygonRequest request = polygon_request(s);
  request.without_terrain = true;
  read_zone_cells(request, {});
}

}  // namespace sturz
