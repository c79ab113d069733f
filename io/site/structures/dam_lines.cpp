// SPDX-License-Identifier: Apache-2.0
#include "engine/core/error.hpp"
#include "io/files/sha256.hpp"
#include "io/gdal/crs.hpp"
#include "io/gdal/gdal_handles.hpp"
#include "io/site/polygon_layer.hpp"
#include "io/site/stand_in_crs.hpp"
#include "io/site/structures/structure_inputs.hpp"
#include "scenarios/assembly/structures/dams.hpp"
#include "scenarios/schema/dam_fields.hpp"
#include "scenarios/schema/suggest.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace sturz {
namespace {

/// Along one line; a dam is no longer than that, and what is longer is a broken file.
constexpr double most_points = 1e5;

PolygonRequest request_of(const Scenario& scenario, std::size_t dam) {
  const DamSpec& spec = scenario.terrain.dams[dam];
  PolygonRequest request;
  request.path = spec.line;
  request.layer = spec.layer;
  request.key = dam_path(dam) + ".line";
  request.directory = scenario.directory;
  request.crs_key.clear();  // no key of its own
  stand_in_with_terrain(request, scenario.terrain);
  request.layer_key = dam_path(dam) + ".layer";
  request.what = "dam";
  return request;
}

struct Line {
  std::string name;
  std::vector<Vec2> corners;
  std::optional<double> height_m;
};

void collect(const OGRGeometry& geometry, std::vector<const OGRLineString*>& into,
             std::string& other) {
  switch (wkbFlatten(geometry.getGeometryType())) {
    case wkbLineString:
      into.push_back(geometry.toLineString());
      break;
    case wkbMultiLineString:
    case wkbGeometryCollection:
      for (const OGRGeometry* part : *geometry.toGeometryCollection()) collect(*part, into, other);
      break;
    default:
      other = OGRGeometryTypeToName(geometry.getGeometryType());
  }
}

/// Index of the field with heights; refused where there is none of that name.
int height_field(OGRLayer& layer, const std::string& label, const std::string& name) {
  OGRFeatureDefn& fields = *layer.GetLayerDefn();
  const int index = fields.GetFieldIndex(name.c_str());
  if (index >= 0) return index;
  std::vector<std::string> names;
  for (int i = 0; i < fields.GetFieldCount(); ++i)
    names.emplace_back(fields.GetFieldDefn(i)->GetNameRef());
  throw SetupError(fmt::format("{}: has no field '{}' (height_attribute). It has: {}.", label, name,
                               names.empty() ? "none" : comma_separated(names)));
}

double height_of(const OGRFeature& feature, int field, const std::string& label,
                 const std::string& name) {
  const DamField& limits = dam_fields[0];
  const bool set = feature.IsFieldSetAndNotNull(field) != 0;
  const double height = set ? feature.GetFieldAsDouble(field) : nan_d;
  require(height > limits.min && height <= limits.max,
          fmt::format("{}: height of {} is {} (must be > {:g} and <= {:g} m).", label, name,
                      set ? fmt::format("{:g}", height) : std::string("not given"), limits.min,
                      limits.max));
  return height;
}

/// What the steps below share.
struct Reading {
  PolygonLayer& layer;
  TransformPtr to_terrain;
  Sha256 hash;  ///< of corners and heights as the file has them
};

std::vector<Vec2> corners_of(Reading& reading, const OGRLineString& line, const std::string& name) {
  std::vector<Vec2> corners;
  std::vector<double> numbers{static_cast<double>(line.getNumPoints())};
  for (int i = 0; i < line.getNumPoints(); ++i) {
    double x = line.getX(i), y = line.getY(i);
    numbers.insert(numbers.end(), {x, y});
    require(!reading.to_terrain || reading.to_terrain->Transform(1, &x, &y) != 0,
            fmt::format("{}: {} cannot be moved to the terrain's system ({}). Check the file's own "
                        "system.",
                        reading.layer.label, name, gdal_reason()));
    require(std::abs(x) <= farthest_coordinate && std::abs(y) <= farthest_coordinate,
            fmt::format("{}: {} reaches out to coordinate {:g} (no place on the earth). Draw it "
                        "again.",
                        reading.layer.label, name, std::abs(x) > std::abs(y) ? x : y));
    corners.emplace_back(x, y);
  }
  reading.hash.add_values(std::span<const double>(numbers));
  return corners;
}

std::vector<Line> lines_of(const Scenario& scenario, std::size_t dam, const Grid& terrain,
                           bool only_check, DamRead& told) {
  const DamSpec& spec = scenario.terrain.dams[dam];
  PolygonRequest request = request_of(scenario, dam);
  request.without_terrain = only_check;
  PolygonLayer layer = open_polygon_layer(request);
  Reading reading{layer, terrain_transform(layer, request, terrain), {}};
  const int field = spec.height_attribute.empty()
                        ? -1
                        : height_field(*layer.layer, layer.label, spec.height_attribute);
  std::vector<Line> lines;
  layer.layer->ResetReading();
  int n_features = 0;
  while (const auto feature = OGRFeatureUniquePtr(layer.layer->GetNextFeature())) {
    const std::string name = fmt::format("feature {}", feature->GetFID());
    const OGRGeometry* geometry = feature->GetGeometryRef();
    require(
        geometry != nullptr && !geometry->IsEmpty(),
        fmt::format("{}: {} is empty (no line drawn). Draw it or delete it.", layer.label, name));
    ++n_features;
    const std::unique_ptr<OGRGeometry> linear(
        geometry->hasCurveGeometry() ? geometry->getLinearGeometry() : geometry->clone());
    std::vector<const OGRLineString*> parts;
    std::string other;
    collect(*linear, parts, other);
    require(other.empty(), fmt::format("{}: {} is a {}, not a line. Draw the dam as a line along "
                                       "its crest.",
                                       layer.label, name, other));
    std::optional<double> height;
    if (field >= 0) {
      height = height_of(*feature, field, layer.label, name);
      reading.hash.add_values(std::span<const double>(&*height, 1));
    }
    for (const OGRLineString* part : parts)
      lines.push_back({name, corners_of(reading, *part, name), height});
  }
  require(!lines.empty(), fmt::format("{}: layer '{}' has no features (an empty dam). Draw its "
                                      "line.",
                                      layer.label, layer.layer->GetName()));
  layer.identity.shape = fmt::format("{} features, {}", n_features, layer.identity.shape);
  layer.identity.parts["features"] = reading.hash.hex();
  told.notes = std::move(layer.notes);
  told.warnings = std::move(layer.warnings);
  told.identity = std::move(layer.identity);
  return lines;
}

/// Points a cell or less apart.
std::vector<Vec2> densified(const std::vector<Vec2>& corners, double step) {
  std::vector<Vec2> points;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    const Vec2 along = corners[i + 1] - corners[i];
    const int n = std::max(1, static_cast<int>(std::ceil(along.norm() / step * (1 - 1e-9))));
    for (int k = 0; k < n; ++k)
      points.emplace_back(corners[i] + (static_cast<double>(k) / n) * along);
  }
  points.push_back(corners.back());
  return points;
}

