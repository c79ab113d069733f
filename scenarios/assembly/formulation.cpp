// SPDX-License-Identifier: Apache-2.0
#include "scenarios/assembly/formulation.hpp"

#include "engine/core/constants.hpp"
#include "engine/core/error.hpp"
#include "engine/simulation/reference_speed.hpp"
#include "scenarios/assembly/liquid/liquid_plan.hpp"
#include "scenarios/schema/number_text.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace sturz {
namespace {

/// Thickness that half of the volume exceeds [m].
double volume_median(std::vector<double> thickness, double sum) {
  std::sort(thickness.begin(), thickness.end());
  double below = 0;
  for (double h : thickness)
    if ((below += h) >= 0.5 * sum) return h;
  return 0;
}

/// What a scene names that only columns know; empty when nothing.
std::string column_key(const Scenario& s) {
  if (s.mixture) return "mixture";
  if (s.basal.turbulent_coefficient_m_s2) return "basal.turbulent_coefficient_m_s2";
  if (s.basal.viscosity_pa_s) return "basal.viscosity_pa_s";
  if (zone_with_turbulence(s.basal)) return "basal.zones";
  if (!s.basal.rasters.turbulent_coefficient_m_s2.path.empty())
    return "basal.rasters.turbulent_coefficient_m_s2";
  if (s.basal.samosat) return "basal.samosat";
  if (s.grains && asks_for_internal_friction(s.grains->earth_pressure))
    return "grains.earth_pressure";
  if (s.erosion) return "erosion";
  if (!s.inflow.empty()) return "inflow";
  if (s.release.start_time_s) return "release.start_time_s";
  if (!s.release.start_time_attribute.empty()) return "release.start_time_attribute";
  return "";
}

/// Walls and periods hold the mass together: the area law of open slopes says nothing there.
bool is_confined(const Scenario& s) {
  return !s.domain.walls.empty() || !s.domain.periodic.empty();
}

std::string layers_text(const FormulationChoice& c) {
  std::string text = short_number(c.release_layers) + " layers at release";
  if (std::isfinite(c.deposit_layers))
    text += ", about " + short_number(c.deposit_layers) + " in the deposit";
  return text;
}

void count_layers(const Scenario& s, const Raster<double>& thickness, FormulationChoice& c) {
  std::vector<double> covered;
  double sum = 0;
  for (double h : thickness.values)
    if (h > 0) covered.push_back(h), sum += h;
  const double dx = s.numerics.spacing_m;
  c.release_layers = volume_median(std::move(covered), sum) / dx;
  const double volume = sum * thickness.grid.cell_m * thickness.grid.cell_m;
  c.deposit_layers = is_confined(s) ? std::numeric_limits<double>::infinity()
                                    : std::cbrt(volume) / area_over_volume23 / dx;
  c.layers = std::min(c.release_layers, c.deposit_layers);
}

/// What lies on the ground, and some points of it.
struct Mass {
  double volume = 0, area = 0;  ///< [m3], [m2]
  Release starts;               ///< without masses
};

Mass mass_on(const Raster<double>& thickness, const Terrain& ground) {
  constexpr std::size_t enough = 400;
  const Grid& g = thickness.grid;
  std::vector<std::size_t> cells;
  Mass mass;
  for (std::size_t i = 0; i < thickness.values.size(); ++i) {
    const double h = thickness.values[i];
    if (!(h > 0)) continue;
    cells.push_back(i);
    mass.volume += h * g.cell_m * g.cell_m;
    mass.starts.max_thickness_m = std::max(mass.starts.max_thickness_m, h);
  }
  mass.area = static_cast<double>(cells.size()) * g.cell_m * g.cell_m;
  const std::size_t stride = cells.size() / enough + 1;
  for (std::size_t k = 0; k < cells.size(); k += stride) {
    const double x = g.x_center(static_cast<int>(cells[k] % g.n_cols));
    const double y = g.y_center(static_cast<int>(cells[k] / g.n_cols));
    if (!ground.inside(x, y)) continue;
    mass.starts.x.push_back(x);
    mass.starts.y.push_back(y);
    mass.starts.z.push_back(ground.height(x, y));
  }
  return mass;
}

/// Of so many particle updates, at 3 million a second: "40 s", "12 min", "27 h".
std::string time_text(double updates) {
  const double seconds = updates / 3e6;
  if (seconds < 90) return short_number(std::max(0.1, seconds)) + " s";
  if (seconds < 5400) return short_number(seconds / 60) + " min";
  return short_number(seconds / 3600) + " h";
}

}  // namespace

