// SPDX-License-Identifier: Apache-2.0
#include "io/site/bed/bed_layers.hpp"

#include "engine/core/error.hpp"
#include "io/site/stand_in_crs.hpp"
#include "scenarios/assembly/reach.hpp"

#include <fmt/core.h>

#include <utility>

namespace sturz {
namespace {

RasterRequest request_of(const Scenario& scenario, const RasterField& field) {
  RasterRequest request;
  request.path = raster_of(scenario.basal, field).path;
  request.key = raster_path(field);
  request.directory = scenario.directory;
  request.crs = scenario.basal.rasters.crs;
  request.crs_key = "basal.rasters.crs";
  stand_in_with_terrain(request, scenario.terrain);
  return request;
}

BedRasterLimits limits_of(const Scenario& scenario, const RasterField& field) {
  BedRasterLimits limits;
  limits.key = &basal_key(field);
  limits.factor_key = raster_path(field) + "_factor";
  if (const auto& factor = raster_of(scenario.basal, field).factor)
    limits.factor = drawn_range(*factor);
  return limits;
}

BedLayerInput& layer_of(SceneInputs& in, BedNumber number) {
  for (BedLayerInput& layer : in.bed_layers)
    if (layer.number == number) return layer;
  BedLayerInput& made = in.bed_layers.emplace_back();
  made.number = number;
  made.least = made.most = made.mean = nan_d;
  return made;
}

bool differs(double a, double b) { return a != b && !(std::isnan(a) && std::isnan(b)); }

}  // namespace

OpenBedLayer open_bed_layer(const Scenario& scenario, const RasterField& field,
                            const Grid& terrain) {
  return {&field, std::make_unique<BedRasterFile>(request_of(scenario, field),
                                                  limits_of(scenario, field), terrain)};
}

void check_bed_layer(const Scenario& scenario, const RasterField& field) {
  check_bed_raster(request_of(scenario, field), limits_of(scenario, field),
                   scenario.terrain.crs == local_crs);
}

bool measure_bed_layers(const OpenBedLayers& layers, const Window& window, SceneInputs& in) {
  bool changed = false;
  for (const OpenBedLayer& open : layers) {
    const KnownRange range = known_range(open.file->on(window));
    BedLayerInput& layer = layer_of(in, open.field->number);
    changed = changed || differs(layer.least, range.least) || differs(layer.most, range.most);
    layer.least = range.least, layer.most = range.most, layer.mean = range.mean;
  }
  return changed;
}

void lay_bed_layers(const OpenBedLayers& layers, SceneInputs& in) {
  for (const OpenBedLayer& open : layers) {
    Raster<double> values = open.file->on(in.held());
    const KnownRange range = known_range(values);
    const std::size_t n = values.values.size();
    require(range.count > 0,
            fmt::format("{}: has no value on any of the {} cells of the terrain that the flow may "
                        "reach. Is its coordinate system right?",
                        open.file->label(), n));
    const char* const unit =
        basal_key(*open.field).units == "1" ? "" : basal_key(*open.field).units.c_str();
    std::string text = fmt::format("{}: {:g} to {:g}{}{} on {} of {} cells", open.file->label(),
                                   range.least, range.most, *unit ? " " : "", unit, range.count, n);
    if (range.count < n) text += fmt::format("; the others have basal.{}", open.field->name);
    in.notes.push_back(std::move(text));
    layer_of(in, open.field->number).values =
        std::make_shared<const Raster<double>>(std::move(values));
  }
}

}  // namespace sturz
