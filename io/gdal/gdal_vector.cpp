// SPDX-License-Identifier: Apache-2.0
#include "io/gdal/gdal_vector.hpp"

#include "engine/core/error.hpp"
#include "io/site/polygon_layer.hpp"
#include "scenarios/schema/suggest.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

namespace sturz {
namespace {

/// Everything that the steps below share.
struct Reading {
  const PolygonRequest& request;
  PolygonLayer layer;
  int thickness_field = -1, volume_field = -1, start_field = -1;
  PolygonRelease result;
};

/// Of a number that the features hold. \param key scenario key that names the field
/// \param what e.g. "the thickness in metres"
int find_field(const Reading& reading, const std::string& name, const char* key, const char* what) {
  if (name.empty()) return -1;
  const std::string& label = reading.layer.label;
  OGRFeatureDefn& fields = *reading.layer.layer->GetLayerDefn();
  const int index = fields.GetFieldIndex(name.c_str());
  if (index >= 0) {
    const OGRFieldType type = fields.GetFieldDefn(index)->GetType();
    require(type == OFTReal || type == OFTInteger || type == OFTInteger64,
            fmt::format("{}: field '{}' ({}) holds no numbers but {}. Store {} as a number.", label,
                        name, key, OGRFieldDefn::GetFieldTypeName(type), what));
    return index;
  }
  std::vector<std::string> names;
  names.reserve(static_cast<std::size_t>(fields.GetFieldCount()));
  for (int i = 0; i < fields.GetFieldCount(); ++i)
    names.emplace_back(fields.GetFieldDefn(i)->GetNameRef());
  throw SetupError(fmt::format("{}: has no field '{}' ({}). It has: {}.", label, name, key,
                               names.empty() ? "none" : comma_separated(names)));
}

double thickness_of(const Reading& reading, OGRFeature& feature, const std::string& name) {
  const std::string& field = reading.request.thickness_attribute;
  require(feature.IsFieldSetAndNotNull(reading.thickness_field),
          fmt::format("{}: {} has no value in '{}'. Give its thickness in metres.",
                      reading.layer.label, name, field));
  const double thickness = feature.GetFieldAsDouble(reading.thickness_field);
  require(std::isfinite(thickness) && thickness > 0,
          fmt::format("{}: {} has {} = {:g} (a thickness must be positive). Give metres.",
                      reading.layer.label, name, field, thickness));
  return thickness;
}

/// From the volume that a field holds.
double thickness_by_volume(const Reading& reading, OGRFeature& feature,
                           const PolygonFeature& source) {
  const std::string& field = reading.request.volume_attribute;
  require(feature.IsFieldSetAndNotNull(reading.volume_field),
          fmt::format("{}: {} has no value in '{}'. Give its bulk volume in m3.",
                      reading.layer.label, source.name, field));
  const double volume = feature.GetFieldAsDouble(reading.volume_field);
  require(std::isfinite(volume) && volume > 0,
          fmt::format("{}: {} has {} = {:g} (a volume must be positive). Give m3.",
                      reading.layer.label, source.name, field, volume));
  return volume / source.polygons->get_Area();
}

double start_of(const Reading& reading, OGRFeature& feature, const std::string& name) {
  const std::string& field = reading.request.start_time_attribute;
  require(feature.IsFieldSetAndNotNull(reading.start_field),
          fmt::format("{}: {} has no value in '{}'. Give the time of its start in seconds.",
                      reading.layer.label, name, field));
  const double start = feature.GetFieldAsDouble(reading.start_field);
  require(start >= 0 && start <= 1e5,
          fmt::format("{}: {} has {} = {:g} (a start must be in 0..1e5 s). Give seconds.",
                      reading.layer.label, name, field, start));
  return start;
}

std::vector<PolygonFeature> read_sources(Reading& reading, const Grid& terrain) {
  if (!reading.result.is_thickness && reading.start_field < 0)
    return read_features(reading.layer, reading.request, terrain);
  return read_features(reading.layer, reading.request, terrain,
                       [&](OGRFeature& read, PolygonFeature& feature) {
                         if (reading.thickness_field >= 0)
                           feature.thickness_m = thickness_of(reading, read, feature.name);
                         if (reading.volume_field >= 0)
                           feature.thickness_m = thickness_by_volume(reading, read, feature);
                         if (reading.start_field >= 0)
                           feature.start_s = start_of(reading, read, feature.name);
                       });
}

/// Which part of the pattern starts when.
void divide_by_start(const std::vector<PolygonFeature>& sources, const Grid& terrain,
                     const Window& under, PolygonRelease& result) {
  std::map<double, std::vector<const PolygonFeature*>> groups;
  for (const PolygonFeature& source : sources) groups[source.start_s].push_back(&source);
  for (const auto& [start, features] : groups) {
    PolygonCover cover(terrain, under);
    for (const PolygonFeature* f : features) lay_down(*f->polygons, f->thickness_m, cover);
    Raster<double> share = cover.finish();
    for (std::size_t i = 0; i < share.values.size(); ++i) {
      const double all = result.pattern.values[i];
      share.values[i] = all > 0 ? std::min(1.0, std::max(0.0, share.values[i] / all)) : 0;
    }
    result.starts.push_back({start, std::make_shared<const Raster<double>>(std::move(share))});
  }
}

/// Without thicknesses the features are one source; what two of them cover counts once.
void merge(Reading& reading, std::vector<PolygonFeature>& sources) {
  if (sources.size() < 2) return;
  std::vector<const OGRMultiPolygon*> all;
  double sum = 0;
  for (const auto& source : sources) {
    sum += source.polygons->get_Area();
    all.push_back(source.polygons.get());
  }
  PolygonsPtr polygons = united(all, reading.layer.label);
  const double area = polygons->get_Area();
  if (sum - area > 1e-6 * sum)
    reading.layer.notes.push_back(
        fmt::format("{}: its {} features overlap by {:.6g} m2, which counts once",
                    reading.layer.label, sources.size(), sum - area));
  sources.resize(1);
  sources[0].name = "all features together";
  sources[0].polygons = std::move(polygons);
}

void refuse_overlaps(const Reading& reading, const std::vector<PolygonFeature>& sources) {
  for (std::size_t i = 0; i < sources.size(); ++i)
    for (std::size_t j = i + 1; j < sources.size(); ++j) {
      const auto &a = *sources[i].polygons, &b = *sources[j].polygons;
      const double area = shared_area(a, b);
      require(area <= 1e-6 * std::min(a.get_Area(), b.get_Area()),
              fmt::format("{}: {} and {} overlap by {:.6g} m2 (which '{}' holds there?). Cut one "
                          "of them back.",
                          reading.layer.label, sources[i].name, sources[j].name, area,
                          (reading.thickness_field >= 0 ? reading.request.thickness_attribute
                           : reading.volume_field >= 0  ? reading.request.volume_attribute
                                                        : reading.request.start_time_attribute)));
    }
}

void require_inside(const Reading& reading, const PolygonFeature& source, const Grid& terrain) {
  const auto& polygons = *source.polygons;
  const OGRPolygon known = rectangle(terrain, 1e-6 * terrain.cell_m);
  if (known.Contains(&polygons)) return;
  OGREnvelope box;
  polygons.getEnvelope(&box);
  const std::string places = places_text(box, terrain);
  if (!known.Intersects(&polygons)) {
    const double gap = known.Distance(&polygons);
    throw SetupError(fmt::format(
        "{}: the release polygon ({}) lies {} outside the terrain ({}). Is its coordinate system "
        "right?",
        reading.layer.label, source.name,
        gap >= 1000 ? fmt::format("{:.1f} km", gap / 1000) : fmt::format("{:.1f} m", gap), places));
  }
  const double outside = area_outside(polygons, known);
  throw SetupError(fmt::format(
      "{}: {:.6g} m2 ({:.3g} %) of the release polygon ({}) lie outside the terrain ({}). Use a "
      "larger terrain or cut the polygon.",
      reading.layer.label, outside, 100 * outside / polygons.get_Area(), source.name, places));
}

}  // namespace

PolygonRelease read_release_polygons(const PolygonRequest& request, const Grid& terrain) {
  const GdalScope scope;
  Reading reading{request, open_polygon_layer(request), -1, -1, -1, {}};
  reading.thickness_field = find_field(reading, request.thickness_attribute,
                                       "release.thickness_attribute", "the thickness in metres");
  reading.start_field = find_field(reading, request.start_time_attribute,
                                   "release.start_time_attribute", "the time in seconds");
  reading.volume_field = find_field(reading, request.volume_attribute, "release.volume_attribute",
                                    "the bulk volume in m3");
  reading.result.is_thickness = reading.thickness_field >= 0 || reading.volume_field >= 0;
  std::vector<PolygonFeature> sources = read_sources(reading, terrain);
  if (reading.result.is_thickness || reading.start_field >= 0) {
    refuse_overlaps(reading, sources);
  } else {
    merge(reading, sources);
  }
  if (request.without_terrain) return std::move(reading.result);
  for (const auto& source : sources) require_inside(reading, source, terrain);
  OGREnvelope box;
  for (const auto& source : sources) {
    OGREnvelope own;
    source.polygons->getEnvelope(&own);
    box.Merge(own);
  }
  const Window under = cells_under(box.MinX, box.MaxX, box.MinY, box.MaxY, terrain);
  PolygonCover cover(terrain, under), share(terrain, under);
  for (const auto& source : sources) {
    const double area = lay_down(*source.polygons, source.thickness_m, cover);
    reading.result.area_m2 += area;
    if (!reading.result.is_thickness) continue;
    reading.result.volume_m3 += area * source.thickness_m;
    lay_down(*source.polygons, 1, share);
  }
  reading.result.pattern = cover.finish();
  if (reading.result.is_thickness) reading.result.cover = share.finish();
  if (reading.start_field >= 0) divide_by_start(sources, terrain, under, reading.result);
  reading.result.notes = std::move(reading.layer.notes);
  reading.result.warnings = std::move(reading.layer.warnings);
  reading.result.identity = std::move(reading.layer.identity);
  return std::move(reading.result);
}

}  // namespace sturz
