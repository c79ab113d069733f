// SPDX-License-Identifier: Apache-2.0
#include "scenarios/assembly/bed/bed_rasters_plan.hpp"

#include "scenarios/assembly/reach.hpp"
#include "scenarios/schema/raster_fields.hpp"

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

const RasterField& field_of(BedNumber number) {
  return raster_fields[static_cast<std::size_t>(number)];
}
Uncertain factor_of(const Scenario& s, BedNumber number) {
  return raster_of(s.basal, field_of(number)).factor.value_or(Uncertain(1));
}
/// xi is the only number that basal may lack.
std::optional<Uncertain> own_number(const BasalSpec& basal, BedNumber number) {
  switch (number) {
    case BedNumber::friction:
      return basal.friction_coefficient;
    case BedNumber::pore_pressure:
      return basal.pore_pressure_ratio;
    case BedNumber::cohesion:
      return basal.cohesion_pa;
    case BedNumber::turbulence:
      break;
  }
  return basal.turbulent_coefficient_m_s2;
}

}  // namespace

BedRasters plan_bed_rasters(const Scenario& s, const SceneInputs& in) {
  BedRasters out;
  if (in.bed_layers.empty()) return out;
  for (const BedLayerInput& layer : in.bed_layers) {
    const double factor = factor_of(s, layer.number).value;
    BedRasters::Layer& made = out.layers.emplace_back();
    made.number = layer.number;
    made.values = layer.values;
    made.factor = factor;
    made.least = factor * layer.least, made.most = factor * layer.most;
  }
  for (const BasalZone& zone : s.basal.zones) {
    auto& given = out.given.emplace_back();
    for (const RasterField& field : raster_fields)
      given[static_cast<std::size_t>(field.number)] = (zone.*field.zone).has_value();
  }
  const Window held = in.held();
  out.whole = in.terrain_grid();
  out.row0 = held.row0, out.col0 = held.col0;
  return out;
}

Scenario with_typical_bed(Scenario s, const SceneInputs& in) {
  for (const BedLayerInput& layer : in.bed_layers) {
    if (std::isnan(layer.mean)) continue;
    const double mean = factor_of(s, layer.number).value * layer.mean;
    BasalSpec& basal = s.basal;
    switch (layer.number) {
      case BedNumber::friction:
        basal.friction_coefficient = mean;
        break;
      case BedNumber::pore_pressure:
        basal.pore_pressure_ratio = mean;
        break;
      case BedNumber::cohesion:
        basal.cohesion_pa = mean;
        break;
      case BedNumber::turbulence:
        basal.turbulent_coefficient_m_s2 = mean;
        break;
    }
  }
  return s;
}

std::pair<double, double> drawn_bed_range(const Scenario& s, const SceneInputs& in,
                                          BedNumber number) {
  std::pair<double, double> out(INFINITY, -INFINITY);
  const auto add = [&](std::pair<double, double> range) {
    out.first = std::min(out.first, range.first);
    out.second = std::max(out.second, range.second);
  };
  if (const auto own = own_number(s.basal, number)) add(drawn_range(*own));
  for (const BasalZone& zone : s.basal.zones)
    if (const auto& own = zone.*field_of(number).zone) add(drawn_range(*own));
  for (const BedLayerInput& layer : in.bed_layers)
    if (layer.number == number && !std::isnan(layer.mean)) {
      const auto [low, high] = drawn_range(factor_of(s, number));
      add({low * layer.least, high * layer.most});
    }
  return out;
}

}  // namespace sturz
