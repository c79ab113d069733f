// SPDX-License-Identifier: Apache-2.0
// The bed of a scene: zones, rasters, and what can be taken along.
#include "io/site/bed/bed_inputs.hpp"
#include "io/site/loading/loading.hpp"
#include "io/site/zone_cells.hpp"

#include <cstdint>

namespace sturz {
namespace {

void load_zone(Loading& loading, std::size_t i, Raster<std::uint8_t>& numbers) {
  const Grid& grid = loading.grid();
  ZoneCells read = read_zone_cells(zone_request(loading.scenario, i), grid, loading.inputs.held());
  loading.take(read);
  for (const std::size_t cell : read.cells) numbers.values[cell] = static_cast<std::uint8_t>(i + 1);
  loading.inputs.notes.push_back(fmt::format(
      "basal.zones[{}] {}: {} cells, {:.9g} m2", i, loading.scenario.basal.zones[i].polygon,
      read.n_on_terrain, static_cast<double>(read.n_on_terrain) * grid.cell_m * grid.cell_m));
}

}  // namespace

void load_zones(Loading& loading) {
  const auto& zones = loading.scenario.basal.zones;
  if (zones.empty()) return;
  expect(zones.size() <= most_basal_zones, "a scenario is validated before its files are read");
  Raster<std::uint8_t> numbers(loading.inputs.elevation->grid, 0);
  for (std::size_t i = 0; i < zones.size(); ++i)
    loading.attempt([&] { load_zone(loading, i, numbers); });
  loading.inputs.zones = std::make_shared<const Raster<std::uint8_t>>(std::move(numbers));
}

void load_bed_supply(Loading& loading) {
  if (!has_bed_supply_file(loading.scenario)) return;
  loading.attempt([&] {
    if (!loading.inputs.elevation) return check_bed_supply(loading.scenario);
    BedSupplyInput read = read_bed_supply(loading.scenario, loading.grid(), loading.inputs.held());
    loading.inputs.bed_supply = std::make_shared<const Raster<double>>(std::move(read.pattern));
    loading.take(read);
  });
}

void load_bed_layers(Loading& loading) {
  loading.attempt([&] { lay_bed_layers(loading.bed_layers, loading.inputs); });
}

void check_zones(Loading& loading) {
  for (std::size_t i = 0; i < loading.scenario.basal.zones.size(); ++i)
    loading.attempt([&] {
      PolygonRequest request = zone_request(loading.scenario, i);
      request.without_terrain = true;
      read_zone_cells(request, {});
    });
}

void open_bed_layers(Loading& loading) {
  const bool known = loading.grid().n_cols > 0;
  for (const RasterField& field : raster_fields)
    if (names_raster(loading.scenario.basal, field))
      loading.attempt([&] {
        if (!known) return check_bed_layer(loading.scenario, field);
        OpenBedLayer& open = loading.bed_layers.emplace_back(
            open_bed_layer(loading.scenario, field, loading.grid()));
        loading.take(*open.file);
      });
}

}  // namespace sturz