/// Between the four cell centres around a place; NaN beside unknown ground.
double bilinear(const Raster<double>& z, const Vec2& p) {
  const Grid& g = z.grid;
  const double u = (p.x() - g.west_m) / g.cell_m - 0.5, v = (g.north_m - p.y()) / g.cell_m - 0.5;
  // The last centre belongs to the block before it.
  const auto first = [](double at, int n) {
    return at == n - 1 ? n - 2 : static_cast<int>(std::floor(at));
  };
  const int col = first(u, g.n_cols), row = first(v, g.n_rows);
  if (!g.contains(row, col) || !g.contains(row + 1, col + 1)) return nan_d;
  const double e = u - col, s = v - row;
  return (1 - s) * ((1 - e) * z.at(row, col) + e * z.at(row, col + 1)) +
         s * ((1 - e) * z.at(row + 1, col) + e * z.at(row + 1, col + 1));
}

void find_ground(DamLine& line, const Grid& terrain, const ReadGround& read) {
  const Window near = window_around(line.points, 2 * terrain.cell_m, terrain);
  Raster<double> z;
  if (near.n_cells() > 0) z = read(near);
  std::size_t unknown = 0, first = 0;
  for (std::size_t i = 0; i < line.points.size(); ++i) {
    line.ground_m.push_back(near.n_cells() > 0 ? bilinear(z, line.points[i]) : nan_d);
    if (std::isnan(line.ground_m.back()) && unknown++ == 0) first = i;
  }
  if (unknown == 0) return;
  throw SetupError(fmt::format(
      "{}: {} of {} points along its line lie on no known ground, the first at x {:.10g}, y "
      "{:.10g} "
      "(terrain x {:.10g} to {:.10g}, y {:.10g} to {:.10g}). Shorten the line or fill the terrain.",
      line.name, unknown, line.points.size(), line.points[first].x(), line.points[first].y(),
      terrain.west_m, terrain.east_m(), terrain.south_m(), terrain.north_m));
}

}  // namespace

DamRead read_dam_lines(const Scenario& scenario, std::size_t dam, const Grid& terrain,
                       const ReadGround& read) {
  const GdalScope scope;
  const DamSpec& spec = scenario.terrain.dams[dam];
  const bool known = terrain.n_cols > 0;
  DamRead out;
  std::vector<Line> lines;
  if (spec.line.empty()) {
    Line& only = lines.emplace_back();
    for (const auto& [x, y] : spec.points_m) only.corners.emplace_back(x, y);
  } else {
    lines = lines_of(scenario, dam, terrain, !known, out);
  }
  if (!known) return out;
  for (Line& read_line : lines) {
    DamLine& line = out.lines.emplace_back();
    line.dam = dam;
    line.name = dam_path(dam) + (lines.size() > 1 ? " " + read_line.name : "");
    line.height_m = read_line.height_m;
    for (std::size_t i = 0; i + 1 < read_line.corners.size(); ++i)
      line.length_m += (read_line.corners[i + 1] - read_line.corners[i]).norm();
    require(line.length_m > 0,
            line.name + ": its line has no length (all its corners are one place). Draw it again.");
    require(
        line.length_m <= most_points * terrain.cell_m,
        fmt::format("{}: its line is {:.6g} m long (too long for cells of {:g} m). Draw the part "
                    "that the flow may meet.",
                    line.name, line.length_m, terrain.cell_m));
    line.points = densified(read_line.corners, terrain.cell_m);
    find_ground(line, terrain, read);
  }
  return out;
}

}  // namespace sturz
