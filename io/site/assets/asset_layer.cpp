// SPDX-License-Identifier: Apache-2.0
#include "engine/core/error.hpp"
#include "io/files/plain_text.hpp"
#include "io/files/sha256.hpp"
#include "io/files/text_files.hpp"
#include "io/gdal/input_files.hpp"
#include "io/site/assets/asset_files.hpp"
#include "io/site/assets/touched_cells.hpp"
#include "io/site/polygon_cover.hpp"
#include "io/site/polygon_layer.hpp"
#include "io/site/stand_in_crs.hpp"
#include "scenarios/schema/suggest.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <span>
#include <utility>

namespace sturz {
namespace {

using GeometryPtr = std::unique_ptr<OGRGeometry>;

/// Smaller shares of a cell are round-off of polygons drawn along its edge.
constexpr double least_share = 1e-9;
constexpr std::size_t most_named = 5;

/// What the steps below share.
struct Reading {
  const AssetsSpec& spec;
  const PolygonRequest& request;
  PolygonLayer layer;
  const Grid& maps;
  TransformPtr to_maps;
  int name_field = -1, class_field = -1, value_field = -1;
  Sha256 hash;  ///< of geometries as the file has them, names, classes, values
  Assets assets;
  std::map<std::string, std::string> seen;  ///< name -> its feature

