// SPDX-License-Identifier: Apache-2.0
// The outline of standing water.
#include "io/gdal/gdal_vector.hpp"
#include "io/site/loading/loading.hpp"
#include "io/site/release_shapes.hpp"
#include "io/site/stand_in_crs.hpp"
#include "scenarios/assembly/liquid/pool.hpp"

#include <utility>

namespace sturz {
namespace {

PolygonRequest request_of(const Scenario& scenario) {
  const PoolSpec& spec = *scenario.fluid->pool;
  PolygonRequest request;
  request.path = spec.polygon;
  request.layer = spec.layer;
  request.key = "fluid.pool.polygon";
  request.directory = scenario.directory;
  request.crs = spec.crs;
  request.crs_key = "fluid.pool.crs";
  request.layer_key = "fluid.pool.layer";
  request.what = "pool";
  stand_in_with_terrain(request, scenario.terrain);
  return request;
}

bool has_pool(const Scenario& s) { return s.fluid && s.fluid->pool; }

void read_polygon(Loading& loading) {
  PolygonRequest request = request_of(loading.scenario);
  request.without_terrain = loading.grid().n_cols == 0;
  PolygonRelease read = read_release_polygons(request, loading.grid());
  if (request.without_terrain) return;
  loading.take(read);
  loading.inputs.pool = std::make_shared<const Raster<double>>(std::move(read.pattern));
}

}  // namespace

void load_pool(Loading& loading) {
  if (!has_pool(loading.scenario)) return;
  const PoolSpec& spec = *loading.scenario.fluid->pool;
  if (!spec.polygon.empty()) return loading.attempt([&] { read_polygon(loading); });
  if (!spec.box || loading.grid().n_cols == 0) return;
  loading.attempt([&] {
    ShapeCover read = cover_of(*spec.box, loading.grid(), "fluid.pool.box");
    loading.inputs.pool = std::make_shared<const Raster<double>>(std::move(read.cover));
  });
}

void check_pool(Loading& loading) {
  if (!has_pool(loading.scenario)) return;
  loading.attempt([&] { require_pool(loading.scenario, loading.inputs); });
}

}  // namespace sturz
