// SPDX-License-Identifier: Apache-2.0
#include "io/site/scene_inputs.hpp"

#include "engine/core/error.hpp"
#include "io/files/checksum.hpp"
#include "io/gdal/crs.hpp"
#include "io/gdal/gdal_raster.hpp"
#include "io/gdal/gdal_vector.hpp"
#include "io/gdal/raster_source.hpp"
#include "io/site/release_shapes.hpp"
#include "io/site/thickness_raster.hpp"
#include "io/site/zone_cells.hpp"
#include "scenarios/assembly/ground.hpp"
#include "scenarios/assembly/release_pattern.hpp"
#include "scenarios/schema/zone_fields.hpp"
#include "scenarios/shapes/synthetic_terrain.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <numeric>

namespace sturz {
namespace {

/// What the steps below fill in.
struct Loading {
  const Scenario& scenario;
  SceneInputs inputs;
  std::string release_label;  ///< for messages about the release
  std::optional<Raster<double>> synthetic_source;

  void take(std::vector<std::string>& notes, const std::vector<std::string>& files) {
    std::move(notes.begin(), notes.end(), std::back_inserter(inputs.notes));
    for (const auto& file : files) {
      std::error_code error;
      const auto name = std::filesystem::proximate(file, scenario.directory, error);
      const std::string known = scenario.directory.empty() || error ? file : name.string();
      inputs.checksums.emplace_back(known, file_checksum(file));
    }
  }
  void set_release(Raster<double> pattern, ReleasePattern kind) {
    inputs.release = std::make_shared<const Raster<double>>(std::move(pattern));
    inputs.pattern = kind;
  }
  const Grid& grid() const { return inputs.elevation->grid; }
};

double raster_sum(const Raster<double>& raster) {
  return std::accumulate(raster.values.begin(), raster.values.end(), 0.0) * raster.grid.cell_m *
         raster.grid.cell_m;
}

void load_synthetic(Loading& loading) {
  const TerrainSpec& spec = loading.scenario.terrain;
  require(!spec.cell_size_m,
          "terrain.cell_size_m: is for rasters (a synthetic terrain has its own "
          "cell_size_m). Give it inside terrain.synthetic.");
  SyntheticScene scene = make_synthetic(*spec.synthetic);
  if (!spec.crs.empty()) {
    const OGRSpatialReference crs = parse_crs(spec.crs, "terrain.crs");
    require(crs.IsProjected() && std::abs(crs.GetLinearUnits() - 1) < 1e-9,
            fmt::format("terrain.crs = {}: a synthetic terrain needs a projected system in metres, "
                        "like EPSG:32633.",
                        spec.crs));
    scene.bed.grid.crs_wkt = crs_wkt2(crs);
  }
  if (scene.thickness) scene.thickness->grid = scene.bed.grid;
  loading.synthetic_source = std::move(scene.thickness);
  loading.inputs.elevation = std::make_shared<const Raster<double>>(std::move(scene.bed));
}

void load_terrain(Loading& loading) {
  const TerrainSpec& spec = loading.scenario.terrain;
  require(spec.raster.empty() != !spec.synthetic,
          "terrain: needs either raster or synthetic (one of them). Name a raster file.");
  if (spec.synthetic) return load_synthetic(loading);
  RasterRequest request;
  request.path = spec.raster;
  request.directory = loading.scenario.directory;
  request.crs = spec.crs;
  request.cell_size_m = spec.cell_size_m;
  RasterRead read = read_elevation(request);
  loading.take(read.notes, read.files);
  loading.inputs.elevation = std::make_shared<const Raster<double>>(std::move(read.raster));
}

/// Two numbers that a reader can hold against each other: the source's and the raster's.
void note_rasterised(Loading& loading, double exact_m2) {
  const ReleaseSpec& release = loading.scenario.release;
  const double laid = raster_sum(*loading.inputs.release);
  std::string text =
      fmt::format("{}: area {:.9g} m2, on the terrain's cells {:.9g} m2 ({:+.2g} %)",
                  loading.release_label, exact_m2, laid, 100 * (laid / exact_m2 - 1));
  const bool vertical = release.thickness == ThicknessDirection::vertical;
  if (vertical && release.thickness_m && release.thickness_m->is_fixed())
    text += fmt::format("; x {:g} m = {:.9g} m3, laid out {:.9g} m3", release.thickness_m->value,
                        exact_m2 * release.thickness_m->value, laid * release.thickness_m->value);
  loading.inputs.notes.push_back(text);
}

void load_polygon(Loading& loading) {
  const ReleaseSpec& spec = loading.scenario.release;
  loading.release_label = "release.polygon = " + spec.polygon;
  PolygonRequest request;
  request.path = spec.polygon;
  request.layer = spec.layer;
  request.thickness_attribute = spec.thickness_attribute;
  request.directory = loading.scenario.directory;
  request.crs = spec.crs;
  PolygonRelease read = read_release_polygons(request, loading.grid());
  loading.take(read.notes, read.files);
  loading.inputs.source_area_m2 = read.area_m2;
  loading.inputs.source_volume_m3 = read.volume_m3;
  loading.set_release(std::move(read.pattern),
                      read.is_thickness ? ReleasePattern::thickness : ReleasePattern::cover);
  if (!read.is_thickness) return note_rasterised(loading, read.area_m2);
  loading.inputs.notes.push_back(
      fmt::format("{}: area {:.9g} m2, area x {} {:.9g} m3, on the terrain's cells {:.9g} m3",
                  loading.release_label, read.area_m2, spec.thickness_attribute, read.volume_m3,
                  raster_sum(*loading.inputs.release)));
}

void load_thickness_raster(Loading& loading) {
  const ReleaseSpec& spec = loading.scenario.release;
  loading.release_label = "release.thickness_raster = " + spec.thickness_raster;
  RasterRequest request;
  request.path = spec.thickness_raster;
  request.key = "release.thickness_raster";
  request.directory = loading.scenario.directory;
  request.crs = spec.crs;
  request.crs_key = "release.crs";
  request.factor = spec.thickness_factor;
  // Where the terrain's file had no system, the thickness beside it mostly shares the lack, and
  // the user has named the system once.
  request.fallback_crs = loading.scenario.terrain.crs;
  request.fallback_crs_key = "terrain.crs";
  ThicknessRead read = read_thickness(request, loading.grid());
  loading.take(read.notes, read.files);
  loading.inputs.source_area_m2 = read.area_m2;
  loading.inputs.source_volume_m3 = read.volume_m3;
  loading.set_release(std::move(read.thickness), ReleasePattern::thickness);
}

template <class Shape>
void load_shape(Loading& loading, const Shape& shape, const char* key) {
  loading.release_label = key;
  ShapeCover read = cover_of(shape, loading.grid());
  loading.inputs.source_area_m2 = read.area_m2;
  loading.set_release(std::move(read.cover), ReleasePattern::cover);
  if (read.unit_volume_m3 == read.area_m2) note_rasterised(loading, read.area_m2);
}

void load_synthetic_source(Loading& loading) {
  require(loading.synthetic_source.has_value(),
          "release: names no source (the terrain brings none of its own). Add polygon, "
          "thickness_raster, box, paraboloid or cylinder.");
  loading.release_label = "the synthetic terrain's own source";
  Raster<double>& source = *loading.synthetic_source;
  const double cell_area = source.grid.cell_m * source.grid.cell_m;
  for (double& v : source.values) {
    if (!(v > 0)) v = 0;
    if (v > 0) loading.inputs.source_area_m2 += cell_area;
  }
  loading.inputs.source_volume_m3 = raster_sum(source);
  loading.set_release(std::move(source), ReleasePattern::thickness);
}

void load_release(Loading& loading) {
  const ReleaseSpec& spec = loading.scenario.release;
  const int named = !spec.polygon.empty() + !spec.thickness_raster.empty() + spec.box.has_value() +
                    spec.paraboloid.has_value() + spec.cylinder.has_value();
  require(named <= 1,
          "release: names more than one source. Keep one of polygon, thickness_raster, "
          "box, paraboloid, cylinder.");
  if (!spec.polygon.empty()) return load_polygon(loading);
  if (!spec.thickness_raster.empty()) return load_thickness_raster(loading);
  if (spec.box) return load_shape(loading, *spec.box, "release.box");
  if (spec.paraboloid) return load_shape(loading, *spec.paraboloid, "release.paraboloid");
  if (spec.cylinder) return load_shape(loading, *spec.cylinder, "release.cylinder");
  load_synthetic_source(loading);
}

/// A mass cannot start where the ground is not known.
void require_known_ground(const Loading& loading) {
  const Grid& g = loading.grid();
  const auto &ground = loading.inputs.elevation->values, &release = loading.inputs.release->values;
  std::size_t count = 0, first = 0;
  for (std::size_t i = 0; i < ground.size(); ++i)
    if (release[i] > 0 && std::isnan(ground[i]) && count++ == 0) first = i;
  if (count == 0) return;
  const int row = static_cast<int>(first / static_cast<std::size_t>(g.n_cols));
  const int col = static_cast<int>(first % static_cast<std::size_t>(g.n_cols));
  throw SetupError(
      fmt::format("{}: lies on {} nodata cells of terrain.raster = {}, the first at row {}, column "
                  "{} (x {:.10g},"
                  " y {:.10g}). Fill the terrain there or move the release.",
                  loading.release_label, count, loading.scenario.terrain.raster, row, col,
                  g.x_center(col), g.y_center(row)));
}

PolygonRequest zone_request(const Scenario& scenario, std::size_t i) {
  const BasalZone& zone = scenario.basal.zones[i];
  const std::string name = fmt::format("basal.zones[{}]", i);
  PolygonRequest request;
  request.path = zone.polygon;
  request.layer = zone.layer;
  request.key = name + ".polygon";
  request.directory = scenario.directory;
  request.crs_key.clear();  // the file itself has to say it
  request.layer_key = name + ".layer";
  request.what = "zone";
  return request;
}

void load_zones(Loading& loading) {
  const auto& zones = loading.scenario.basal.zones;
  if (zones.empty()) return;
  expect(zones.size() <= most_basal_zones, "a scenario is validated before its files are read");
  const Grid& grid = loading.grid();
  Raster<std::uint8_t> numbers(grid, 0);
  for (std::size_t i = 0; i < zones.size(); ++i) {
    ZoneCells read = read_zone_cells(zone_request(loading.scenario, i), grid);
    loading.take(read.notes, read.files);
    for (const std::size_t cell : read.cells)
      numbers.values[cell] = static_cast<std::uint8_t>(i + 1);
    const auto n = static_cast<double>(read.cells.size());
    loading.inputs.notes.push_back(fmt::format("basal.zones[{}] {}: {} cells, {:.9g} m2", i,
                                               zones[i].polygon, read.cells.size(),
                                               n * grid.cell_m * grid.cell_m));
  }
  loading.inputs.zones = std::make_shared<const Raster<std::uint8_t>>(std::move(numbers));
}

Grid hazard_grid(const Scenario& scenario, const Grid& terrain) {
  if (!scenario.hazard.cell_size_m) return terrain;
  const double cell = *scenario.hazard.cell_size_m;
  require(cell > 0,
          fmt::format("hazard.cell_size_m = {:g} (must be positive). Give metres.", cell));
  // Enough cells to cover the terrain; one that would only hold round-off is not added.
  const double n_cols = std::ceil((terrain.east_m() - terrain.west_m) / cell - 1e-6);
  const double n_rows = std::ceil((terrain.north_m - terrain.south_m()) / cell - 1e-6);
  require_raster_size(n_cols, n_rows, "hazard.cell_size_m");
  return {static_cast<int>(n_cols), static_cast<int>(n_rows), terrain.west_m, terrain.north_m, cell,
          terrain.crs_wkt};
}

}  // namespace

SceneInputs load_scene_inputs(const Scenario& scenario) {
  Loading loading{scenario, {}, {}, {}};
  load_terrain(loading);
  load_release(loading);
  require_known_ground(loading);
  shape_release(scenario, loading.inputs);
  load_zones(loading);
  loading.inputs.hazard_grid = hazard_grid(scenario, loading.grid());
  prepare_grounds(scenario, loading.inputs);
  return std::move(loading.inputs);
}

}  // namespace sturz
