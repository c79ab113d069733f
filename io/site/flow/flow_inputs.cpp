// SPDX-License-Identifier: Apache-2.0
#include "io/site/flow/flow_inputs.hpp"

#include "engine/core/error.hpp"
#include "io/files/sha256.hpp"
#include "io/files/text_files.hpp"
#include "io/gdal/input_files.hpp"
#include "io/site/flow/hydrograph_csv.hpp"
#include "io/site/flow/named_shapes.hpp"
#include "io/site/stand_in_crs.hpp"
#include "scenarios/assembly/inflow/inflow_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <span>

namespace sturz {
namespace {

struct InflowRead {
  InflowSource source;
  std::vector<FlowFile> files;  ///< the hydrograph, and the layer where there is one
};
struct GaugesRead {
  std::vector<Gauge> points, lines;
  std::vector<FlowFile> files;
};

using Kind = NamedShape::Kind;

Hydrograph read_hydrograph(const std::string& key, const std::string& path,
                           const std::string& directory, FlowFile& file) {
  const InputFile found = find_input(key, path, directory);
  std::string text;
  try {
    text = read_text(found.path);
  } catch (const std::exception&) {
    throw SetupError(found.label + ": cannot be read (is it a file?). Name a CSV file.");
  }
  Hydrograph h = parse_hydrograph(text, found.label);
  file.identity.role = key;
  file.identity.file = found.path;
  file.identity.shape = fmt::format("{} columns", h.solid_fraction.empty() ? 2 : 3);
  Sha256 hash;
  for (const auto* column : {&h.time_s, &h.discharge_m3_s, &h.solid_fraction})
    hash.add_values(std::span<const double>(*column));
  file.identity.parts["rows"] = hash.hex();
  file.notes.push_back(fmt::format("{}: {} rows, {:.6g} m3 from {:g} to {:g} s, at most {:g} m3/s",
                                   found.label, h.time_s.size(), h.total_m3(), h.time_s.front(),
                                   h.time_s.back(), h.peak_m3_s()));
  return h;
}

PolygonRequest layer_request(const Scenario& s, const Grid& terrain, const std::string& key,
                             const std::string& path) {
  PolygonRequest request;
  request.path = path;
  request.key = key;
  request.directory = s.directory;
  request.without_terrain = terrain.n_cols == 0;
  stand_in_with_terrain(request, s.terrain);
  return request;
}

std::vector<NamedShape> read_layer(const PolygonRequest& request, const Grid& terrain,
                                   const std::string& name_attribute, FlowFile& file) {
  const GdalScope scope;
  PolygonLayer layer = open_polygon_layer(request);
  std::vector<NamedShape> shapes = read_named_shapes(layer, request, terrain, name_attribute);
  file.notes = std::move(layer.notes);
  file.warnings = std::move(layer.warnings);
  file.identity = std::move(layer.identity);
  return shapes;
}

void require_inside(const Grid& terrain, const std::string& label,
                    const std::vector<Vec2>& places) {
  if (terrain.n_cols == 0) return;
  for (const Vec2& p : places)
    require(p.x() >= terrain.west_m && p.x() <= terrain.east_m() && p.y() >= terrain.south_m() &&
                p.y() <= terrain.north_m,
            fmt::format("{}: lies outside the terrain (x {:.10g}, y {:.10g}; terrain x {:.10g} to "
                        "{:.10g}, y {:.10g} to {:.10g}). Is its coordinate system right?",
                        label, p.x(), p.y(), terrain.west_m, terrain.east_m(), terrain.south_m(),
                        terrain.north_m));
}

double length_of(const std::vector<Vec2>& corners) {
  double length = 0;
  for (std::size_t i = 1; i < corners.size(); ++i) length += (corners[i] - corners[i - 1]).norm();
  return length;
}

std::vector<Vec2> places_of(const std::vector<std::array<double, 2>>& corners) {
  std::vector<Vec2> out;
  for (const auto& c : corners) out.emplace_back(c[0], c[1]);
  return out;
}

void take_line(std::vector<Vec2> corners, const std::string& label, InflowSource& source) {
  require(corners.size() > 1 && length_of(corners) > 0,
          label + ": has a line without length (its corners are one place). Draw it again.");
  source.lines.push_back(std::move(corners));
}

void read_place(const Scenario& s, const InflowSpec& spec, const std::string& key,
                const Grid& terrain, InflowRead& out) {
  InflowSource& source = out.source;
  if (!spec.line_m.empty()) {
    take_line(places_of(spec.line_m), key + ".line_m", source);
    return require_inside(terrain, key + ".line_m", source.lines.back());
  }
  const bool line = !spec.line.empty();
  const std::string place = key + (line ? ".line" : ".polygon");
  PolygonRequest request = layer_request(s, terrain, place, line ? spec.line : spec.polygon);
  request.layer = spec.layer;
  request.layer_key = key + ".layer";
  request.crs = spec.crs;
  request.crs_key = key + ".crs";
  request.what = line ? "inflow line" : "inflow polygon";
  const std::string label = place + " = " + request.path;
  for (NamedShape& shape : read_layer(request, terrain, {}, out.files.emplace_back())) {
    require(shape.kind == (line ? Kind::line : Kind::polygon),
            fmt::format("{}: holds a {} (a {} is needed). Draw it as one, or name it as {}.", label,
                        shape.kind == Kind::point  ? "point"
                        : shape.kind == Kind::line ? "line"
                                                   : "polygon",
                        line ? "line" : "polygon", line ? "polygon" : "line"));
    require_inside(terrain, label, shape.corners);
    if (line)
      take_line(std::move(shape.corners), label, source);
    else
      source.rings.push_back(std::move(shape.corners));
  }
}

void add_gauge(const Grid& terrain, const std::string& label, bool line, Gauge gauge,
               std::set<std::string>& names, GaugesRead& out) {
  require(
      names.insert(gauge.name).second,
      fmt::format("{}: the name {} stands there twice (tables could not tell them apart). Rename "
                  "one.",
                  label, gauge.name));
  if (line)
    require(length_of(gauge.corners) > 0,
            fmt::format("{}: the line {} has no length. Draw it again.", label, gauge.name));
  require_inside(terrain, label + " (" + gauge.name + ")", gauge.corners);
  (line ? out.lines : out.points).push_back(std::move(gauge));
}

InflowRead read_inflow_source(const Scenario& s, std::size_t i, const Grid& terrain) {
  const InflowSpec& spec = s.inflow[i];
  const std::string key = fmt::format("inflow[{}]", i);
  InflowRead out;
  out.source.label = spec.name.empty() ? key : fmt::format("{} ({})", key, spec.name);
  out.source.hydrograph =
      read_hydrograph(key + ".hydrograph", spec.hydrograph, s.directory, out.files.emplace_back());
  require(
      out.source.hydrograph.solid_fraction.empty() || s.mixture,
      fmt::format("{}.hydrograph = {}: has a column solid_fraction (there is no mixture that it "
                  "would join). Remove the column, or add `mixture`.",
                  key, spec.hydrograph));
  read_place(s, spec, key, terrain, out);
  return out;
}

GaugesRead read_gauges(const Scenario& s, const Grid& terrain) {
  const GaugesSpec& spec = *s.gauges;
  GaugesRead out;
  std::set<std::string> names;
  for (const GaugeSpec& g : spec.points)
    add_gauge(terrain, "gauges.points", false, {g.name, places_of(g.corners_m)}, names, out);
  for (const GaugeSpec& g : spec.lines)
    add_gauge(terrain, "gauges.lines", true, {g.name, places_of(g.corners_m)}, names, out);
  if (spec.file.empty()) return out;
  PolygonRequest request = layer_request(s, terrain, "gauges.file", spec.file);
  request.layer = spec.layer;
  request.layer_key = "gauges.layer";
  request.crs = spec.crs;
  request.crs_key = "gauges.crs";
  request.what = "gauge (a point or a line)";
  const std::string label = "gauges.file = " + spec.file;
  for (NamedShape& shape :
       read_layer(request, terrain, spec.name_attribute, out.files.emplace_back())) {
    require(shape.kind != Kind::polygon,
            label + ": holds a polygon (gauges are points and lines). Draw its outline as a line.");
    add_gauge(terrain, label, shape.kind == Kind::line,
              {std::move(shape.name), std::move(shape.corners)}, names, out);
  }
  return out;
}

template <class Call>
void attempt(FlowRead& out, Call call) {
  try {
    call();
  } catch (const SetupError& problem) {
    out.problems.emplace_back(problem.what());
  }
}

void keep_files(std::vector<FlowFile>& files, FlowRead& out) {
  std::move(files.begin(), files.end(), std::back_inserter(out.files));
}

}  // namespace

FlowRead read_flow(const Scenario& s, const Grid& terrain) {
  FlowRead out;
  for (std::size_t i = 0; i < s.inflow.size(); ++i)
    attempt(out, [&] {
      InflowRead read = read_inflow_source(s, i, terrain);
      out.inflow.push_back(std::move(read.source));
      keep_files(read.files, out);
    });
  if (s.gauges)
    attempt(out, [&] {
      GaugesRead read = read_gauges(s, terrain);
      out.points = std::move(read.points), out.lines = std::move(read.lines);
      keep_files(read.files, out);
    });
  return out;
}

Raster<double> empty_release(const std::vector<InflowSource>& sources, const Grid& terrain) {
  Window under;
  for (const InflowSource& source : sources) under = joined(under, cells_below(source, terrain));
  return Raster<double>(grid_of(under, terrain), 0.0);
}

}  // namespace sturz
