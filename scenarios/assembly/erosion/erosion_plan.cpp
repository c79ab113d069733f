// SPDX-License-Identifier: Apache-2.0
#include "scenarios/assembly/erosion/erosion_plan.hpp"

#include "engine/effects/columns/wet_bed.hpp"
#include "scenarios/schema/number_text.hpp"

#include <cmath>
#include <limits>

namespace sturz {
namespace {

double or_else(const std::optional<Uncertain>& value, double otherwise) {
  return value ? value->value : otherwise;
}

constexpr double usual_rate = 0.025, usual_depth_per_kpa = 0.1, usual_critical_kpa = 1;

Entrainment law_of(const ErosionSpec& spec) {
  Entrainment law;
  switch (spec.law) {
    case ErosionLaw::exponential:
      law.law = Entrainment::Law::exponential;
      break;
    case ErosionLaw::shear_stress:
      law.law = Entrainment::Law::shear_stress;
      break;
    case ErosionLaw::momentum_jump:
      law.law = Entrainment::Law::momentum_jump;
      break;
  }
  law.growth_rate = or_else(spec.growth_rate_per_m, 0);
  law.rate = or_else(spec.rate_m_s, usual_rate);
  law.depth_per_stress = 1e-3 * or_else(spec.depth_per_stress_m_per_kpa, usual_depth_per_kpa);
  law.critical_stress = 1e3 * or_else(spec.critical_stress_kpa, usual_critical_kpa);
  law.bed_friction = or_else(spec.bed_friction_coefficient, 0);
  law.bed_pressure_ratio = or_else(spec.bed_pore_pressure_ratio, 1);
  return law;
}

/// The pattern on the ground of columns, which may have coarser cells: means over them, with
/// nothing beyond the pattern.
std::shared_ptr<const Raster<double>> on_ground(const std::shared_ptr<const Raster<double>>& fine,
                                                const Grid& whole, const Grid& ground) {
  const int factor = static_cast<int>(std::lround(ground.cell_m / fine->grid.cell_m));
  if (factor <= 1) return fine;
  const Window from = window_of(fine->grid, whole);
  const Window to = window_between(from.row0 / factor, (from.end_row() - 1) / factor + 1,
                                   from.col0 / factor, (from.end_col() - 1) / factor + 1, ground);
  Raster<double> out(grid_of(to, ground), 0.0);
  for (int r = 0; r < from.n_rows; ++r)
    for (int c = 0; c < from.n_cols; ++c) {
      const int row = (from.row0 + r) / factor, col = (from.col0 + c) / factor;
      if (to.contains(row, col))
        out.at(row - to.row0, col - to.col0) += fine->at(r, c) / (factor * factor);
    }
  return std::make_shared<const Raster<double>>(std::move(out));
}

std::string supply_text(const ErosionSpec& spec) {
  const std::string where =
      spec.polygon.empty() ? std::string("everywhere") : "inside " + spec.polygon;
  if (spec.supply == ErosionSupply::unlimited) return "unlimited supply " + where;
  if (!spec.depth_raster.empty()) return "supply from " + spec.depth_raster;
  return "supply " + short_number(spec.depth_m->value) + " m " + where;
}

std::string law_text(const ErosionSpec& spec) {
  const Entrainment law = law_of(spec);
  switch (spec.law) {
    case ErosionLaw::exponential:
      return "volume grows by " + short_number(law.growth_rate) + " per metre";
    case ErosionLaw::shear_stress:
      return short_number(law.rate) + " m/s down to " + short_number(1e3 * law.depth_per_stress) +
             " m per kPa above " + short_number(1e-3 * law.critical_stress) + " kPa";
    case ErosionLaw::momentum_jump:
      return "bed friction " + short_number(law.bed_friction) + ", pore pressure ratio " +
             short_number(law.bed_pressure_ratio);
  }
  return {};
}

}  // namespace

ErosionSettings plan_erosion(const Scenario& s, const SceneInputs& in, const ErosionPlace& place) {
  const ErosionSpec& spec = *s.erosion;
  ErosionSettings out;
  out.law = law_of(spec);
  out.bed_density = or_else(spec.bed_density_kg_m3, place.flow_density);
  if (place.mixture) {
    const MixtureLaw law = place.mixture->law;
    SaturatedBed bed;
    bed.solid_fraction = or_else(spec.bed_solid_fraction, law.critical_fraction);
    bed.pressure_ratio = or_else(spec.bed_pore_pressure_ratio, -1);
    bed.drained = place.mixture->profile.drained_bed;
    out.bed_density = law.density(bed.solid_fraction);
    out.received = [law, bed](MovingSet& p, std::span<const double> mass, double share) {
      take_up(p, law, bed, mass, share);
    };
  }
  out.bed = place.bed;
  out.zones = place.zones;
  out.rasters = place.rasters;
  out.cells = place.ground;
  if (in.bed_supply) {
    out.source.pattern = on_ground(in.bed_supply, in.terrain_grid(), place.ground);
    out.source.at = window_of(out.source.pattern->grid, place.ground);
  }
  if (spec.supply == ErosionSupply::unlimited)
    out.source.depth_m = std::numeric_limits<double>::infinity();
  else if (!spec.depth_raster.empty())
    out.source.depth_m = or_else(spec.depth_factor, 1);
  else
    out.source.depth_m = spec.depth_m->value;
  return out;
}

std::string erosion_text(const ErosionSpec& spec) {
  std::string text = "`erosion.law: " + std::string(to_string(spec.law)) + "`: " + law_text(spec) +
                     "; " + supply_text(spec);
  if (spec.bed_density_kg_m3)
    text += "; bed of " + short_number(spec.bed_density_kg_m3->value) + " kg/m3";
  return text;
}

}  // namespace sturz
