// SPDX-License-Identifier: Apache-2.0
#include "io/site/scene_inputs.hpp"

#include "engine/core/error.hpp"
#include "io/doubts/release_doubts.hpp"
#include "io/gdal/crs.hpp"
#include "io/gdal/gdal_raster.hpp"
#include "io/gdal/gdal_vector.hpp"
#include "io/gdal/raster_source.hpp"
#include "io/site/bed/bed_inputs.hpp"
#include "io/site/flow/flow_inputs.hpp"
#include "io/site/hazard_grid.hpp"
#include "io/site/loading/loading.hpp"
#include "io/site/observed/event_reader.hpp"
#include "io/site/observed/observed_outline.hpp"
#include "io/site/release/release_requests.hpp"
#include "io/site/release_hash.hpp"
#include "io/site/release_shapes.hpp"
#include "io/site/stand_in_crs.hpp"
#include "io/site/terrain_request.hpp"
#include "io/site/terrain_window.hpp"
#include "io/site/thickness_raster.hpp"
#include "scenarios/assembly/ground.hpp"
#include "scenarios/assembly/release_pattern.hpp"
#include "scenarios/shapes/synthetic_terrain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

namespace sturz {
namespace {

/// What is said of the terrain comes before what is said of release and zones.
void take_ground(Loading& loading, RasterRead& read) {
  SceneInputs& in = loading.inputs;
  SceneInputs others;
  std::swap(others.notes, in.notes);
  std::swap(others.warnings, in.warnings);
  std::swap(others.identities, in.identities);
  loading.take(read);
  std::move(others.notes.begin(), others.notes.end(), std::back_inserter(in.notes));
  std::move(others.warnings.begin(), others.warnings.end(), std::back_inserter(in.warnings));
  std::move(others.identities.begin(), others.identities.end(), std::back_inserter(in.identities));
  in.elevation = std::make_shared<const Raster<double>>(std::move(read.raster));
}

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
  if (!spec.crs.empty() && spec.crs != local_crs) {
    const OGRSpatialReference crs = parse_crs(spec.crs, "terrain.crs");
    require(crs.IsProjected() && std::abs(crs.GetLinearUnits() - 1) < 1e-9,
            fmt::format("terrain.crs = {}: a synthetic terrain needs a projected system in metres, "
                        "like EPSG:32633, or the word local.",
                        spec.crs));
    scene.bed.grid.crs_wkt = crs_wkt2(crs);
  }
  if (scene.thickness) scene.thickness->grid = scene.bed.grid;
  loading.synthetic_source = std::move(scene.thickness);
  loading.inputs.whole = scene.bed.grid;
  loading.inputs.elevation = std::make_shared<const Raster<double>>(std::move(scene.bed));
}

/// Opens it; what is read of it follows from the release.
void open_raster(Loading& loading) {
  loading.raster = std::make_unique<ElevationRaster>(terrain_request(loading.scenario));
  loading.inputs.whole = loading.raster->grid();
}

void load_terrain(Loading& loading) {
  const TerrainSpec& spec = loading.scenario.terrain;
  require(spec.raster.empty() != !spec.synthetic,
          "terrain: needs either raster or synthetic (one of them). Name a raster file.");
  if (spec.synthetic) return load_synthetic(loading);
  open_raster(loading);
}

/// Elevations of a window, read or cut out.
Raster<double> ground_of(Loading& loading, const Window& w) {
  if (loading.raster) return loading.raster->look(w);
  const Raster<double>& all = *loading.inputs.elevation;
  Raster<double> part(grid_of(w, all.grid));
  for (int r = 0; r < w.n_rows; ++r)
    std::copy_n(&all.at(w.row0 + r, w.col0), w.n_cols, &part.at(r, 0));
  return part;
}

/// The energy line of the least friction within its own reach: where rasters give the friction,
/// how far it comes and what it meets there decide each other.
FirstGround find_first_ground(Loading& loading) {
  SceneInputs& in = loading.inputs;
  const ReadGround read = [&](const Window& w) { return ground_of(loading, w); };
  Window seen = window_of(in.release->grid, loading.grid());
  measure_bed_layers(loading.bed_layers, seen, in);
  for (;;) {
    FirstGround first = first_ground(loading.scenario, in, read, loading.release_label);
    const Window next = joined(seen, first.reach ? first.reach->window : first.window);
    if (loading.bed_layers.empty() || next == seen ||
        !measure_bed_layers(loading.bed_layers, next, in))
      return first;
    seen = next;
  }
}

/// Reads the part of the terrain that members start with.
void load_ground(Loading& loading) {
  SceneInputs& in = loading.inputs;
  const FirstGround first = find_first_ground(loading);
  in.reach = first.reach;
  in.first_window = first.window;
  if (!loading.raster) return;
  RasterRead read = loading.raster->read(first.window);
  if (first.reach) {
    // The longest time of a run follows from it, also where terrain.window is smaller. One cell
    // more: beyond its edge the energy line lies under the ground.
    const Window seen = widened(first.reach->window, 1, loading.grid());
    if (!first.window.contains(seen))
      read.identity.parts.merge(loading.raster->read(seen).identity.parts);
  }
  take_ground(loading, read);
}

/// By how much `a` is beyond `b` [%]; less than a millionth, rounding for instance, is none.
double percent_beyond(double a, double b) {
  const double percent = 100 * (a / b - 1);
  return std::abs(percent) < 1e-4 ? 0 : percent;
}

/// Two numbers that a reader can hold against each other: the source's and the raster's.
void note_rasterised(Loading& loading, double exact_m2) {
  const ReleaseSpec& release = loading.scenario.release;
  const double laid = raster_sum(*loading.inputs.release);
  std::string text =
      fmt::format("{}: area {:.7g} m2, on the terrain's cells {:.7g} m2 ({:+.2g} %)",
                  loading.release_label, exact_m2, laid, percent_beyond(laid, exact_m2));
  const bool vertical = release.thickness == ThicknessDirection::vertical;
  if (vertical && release.thickness_m && release.thickness_m->is_fixed())
    text += fmt::format("; x {:g} m = {:.7g} m3, laid out {:.7g} m3", release.thickness_m->value,
                        exact_m2 * release.thickness_m->value, laid * release.thickness_m->value);
  loading.inputs.notes.push_back(text);
}

void load_polygon(Loading& loading) {
  const ReleaseSpec& spec = loading.scenario.release;
  loading.release_label = "release.polygon = " + spec.polygon;
  PolygonRelease read =
      read_release_polygons(release_polygon_request(loading.scenario), loading.grid());
  loading.take(read);
  loading.inputs.source_area_m2 = read.area_m2;
  loading.inputs.source_volume_m3 = read.volume_m3;
  loading.inputs.release_starts = std::move(read.starts);
  loading.set_release(std::move(read.pattern),
                      read.is_thickness ? ReleasePattern::thickness : ReleasePattern::cover);
  if (!read.is_thickness) return note_rasterised(loading, read.area_m2);
  loading.inputs.release_cover = std::make_shared<const Raster<double>>(std::move(read.cover));
  loading.inputs.notes.push_back(
      fmt::format("{}: area {:.7g} m2, area x {} {:.7g} m3, on the terrain's cells {:.7g} m3",
                  loading.release_label, read.area_m2,
                  spec.thickness_attribute.empty() ? "volume over area" : spec.thickness_attribute,
                  read.volume_m3, raster_sum(*loading.inputs.release)));
}

void load_thickness_raster(Loading& loading) {
  const ReleaseSpec& spec = loading.scenario.release;
  loading.release_label = "release.thickness_raster = " + spec.thickness_raster;
  const RasterRequest request = release_raster_request(loading.scenario);
  ThicknessRead read = read_thickness(request, loading.grid());
  loading.take(read);
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
  if (read.unit_volume_m3 == read.area_m2) return note_rasterised(loading, read.area_m2);
  loading.inputs.release_cover.reset();  // a dome covers every cell that holds some of it
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

/// Where mass enters and where the flow is followed; only checked while no ground is known.
void load_flow(Loading& loading) {
  FlowRead read = read_flow(loading.scenario, loading.grid());
  SceneInputs& in = loading.inputs;
  in.inflow = std::move(read.inflow);
  in.gauge_points = std::move(read.points), in.gauge_lines = std::move(read.lines);
  for (FlowFile& file : read.files) loading.take(file);
  std::move(read.problems.begin(), read.problems.end(), std::back_inserter(loading.problems));
}

void load_release(Loading& loading) {
  const ReleaseSpec& spec = loading.scenario.release;
  const int named = !spec.polygon.empty() + !spec.thickness_raster.empty() + spec.box.has_value() +
                    spec.paraboloid.has_value() + spec.cylinder.has_value();
  const bool none = named == 0 && !loading.synthetic_source;
  if (none && !loading.scenario.inflow.empty()) {
    loading.release_label = "inflow";
    const auto& sources = loading.inputs.inflow;
    if (!sources.empty())
      loading.set_release(empty_release(sources, loading.grid()), ReleasePattern::thickness);
    return;
  }
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

/// What holds whatever part of the terrain is read: release, observed outline, grids, reach.
SceneInputs without_ground(SceneInputs inputs) {
  inputs.elevation = nullptr;
  inputs.ground = inputs.column_ground = nullptr;
  inputs.zones = nullptr;
  inputs.bed_supply = nullptr;
  for (BedLayerInput& layer : inputs.bed_layers) layer.values = nullptr;
  inputs.notes.clear();
  inputs.warnings.clear();
  inputs.identities.clear();
  return inputs;
}

/// An empty grid, where the terrain cannot be read: then it is only checked.
void load_observed(Loading& loading) {
  if (loading.scenario.hazard.observed_polygon.empty()) return;
  loading.attempt([&] {
    ObservedOutline read = read_observed_outline(loading.scenario, loading.grid());
    loading.inputs.observed = std::move(read.rings);
    loading.take(read);
  });
}

/// The same for what members are scored against.
void load_event(Loading& loading) {
  if (!loading.scenario.observation) return;
  loading.attempt([&] {
    const Grid& terrain = loading.grid();
    const Grid maps = terrain.n_cols > 0 ? hazard_grid(loading.scenario, terrain) : Grid{};
    EventRead read = read_observed_event(loading.scenario, maps, loading.inputs.release.get());
    loading.take_words(read);
    for (InputIdentity& identity : read.identities) loading.take_identity(identity);
    std::move(read.rings.begin(), read.rings.end(), std::back_inserter(loading.inputs.observed));
    loading.inputs.event = std::make_shared<const ObservedEvent>(std::move(read.event));
  });
}

/// What can be said of release and zones when the terrain cannot be read.
void check_without_terrain(Loading& loading) {
  const Scenario& scenario = loading.scenario;
  const bool local = scenario.terrain.crs == local_crs;
  if (!scenario.release.polygon.empty())
    loading.attempt([&] {
      PolygonRequest request = release_polygon_request(scenario);
      request.without_terrain = true;
      read_release_polygons(request, {});
    });
  if (!scenario.release.thickness_raster.empty())
    loading.attempt([&] { check_thickness(release_raster_request(scenario), local); });
  check_structures(loading);
  load_flow(loading);
  load_pool(loading);
  check_zones(loading);
  open_bed_layers(loading);
  load_bed_supply(loading);
  load_observed(loading);
  load_event(loading);
  load_assets(loading, {});
  load_overlays(loading);
}

}  // namespace

SceneInputs load_scene_inputs(const Scenario& scenario) {
  Loading loading{scenario, {}, {}, {}, {}, {}, {}};
  loading.attempt([&] { load_terrain(loading); });
  SceneInputs& inputs = loading.inputs;
  if (inputs.whole.n_cols == 0) {
    check_without_terrain(loading);
    loading.refuse_problems();
  }
  load_flow(loading);
  load_pool(loading);
  const bool outlined = loading.problems.empty();
  loading.attempt([&] { load_release(loading); });
  const bool complete = inputs.inflow.size() == scenario.inflow.size();
  open_bed_layers(loading);
  if (inputs.release && complete)
    loading.attempt([&] {
      load_ground(loading);
      load_structures(loading, [&](const Window& w) { return ground_of(loading, w); });
      stand_structures(loading);
      shape_release(scenario, inputs);
    });
  if (inputs.elevation) {
    if (outlined) check_pool(loading);
    load_zones(loading);
    load_bed_layers(loading);
  } else {
    check_zones(loading);
  }
  load_bed_supply(loading);
  load_observed(loading);
  load_event(loading);
  load_assets(loading, [&](const Window& w) { return ground_of(loading, w); });
  load_overlays(loading);
  loading.refuse_problems();
  expect(inputs.release && inputs.elevation, "a scene without problems has its release and ground");
  std::string doubt = edge_doubt(*inputs.release, loading.grid(), loading.release_label);
  if (!doubt.empty() && !scenario.terrain.synthetic) inputs.warnings.push_back(std::move(doubt));
  inputs.release_hash = hash_of_release(inputs);
  inputs.hazard_grid = hazard_grid(scenario, loading.grid());
  prepare_grounds(scenario, inputs);
  return std::move(inputs);
}

SceneInputs load_larger_inputs(const Scenario& scenario, const SceneInputs& first, int level) {
  Loading loading{scenario, {}, {}, {}, {}, {}, {}};
  SceneInputs& inputs = loading.inputs;
  open_raster(loading);
  require(inputs.whole.same_place(first.whole),
          fmt::format("terrain.raster = {}: has another grid than before (it was changed while "
                      "members were computed). Take the file back and go on.",
                      scenario.terrain.raster));
  RasterRead read = loading.raster->read(larger_window(first.first_window, level, inputs.whole));
  const Grid whole = std::move(inputs.whole);
  inputs = without_ground(first);
  inputs.whole = whole;
  inputs.level = level;
  take_ground(loading, read);
  stand_structures(loading);
  open_bed_layers(loading);
  load_zones(loading);
  load_bed_layers(loading);
  load_bed_supply(loading);
  loading.refuse_problems();
  inputs.release_hash = hash_of_release(inputs);
  prepare_grounds(scenario, inputs);
  return std::move(inputs);
}

}  // namespace sturz
