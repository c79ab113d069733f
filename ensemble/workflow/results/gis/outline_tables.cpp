// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/results/gis/outline_tables.hpp"

#include "io/features/cell_polygons.hpp"
#include "io/features/shapes.hpp"
#include "reports/gis/vector_style.hpp"
#include "scenarios/layers/plane_name.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

namespace sturz::workflow {
namespace {

constexpr int band_rows = 128;  // the chunks of the files that maps are read from
constexpr std::size_t most_classes = 255;

using Texts = std::vector<std::string>;
using Integers = std::vector<std::int64_t>;
using Numbers = std::vector<double>;

/// Class of each cell, 1 the first of the legend; 0: clear.
Raster<std::uint8_t> classes_of(const LayerSource& maps, std::size_t layer, std::size_t plane,
                                const Legend& legend, CancelFlag cancel) {
  Raster<std::uint8_t> classes(maps.about().grid);
  const Grid& grid = classes.grid;
  std::vector<float> values;
  for (int row = 0; row < grid.n_rows; row += band_rows) {
    cancel.check();
    const Window band{row, 0, std::min(band_rows, grid.n_rows - row), grid.n_cols};
    values.resize(band.n_cells());
    maps.read(layer, plane, band, values);
    std::transform(values.begin(), values.end(),
                   classes.values.begin() + static_cast<std::ptrdiff_t>(grid.index(row, 0)),
                   [&](float v) { return static_cast<std::uint8_t>(legend.class_of(v) + 1); });
  }
  return classes;
}

std::string quantity_word(const Layer& layer) {
  if (layer.meaning.statistic == Statistic::probability) return "probability";
  return std::string(to_string(layer.meaning.quantity));
}

}  // namespace

bool is_outlined(const Layer& layer) {
  const auto [quantity, statistic, intensity] = layer.meaning;
  if (statistic == Statistic::probability) return true;
  return (statistic == Statistic::quantile || statistic == Statistic::peak) &&
         (quantity == Quantity::thickness || quantity == Quantity::deposit);
}

FeatureTable class_areas(const LayerSource& maps, std::size_t number, std::size_t plane,
                         const Legend& legend, CancelFlag cancel) {
  const Layer& layer = maps.about().layers[number];
  const Grid& grid = maps.about().grid;
  FeatureTable table;
  table.name = plane_file_name(layer, plane);
  table.crs_wkt = grid.crs_wkt;
  if (legend.classes.size() > most_classes) return table;
  const Raster<std::uint8_t> classes = classes_of(maps, number, plane, legend, cancel);
  std::array<std::size_t, most_classes + 1> n_cells{};
  for (const std::uint8_t c : classes.values) ++n_cells[c];
  Integers places;
  Texts labels;
  Numbers from, to, areas;
  const std::string unit = legend.unit.label.empty() ? "" : " " + legend.unit.label;
  for (auto& [value, wkb] : classes_as_polygons(classes, cancel)) {
    const std::size_t k = value - std::size_t{1};
    const bool last = k + 1 == legend.classes.size();
    table.wkb.push_back(std::move(wkb));
    places.push_back(value);
    labels.push_back(legend.classes[k].label + unit);
    from.push_back(legend.classes[k].lower / legend.unit.factor);
    const double end = legend.probability ? 1 : nan_d;
    to.push_back(last ? end : legend.classes[k + 1].lower / legend.unit.factor);
    areas.push_back(static_cast<double>(n_cells[value]) * grid.cell_m * grid.cell_m);
  }
  const std::string word = quantity_word(layer);
  const std::string suffix = layer.units == "1" ? "" : "_" + layer.units;
  table.columns = {{class_column, std::move(places)},
                   {"label", std::move(labels)},
                   {word + "_from" + suffix, std::move(from)},
                   {word + "_to" + suffix, std::move(to)},
                   {"area_m2", std::move(areas)}};
  return table;
}

FeatureTable release_area(const Raster<std::uint8_t>& cells) {
  FeatureTable table{"release", cells.grid.crs_wkt, {}, {}};
  const auto n = std::count_if(cells.values.begin(), cells.values.end(),
                               [](std::uint8_t c) { return c != 0; });
  if (n == 0) return table;
  table.wkb.push_back(cells_as_polygons(cells));
  table.columns = {
      {"area_m2", Numbers{static_cast<double>(n) * cells.grid.cell_m * cells.grid.cell_m}}};
  return table;
}

FeatureTable observed_area(const std::vector<std::vector<Vec2>>& rings,
                           const std::string& crs_wkt) {
  FeatureTable table{"observed", crs_wkt, {}, {}};
  if (!rings.empty()) table.wkb.push_back(rings_as_wkb(rings));
  return table;
}

FeatureTable thalweg_line(const SceneInputs& inputs, const std::string& crs_wkt) {
  FeatureTable table{"thalweg", crs_wkt, {}, {}};
  if (inputs.event == nullptr || inputs.event->thalweg.size() < 2) return table;
  const std::vector<Vec2>& corners = inputs.event->thalweg;
  double length = 0;
  for (std::size_t i = 1; i < corners.size(); ++i) length += (corners[i] - corners[i - 1]).norm();
  table.wkb.push_back(line_as_wkb(corners));
  table.columns = {{"length_m", Numbers{length}}};
  return table;
}

FeatureTable gauge_table(const std::string& name, std::span<const Gauge> gauges,
                         const std::string& crs_wkt) {
  FeatureTable table{name, crs_wkt, {}, {}};
  Texts names;
  for (const Gauge& gauge : gauges) {
    names.push_back(gauge.name);
    table.wkb.push_back(gauge.corners.size() < 2 ? point_as_wkb(gauge.corners.front())
                                                 : line_as_wkb(gauge.corners));
  }
  table.columns = {{"name", std::move(names)}};
  return table;
}

FeatureTable deposit_centres(std::span<const MemberSummary> members, const std::string& crs_wkt) {
  FeatureTable table{"deposit_centres", crs_wkt, {}, {}};
  Integers numbers;
  Texts outcomes, censored;
  constexpr std::pair<const char*, double MemberScalars::*> shown[] = {
      {"com_travel_m", &MemberScalars::com_travel_m},
      {"runout_m", &MemberScalars::runout_m},
      {"crown_to_toe_length_m", &MemberScalars::crown_to_toe_length_m},
      {"reached_area_m2", &MemberScalars::reached_area_m2},
      {"release_volume_m3", &MemberScalars::release_volume_m3}};
  std::vector<Numbers> values(std::size(shown));
  for (const MemberSummary& m : members) {
    const Vec2 at(m.scalars.deposit_com_x_m, m.scalars.deposit_com_y_m);
    if (!is_valid(m.outcome) || !at.allFinite()) continue;
    table.wkb.push_back(point_as_wkb(at));
    numbers.push_back(m.member);
    outcomes.emplace_back(to_string(m.outcome));
    censored.emplace_back(to_string(m.censoring));
    for (std::size_t k = 0; k < values.size(); ++k) values[k].push_back(m.scalars.*shown[k].second);
  }
  table.columns = {{"member", std::move(numbers)},
                   {"outcome", std::move(outcomes)},
                   {"censored", std::move(censored)}};
  for (std::size_t k = 0; k < values.size(); ++k)
    table.columns.push_back({shown[k].first, std::move(values[k])});
  return table;
}

}  // namespace sturz::workflow
