// SPDX-License-Identifier: Apache-2.0
#include "io/gdal_vector.hpp"

#include "engine/core/error.hpp"
#include "io/crs.hpp"
#include "io/gdal_handles.hpp"
#include "io/input_files.hpp"
#include "io/ogr_polygons.hpp"

#include <fmt/core.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace sturz {
namespace {

using GeometryPtr = std::unique_ptr<OGRGeometry>;

/// One feature: all its polygons in the terrain's system.
struct Source {
  std::string name;  ///< "feature 3"
  PolygonsPtr polygons;
  double thickness_m = 1;
};

/// Everything that the steps below share.
struct Reading {
  const PolygonRequest& request;
  std::string label;
  OGRLayer* layer = nullptr;
  TransformPtr to_terrain;
  int thickness_field = -1;
  PolygonRelease result;
};

std::string comma_separated(const std::vector<std::string>& words) {
  std::string text;
  for (const auto& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

OGRLayer& choose_layer(Reading& reading, GDALDataset& dataset) {
  std::vector<std::string> names;
  for (int i = 0; i < dataset.GetLayerCount(); ++i)
    names.emplace_back(dataset.GetLayer(i)->GetName());
  require(!names.empty(), reading.label + ": holds no layer. Export the polygons again.");
  const std::string& wanted = reading.request.layer;
  if (wanted.empty()) {
    if (names.size() > 1)
      reading.result.notes.push_back(fmt::format("{}: layer '{}' is used, the first of {}",
                                                 reading.label, names[0], comma_separated(names)));
    return *dataset.GetLayer(0);
  }
  OGRLayer* layer = dataset.GetLayerByName(wanted.c_str());
  if (layer == nullptr)
    throw SetupError(fmt::format("{}: has no layer '{}' (release.layer). It has: {}.",
                                 reading.label, wanted, comma_separated(names)));
  return *layer;
}

int find_thickness_field(const Reading& reading) {
  const std::string& name = reading.request.thickness_attribute;
  if (name.empty()) return -1;
  OGRFeatureDefn& fields = *reading.layer->GetLayerDefn();
  const int index = fields.GetFieldIndex(name.c_str());
  if (index >= 0) {
    const OGRFieldType type = fields.GetFieldDefn(index)->GetType();
    require(type == OFTReal || type == OFTInteger || type == OFTInteger64,
            fmt::format("{}: field '{}' (release.thickness_attribute) holds no numbers but {}. "
                        "Store the thickness in metres as a number.",
                        reading.label, name, OGRFieldDefn::GetFieldTypeName(type)));
    return index;
  }
  std::vector<std::string> names;
  for (int i = 0; i < fields.GetFieldCount(); ++i)
    names.emplace_back(fields.GetFieldDefn(i)->GetNameRef());
  throw SetupError(fmt::format("{}: has no field '{}' (release.thickness_attribute). It has: {}.",
                               reading.label, name,
                               names.empty() ? "none" : comma_separated(names)));
}

void settle_transform(Reading& reading, const Grid& terrain) {
  OGREnvelope box;
  if (reading.layer->GetExtent(&box, true) != OGRERR_NONE) box = {};  // an empty layer has none
  const OGRSpatialReference* own = reading.layer->GetSpatialRef();
  if (terrain.crs_wkt.empty()) {
    if (own != nullptr || !reading.request.crs.empty())
      reading.result.notes.push_back(reading.label +
                                     ": its coordinates are taken as they are, because the terrain "
                                     "has no coordinate system");
    return;
  }
  std::string note;
  const OGRSpatialReference from =
      settle_crs(own, {reading.label, reading.request.crs_key, reading.request.crs, "", ""},
                 {box.MinX, box.MaxX, box.MinY, box.MaxY, 0}, note);
  if (!note.empty()) reading.result.notes.push_back(note);
  const OGRSpatialReference to = crs_from_wkt(terrain.crs_wkt);
  reading.to_terrain = transform_between(from, to, reading.label);
  if (reading.to_terrain)
    reading.result.notes.push_back(
        fmt::format("{}: reprojected from {} to {}", reading.label, crs_name(from), crs_name(to)));
}

PolygonsPtr polygons_of(Reading& reading, const OGRGeometry& geometry, const std::string& name) {
  GeometryPtr linear(geometry.hasCurveGeometry() ? geometry.getLinearGeometry() : geometry.clone());
  if (geometry.hasCurveGeometry())
    reading.result.notes.push_back(
        fmt::format("{}: the curves of {} were replaced by short lines", reading.label, name));
  linear->flattenTo2D();
  std::string other;
  PolygonsPtr polygons = polygons_in(*linear, other);
  if (!other.empty())
    throw SetupError(fmt::format("{}: {} is a {}, not a polygon. Draw the release as polygons.",
                                 reading.label, name, other));
  if (reading.to_terrain && polygons->transform(reading.to_terrain.get()) != OGRERR_NONE)
    throw SetupError(
        fmt::format("{}: {} cannot be moved to the terrain's system ({}). Check "
                    "release.crs.",
                    reading.label, name, gdal_reason()));
  if (polygons->IsValid()) return polygons;
  const std::string reason = gdal_reason("it crosses itself");
  const GeometryPtr mended(polygons->MakeValid());
  PolygonsPtr clean = mended ? polygons_in(*mended, other) : std::make_unique<OGRMultiPolygon>();
  reading.result.notes.push_back(
      fmt::format("{}: {} was not a valid polygon ({}); mended, area {:.6g} m2", reading.label,
                  name, reason, clean->get_Area()));
  return clean;
}

double thickness_of(const Reading& reading, OGRFeature& feature, const std::string& name) {
  if (reading.thickness_field < 0) return 1;
  const std::string& field = reading.request.thickness_attribute;
  require(feature.IsFieldSetAndNotNull(reading.thickness_field),
          fmt::format("{}: {} has no value in '{}'. Give its thickness in metres.", reading.label,
                      name, field));
  const double thickness = feature.GetFieldAsDouble(reading.thickness_field);
  require(std::isfinite(thickness) && thickness > 0,
          fmt::format("{}: {} has {} = {:g} (a thickness must be positive). Give metres.",
                      reading.label, name, field, thickness));
  return thickness;
}

std::vector<Source> read_sources(Reading& reading) {
  std::vector<Source> sources;
  reading.layer->ResetReading();
  while (const auto feature = OGRFeatureUniquePtr(reading.layer->GetNextFeature())) {
    Source source;
    source.name = fmt::format("feature {}", feature->GetFID());
    const OGRGeometry* geometry = feature->GetGeometryRef();
    require(geometry != nullptr && !geometry->IsEmpty(),
            fmt::format("{}: {} is empty (no polygon drawn). Draw it or delete it.", reading.label,
                        source.name));
    source.polygons = polygons_of(reading, *geometry, source.name);
    require(source.polygons->get_Area() > 0,
            fmt::format("{}: {} has no area. Draw it again.", reading.label, source.name));
    source.thickness_m = thickness_of(reading, *feature, source.name);
    sources.push_back(std::move(source));
  }
  require(!sources.empty(), fmt::format("{}: layer '{}' has no features (an empty release). Draw "
                                        "the release polygon.",
                                        reading.label, reading.layer->GetName()));
  return sources;
}

/// Without thicknesses the features are one source; what two of them cover counts once.
void merge(Reading& reading, std::vector<Source>& sources) {
  if (sources.size() < 2) return;
  std::vector<const OGRMultiPolygon*> all;
  double sum = 0;
  for (const auto& source : sources) {
    sum += source.polygons->get_Area();
    all.push_back(source.polygons.get());
  }
  PolygonsPtr polygons = united(all, reading.label);
  const double area = polygons->get_Area();
  if (sum - area > 1e-6 * sum)
    reading.result.notes.push_back(
        fmt::format("{}: its {} features overlap by {:.6g} m2, which counts once", reading.label,
                    sources.size(), sum - area));
  sources.resize(1);
  sources[0].name = "all features together";
  sources[0].polygons = std::move(polygons);
}

void refuse_overlaps(const Reading& reading, const std::vector<Source>& sources) {
  for (std::size_t i = 0; i < sources.size(); ++i)
    for (std::size_t j = i + 1; j < sources.size(); ++j) {
      const auto &a = *sources[i].polygons, &b = *sources[j].polygons;
      const double area = shared_area(a, b);
      require(area <= 1e-6 * std::min(a.get_Area(), b.get_Area()),
              fmt::format("{}: {} and {} overlap by {:.6g} m2 (which '{}' holds there?). Cut one "
                          "of them back.",
                          reading.label, sources[i].name, sources[j].name, area,
                          reading.request.thickness_attribute));
    }
}

void require_inside(const Reading& reading, const Source& source, const Grid& terrain) {
  const auto& polygons = *source.polygons;
  const OGRPolygon known = rectangle(terrain, 1e-6 * terrain.cell_m);
  if (known.Contains(&polygons)) return;
  OGREnvelope box;
  polygons.getEnvelope(&box);
  const std::string places = fmt::format(
      "polygon x {:.10g} to {:.10g}, y {:.10g} to {:.10g}; terrain x {:.10g} to {:.10g}, y {:.10g} "
      "to {:.10g}",
      box.MinX, box.MaxX, box.MinY, box.MaxY, terrain.west_m, terrain.east_m(), terrain.south_m(),
      terrain.north_m);
  if (!known.Intersects(&polygons)) {
    const double gap = known.Distance(&polygons);
    throw SetupError(fmt::format(
        "{}: the release polygon ({}) lies {} outside the terrain ({}). Is its coordinate system "
        "right?",
        reading.label, source.name,
        gap >= 1000 ? fmt::format("{:.1f} km", gap / 1000) : fmt::format("{:.1f} m", gap), places));
  }
  const double outside = area_outside(polygons, known);
  throw SetupError(fmt::format(
      "{}: {:.6g} m2 ({:.3g} %) of the release polygon ({}) lie outside the terrain ({}). Use a "
      "larger terrain or cut the polygon.",
      reading.label, outside, 100 * outside / polygons.get_Area(), source.name, places));
}

}  // namespace

PolygonRelease read_release_polygons(const PolygonRequest& request, const Grid& terrain) {
  const GdalScope scope;
  const InputFile file = find_input(request.key, request.path, request.directory);
  const OpenDataset dataset = open_dataset(file.path, file.label, GDAL_OF_VECTOR);
  Reading reading{request, file.label, nullptr, nullptr, -1, {}};
  reading.result.files = files_of(*dataset.dataset);
  reading.layer = &choose_layer(reading, *dataset.dataset);
  reading.thickness_field = find_thickness_field(reading);
  reading.result.is_thickness = reading.thickness_field >= 0;
  settle_transform(reading, terrain);
  std::vector<Source> sources = read_sources(reading);
  if (reading.result.is_thickness) {
    refuse_overlaps(reading, sources);
  } else {
    merge(reading, sources);
  }
  for (const auto& source : sources) require_inside(reading, source, terrain);
  PolygonCover cover(terrain);
  for (const auto& source : sources) {
    const double area = lay_down(*source.polygons, source.thickness_m, cover);
    reading.result.area_m2 += area;
    if (reading.result.is_thickness) reading.result.volume_m3 += area * source.thickness_m;
  }
  reading.result.pattern = cover.finish();
  return std::move(reading.result);
}

}  // namespace sturz