FormulationChoice choose_formulation(const Scenario& s, const Raster<double>& thickness) {
  FormulationChoice c;
  count_layers(s, thickness, c);
  if (s.formulation == Formulation::depth_averaged) {
    c.depth_averaged = true;
    c.reason = "`formulation: depth_averaged`";
  } else if (s.formulation == Formulation::discrete) {
    c.discrete = true;
    c.reason =
        "`formulation: discrete`, every grain by itself; " + layers_text(c) + " of one grain each";
  } else if (s.formulation == Formulation::full_stress || s.fluid) {
    c.reason = s.formulation == Formulation::full_stress
                   ? "`formulation: full_stress`; "
                   : "`formulation: auto`: `fluid` is a liquid in three dimensions; ";
    c.reason += layers_text(c);
    // A release without any mass is refused as such where it is filled.
    const bool unresolved = c.release_layers > 0 && c.release_layers < unresolved_layers;
    require(!unresolved || s.numerics.accept_unresolved,
            std::string(s.fluid ? "fluid: " : "formulation = full_stress ") + "(" +
                short_number(c.release_layers) +
                " layers of particles resolve the release, fewer than 2: the footprint would be "
                "wrong by up to 100 %). Use " +
                (s.fluid ? "" : "formulation: auto, ") + "a numerics.spacing_m below " +
                short_number(s.numerics.spacing_m * c.release_layers / unresolved_layers) +
                " m, or accept it with numerics.accept_unresolved: true.");
  } else if (const std::string key = column_key(s); !key.empty()) {
    c.depth_averaged = true;
    c.reason = "`formulation: auto`: `" + key + "` acts on columns";
  } else if (s.grains && !s.grains->friction && !s.grains->friction_angle_deg) {
    c.depth_averaged = true;
    c.reason = "`formulation: auto`: no internal friction is given, which full_stress needs; " +
               layers_text(c);
  } else {
    c.depth_averaged = c.layers < resolved_layers;
    c.reason = "`formulation: auto`: " + layers_text(c) + (c.depth_averaged ? " (" : " (not ") +
               "fewer than 4)";
  }
  return c;
}

double typical_friction(const Scenario& s) {
  if (is_liquid_alone(s)) return liquid_friction;
  const double dry = s.basal.friction_coefficient.value;
  if (s.fluid)
    return dry *
           std::max(liquefied_share, weight_on_grains(s) * (1 - s.basal.pore_pressure_ratio.value));
  if (!s.mixture) return dry * (1 - s.basal.pore_pressure_ratio.value);
  const MixtureSpec& wet = *s.mixture;
  const double m = s.grains->solid_fraction.value, fluid = wet.fluid_density_kg_m3.value;
  if (has_two_phases(s.mixture)) {
    const double grains = m * (s.grains->density_kg_m3.value - fluid);
    return dry * std::max(liquefied_share, grains / (grains + fluid));
  }
  const bool loose = m < wet.critical_solid_fraction.value;
  if (loose || wet.initial_pressure == InitialPressure::liquefied) return dry * liquefied_share;
  if (wet.initial_pressure_ratio)
    return dry * std::max(liquefied_share, 1 - wet.initial_pressure_ratio->value);
  return dry * (1 - fluid / (m * s.grains->density_kg_m3.value + (1 - m) * fluid));
}

bool has_both_formulations(const Scenario& s) {
  return s.grains && !s.fluid && s.formulation != Formulation::discrete &&
         (s.grains->friction || s.grains->friction_angle_deg) && !s.grains->states &&
         column_key(s).empty();
}

CostEstimate estimate_cost(const Scenario& s, const Raster<double>& thickness,
                           const Terrain& ground, double end_time_s) {
  const Mass mass = mass_on(thickness, ground);
  const double dx = s.numerics.spacing_m, step = s.numerics.courant * smoothing_ratio * dx;
  double friction = typical_friction(s);
  for (const BasalZone& zone : s.basal.zones)
    friction = std::min(
        friction, zone.friction_coefficient.value_or(s.basal.friction_coefficient).value *
                      (1 - zone.pore_pressure_ratio.value_or(s.basal.pore_pressure_ratio).value));
  const auto& v0 = s.release.velocity_m_s;
  const double start = std::sqrt(v0[0] * v0[0] + v0[1] * v0[1] + v0[2] * v0[2]);
  const double speed = reference_speed(ground, mass.starts, friction, start, end_time_s);
  const double wave = std::sqrt(standard_gravity * mass.starts.max_thickness_m);
  const double sound = s.numerics.sound_speed_factor * std::max({speed, wave, start});
  CostEstimate cost;
  cost.full_stress = mass.volume / (dx * dx * dx) * end_time_s * 1.1 * sound / step;
  cost.depth_averaged = mass.area / (dx * dx) * end_time_s * (0.5 * speed + wave) / step;
  return cost;
}

void weigh_cost(const Scenario& s, const Raster<double>& thickness, const Terrain& ground,
                double end_time_s, FormulationChoice& c) {
  const CostEstimate cost = estimate_cost(s, thickness, ground, end_time_s);
  const std::string full = time_text(cost.full_stress), columns = time_text(cost.depth_averaged);
  c.depth_averaged = cost.full_stress > affordable_updates;
  if (c.depth_averaged)
    c.reason = "`formulation: auto`: " + layers_text(c) +
               ", which full_stress would resolve in about " + full + " a member, columns in " +
               columns + "; more than 10 min have to be asked for (formulation: full_stress)";
  else
    c.reason += "; about " + full + " a member, columns " + columns;
}

}  // namespace sturz