  [[noreturn]] void refuse(const std::string& feature, const std::string& rest) const {
    throw SetupError(fmt::format("{}: {} {}", layer.label, feature, rest));
  }
};

PolygonRequest request_of(const Scenario& scenario, bool without_terrain) {
  PolygonRequest request;
  request.path = scenario.assets->features;
  request.layer = scenario.assets->layer;
  request.key = "assets.features";
  request.layer_key = "assets.layer";
  request.directory = scenario.directory;
  request.crs = scenario.assets->crs;
  request.crs_key = "assets.crs";
  request.what = "assets";
  request.without_terrain = without_terrain;
  stand_in_with_terrain(request, scenario.terrain);
  return request;
}

int find_field(const PolygonLayer& layer, const std::string& name, const char* key) {
  if (name.empty()) return -1;
  OGRFeatureDefn& fields = *layer.layer->GetLayerDefn();
  if (const int index = fields.GetFieldIndex(name.c_str()); index >= 0) return index;
  std::vector<std::string> names;
  for (int i = 0; i < fields.GetFieldCount(); ++i)
    names.emplace_back(fields.GetFieldDefn(i)->GetNameRef());
  throw SetupError(fmt::format("{}: has no field '{}' ({}). It has: {}.", layer.label, name, key,
                               names.empty() ? "none" : comma_separated(names)));
}

void touch_polygon(const OGRPolygon& polygon, const Grid& maps, TouchedCells& cells) {
  if (maps.n_cols == 0) return;  // only the file is checked
  const OGRPolygon edge = rectangle(maps, 0);
  if (!edge.Contains(&polygon)) cells.mark_beyond();
  const GeometryPtr inside(polygon.Intersection(&edge));
  std::string ignored;
  const PolygonsPtr polygons = inside ? polygons_in(*inside, ignored) : nullptr;
  if (polygons == nullptr || polygons->IsEmpty()) return;
  OGREnvelope box;
  polygons->getEnvelope(&box);
  PolygonCover cover(maps, cells_under(box.MinX, box.MaxX, box.MinY, box.MaxY, maps));
  lay_down(*polygons, 1, cover);
  const Raster<double> share = cover.finish();
  const Window at = window_of(share.grid, maps);
  for (int row = 0; row < at.n_rows; ++row)
    for (int col = 0; col < at.n_cols; ++col)
      if (share.at(row, col) > least_share)
        cells.add_cell(maps.index(at.row0 + row, at.col0 + col));
}

/// Corners of all parts; polygons are laid over the cells. \return the name of another kind
std::string touch(const OGRGeometry& geometry, const Grid& maps, TouchedCells& cells) {
  const OGRwkbGeometryType type = wkbFlatten(geometry.getGeometryType());
  if (type == wkbPoint) {
    cells.add_point({geometry.toPoint()->getX(), geometry.toPoint()->getY()});
  } else if (type == wkbLineString) {
    std::vector<Vec2> corners;
    for (const OGRPoint& p : *geometry.toLineString()) corners.emplace_back(p.getX(), p.getY());
    cells.add_line(corners);
  } else if (type == wkbPolygon) {
    touch_polygon(*geometry.toPolygon(), maps, cells);
  } else if (OGR_GT_IsSubClassOf(type, wkbGeometryCollection)) {
    for (const OGRGeometry* part : *geometry.toGeometryCollection())
      if (std::string other = touch(*part, maps, cells); !other.empty()) return other;
  } else {
    return geometry.getGeometryName();
  }
  return {};
}

std::string wkb_of(const OGRGeometry& geometry) {
  std::string bytes(geometry.WkbSize(), '\0');
  geometry.exportToWkb(wkbNDR, reinterpret_cast<unsigned char*>(bytes.data()), wkbVariantIso);
  return bytes;
}

/// Valid, flat, of straight lines, in the system of the maps.
GeometryPtr geometry_of(Reading& r, const OGRFeature& read, const std::string& feature) {
  const OGRGeometry* own = read.GetGeometryRef();
  if (own == nullptr || own->IsEmpty()) r.refuse(feature, "is empty. Draw it or delete it.");
  GeometryPtr geometry(own->hasCurveGeometry() ? own->getLinearGeometry() : own->clone());
  geometry->flattenTo2D();
  r.hash.add_text(wkb_of(*geometry));
  if (r.to_maps && geometry->transform(r.to_maps.get()) != OGRERR_NONE)
    r.refuse(feature, fmt::format("cannot be moved to the terrain's system ({}). Check assets.crs.",
                                  gdal_reason()));
  OGREnvelope box;
  geometry->getEnvelope(&box);
  for (const double v : {box.MinX, box.MaxX, box.MinY, box.MaxY})
    if (!(std::abs(v) <= farthest_coordinate))
      r.refuse(feature, fmt::format("reaches out to coordinate {:g} (no place on the earth). Draw "
                                    "it again.",
                                    v));
  if (geometry->IsValid()) return geometry;
  GeometryPtr valid(geometry->MakeValid());
  if (valid == nullptr || valid->IsEmpty()) r.refuse(feature, "has no extent. Draw it again.");
  r.layer.notes.push_back(
      fmt::format("{}: {} was not a valid geometry; mended", r.layer.label, feature));
  return valid;
}

std::string text_in(Reading& r, const OGRFeature& read, int field, const std::string& feature,
                    const std::string& attribute, const char* advice) {
  std::string text;
  if (read.IsFieldSetAndNotNull(field)) text = as_utf8(read.GetFieldAsString(field));
  if (text.find_first_not_of(" \t\r\n") == std::string::npos)
    r.refuse(feature, fmt::format("has no value in '{}'. {}", attribute, advice));
  r.hash.add_text(text);
  return text;
}

void read_class(Reading& r, const OGRFeature& read, const std::string& feature, Asset& asset) {
  if (r.class_field < 0) return;
  asset.vulnerability_class =
      text_in(r, read, r.class_field, feature, r.spec.class_attribute, "Give its class.");
  std::vector<std::string> known;
  for (std::size_t i = 0; i < r.assets.curves.size(); ++i) {
    known.push_back(r.assets.curves[i].name);
    if (known.back() == asset.vulnerability_class) asset.curve = i;
  }
  if (asset.curve || known.empty()) return;  // without curves their own file has a problem
  r.refuse(feature, fmt::format("is of class '{}', for which assets.vulnerability has no curve. It "
                                "has: {}.",
                                asset.vulnerability_class, comma_separated(known)));
}

void read_value(Reading& r, const OGRFeature& read, const std::string& feature, Asset& asset) {
  if (r.value_field < 0) return;
  const std::string& field = r.spec.value_attribute;
  if (!read.IsFieldSetAndNotNull(r.value_field))
    r.refuse(feature, fmt::format("has no value in '{}'. Give what it is worth in {}.", field,
                                  r.spec.value_unit));
  asset.value = read.GetFieldAsDouble(r.value_field);
  if (!(std::isfinite(asset.value) && asset.value >= 0))
    r.refuse(feature, fmt::format("has {} = {:g} (a value is 0 or more). Give {}.", field,
                                  asset.value, r.spec.value_unit));
  r.hash.add_values(std::span<const double>(&asset.value, 1));
}

void read_feature(Reading& r, const OGRFeature& read) {
  const std::string feature = fmt::format("feature {}", read.GetFID());
  Asset asset;
  const GeometryPtr geometry = geometry_of(r, read, feature);
  asset.wkb = wkb_of(*geometry);
  TouchedCells cells(r.maps);
  if (const std::string other = touch(*geometry, r.maps, cells); !other.empty())
    r.refuse(feature, fmt::format("is a {} (assets are points, lines or polygons). Draw it as one "
                                  "of them.",
                                  other));
  asset.cells = cells.finish();
  asset.partly_beyond = cells.beyond() && !asset.cells.empty();
  asset.name = text_in(r, read, r.name_field, feature, r.spec.name_attribute, "Name it.");
  const auto [earlier, fresh] = r.seen.emplace(asset.name, feature);
  if (!fresh)
    r.refuse(feature, fmt::format("has the name '{}' of {} (rows of the table could not be told "
                                  "apart). Give each its own.",
                                  asset.name, earlier->second));
  read_class(r, read, feature, asset);
  read_value(r, read, feature, asset);
  r.assets.list.push_back(std::move(asset));
}

std::string list_of(const std::vector<std::string>& names) {
  std::vector<std::string> shown(
      names.begin(),
      names.begin() + static_cast<std::ptrdiff_t>(std::min(most_named, names.size())));
  std::string text = fmt::format("{}", fmt::join(shown, ", "));
  if (names.size() > most_named) text += fmt::format(" and {} others", names.size() - most_named);
  return text;
}

/// Looks at the ground under the cells, tile by tile: a raster is read once however many assets it
/// holds.
void find_ground(std::vector<Asset>& list, const Grid& maps, const Grid& terrain,
                 const ReadGround& read) {
  constexpr int tile = 256;  // cells of the terrain
  struct Place {
    Asset* asset;
    int row, col;
  };
  std::map<std::pair<int, int>, std::vector<Place>> tiles;
  for (Asset& asset : list)
    for (const std::size_t cell : asset.cells) {
      const auto width = static_cast<std::size_t>(maps.n_cols);
      const int row = terrain.row_of(maps.y_center(static_cast<int>(cell / width)));
      const int col = terrain.col_of(maps.x_center(static_cast<int>(cell % width)));
      if (terrain.contains(row, col))
        tiles[{row / tile, col / tile}].push_back({&asset, row, col});
      else
        asset.partly_beyond = true;
    }
  for (const auto& [number, places] : tiles) {
    const int row0 = number.first * tile, col0 = number.second * tile;
    const Raster<double> ground =
        read(window_between(row0, row0 + tile, col0, col0 + tile, terrain));
    const Window held = window_of(ground.grid, terrain);
    for (const Place& p : places) {
      const bool known = held.contains(p.row, p.col) &&
                         std::isfinite(ground.at(p.row - held.row0, p.col - held.col0));
      (known ? p.asset->on_known_ground : p.asset->partly_beyond) = true;
    }
  }
}

/// What lies beyond the maps has no hits because nothing is computed there.
void tell_places(Reading& r) {
  const std::vector<Asset>& list = r.assets.list;
  std::vector<std::string> beyond, partly;
  for (const Asset& a : list) {
    if (a.place() == AssetPlace::outside) beyond.push_back(a.name);
    if (a.place() == AssetPlace::partly_outside) partly.push_back(a.name);
  }
  OGREnvelope box;
  if (r.layer.layer->GetExtent(&box, true) != OGRERR_NONE) box = {};
  require(
      beyond.size() < list.size(),
      fmt::format("{}: no asset lies on known ground (terrain x {:.10g} to {:.10g}, y {:.10g} to "
                  "{:.10g}; the layer's own coordinates: x {:.10g} to {:.10g}, y {:.10g} to "
                  "{:.10g}). Is its coordinate system right?",
                  r.layer.label, r.maps.west_m, r.maps.east_m(), r.maps.south_m(), r.maps.north_m,
                  box.MinX, box.MaxX, box.MinY, box.MaxY));
  if (!beyond.empty())
    r.layer.warnings.push_back(fmt::format(
        "{}: {} of {} assets lie beyond the known ground, and nothing is said of them: {}",
        r.layer.label, beyond.size(), list.size(), list_of(beyond)));
  if (!partly.empty())
    r.layer.warnings.push_back(
        fmt::format("{}: a part of {} assets lies beyond the known ground and is not looked at: {}",
                    r.layer.label, partly.size(), list_of(partly)));
  r.layer.notes.push_back(
      fmt::format("{}: {} assets on known ground", r.layer.label, list.size() - beyond.size()));
}

void read_curves(const Scenario& scenario, AssetsRead& out) {
  const AssetsSpec& spec = *scenario.assets;
  if (spec.vulnerability.empty()) return;
  const InputFile file = find_input("assets.vulnerability", spec.vulnerability, scenario.directory);
  std::string text;
  try {
    text = read_text(file.path);
  } catch (const std::exception&) {
    throw SetupError(file.label + ": cannot be read (is it a file?). Name a YAML file.");
  }
  out.assets.curves = parse_damage_curves(text, file.label);
  InputIdentity identity;
  identity.role = "assets.vulnerability";
  identity.file = file.path;
  identity.shape = fmt::format("{} classes", out.assets.curves.size());
  Sha256 hash;
  for (const DamageCurve& curve : out.assets.curves) {
    hash.add_text(curve.name + "/" + info(curve.intensity).name);
    for (const DamageCurve::Point& p : curve.points) {
      const std::array<double, 2> numbers{p.intensity, p.damage};
      hash.add_values(std::span<const double>(numbers));
    }
  }
  identity.parts["curves"] = hash.hex();
  out.identities.push_back(std::move(identity));
}

void read_layer(const Scenario& scenario, const Grid& maps, const Grid& terrain,
                const ReadGround& ground, AssetsRead& out) {
  const GdalScope scope;
  const AssetsSpec& spec = *scenario.assets;
  const PolygonRequest request = request_of(scenario, maps.n_cols == 0);
  PolygonLayer opened = open_polygon_layer(request);
  // Before anything is asked of its fields: an empty layer has mostly none.
  require(opened.layer->GetFeatureCount(true) > 0,
          fmt::format("{}: layer '{}' has no features. Draw the assets.", opened.label,
                      opened.layer->GetName()));
  TransformPtr to_maps = terrain_transform(opened, request, maps);
  Reading r{spec, request, std::move(opened), maps, std::move(to_maps), -1, -1, -1, {}, {}, {}};
  r.name_field = find_field(r.layer, spec.name_attribute, "assets.name_attribute");
  r.class_field = find_field(r.layer, spec.class_attribute, "assets.class_attribute");
  r.value_field = find_field(r.layer, spec.value_attribute, "assets.value_attribute");
  if (r.value_field >= 0) {
    const OGRFieldType type = r.layer.layer->GetLayerDefn()->GetFieldDefn(r.value_field)->GetType();
    require(type == OFTReal || type == OFTInteger || type == OFTInteger64,
            fmt::format("{}: field '{}' (assets.value_attribute) holds no numbers but {}. Store "
                        "the value in {} as a number.",
                        r.layer.label, spec.value_attribute, OGRFieldDefn::GetFieldTypeName(type),
                        spec.value_unit));
  }
  r.assets = std::move(out.assets);
  r.layer.layer->ResetReading();
  while (const auto read = OGRFeatureUniquePtr(r.layer.layer->GetNextFeature()))
    read_feature(r, *read);
  if (maps.n_cols > 0) {
    find_ground(r.assets.list, maps, terrain, ground);
    tell_places(r);
  }
  r.assets.has_classes = r.class_field >= 0;
  r.assets.has_values = r.value_field >= 0;
  r.assets.value_unit = spec.value_unit;
  r.layer.identity.shape =
      fmt::format("{} features, {}", r.assets.list.size(), r.layer.identity.shape);
  r.layer.identity.parts["features"] = r.hash.hex();
  out.assets = std::move(r.assets);
  out.notes = std::move(r.layer.notes);
  out.warnings = std::move(r.layer.warnings);
  out.identities.push_back(std::move(r.layer.identity));
}

}  // namespace

AssetsRead read_assets(const Scenario& scenario, const Grid& maps, const Grid& terrain,
                       const ReadGround& read) {
  AssetsRead out;
  std::string problem;
  try {
    read_curves(scenario, out);
  } catch (const SetupError& error) {
    problem = error.what();
  }
  try {
    read_layer(scenario, maps, terrain, read, out);
  } catch (const SetupError& error) {
    problem += (problem.empty() ? "" : "\n") + std::string(error.what());
  }
  require(problem.empty(), problem);
  return out;
}

}  // namespace sturz
