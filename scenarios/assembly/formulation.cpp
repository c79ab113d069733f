// SPDX-License-Identifier: Apache-2.0
#include "scenarios/assembly/formulation.hpp"

#include "engine/core/error.hpp"
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
  if (s.basal.turbulent_coefficient_m_s2) return "basal.turbulent_coefficient_m_s2";
  if (s.basal.viscosity_pa_s) return "basal.viscosity_pa_s";
  if (s.grains && s.grains->earth_pressure != LateralPressure::isotropic)
    return "grains.earth_pressure";
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

}  // namespace

FormulationChoice choose_formulation(const Scenario& s, const Raster<double>& thickness) {
  FormulationChoice c;
  count_layers(s, thickness, c);
  if (s.formulation == Formulation::depth_averaged) {
    c.depth_averaged = true;
    c.reason = "`formulation: depth_averaged`";
  } else if (s.formulation == Formulation::full_stress) {
    c.reason = "`formulation: full_stress`; " + layers_text(c);
    // A release without any mass is refused as such where it is filled.
    const bool unresolved = c.release_layers > 0 && c.release_layers < unresolved_layers;
    require(!unresolved || s.numerics.accept_unresolved,
            "formulation = full_stress (" + short_number(c.release_layers) +
                " layers of particles resolve the release, fewer than 2: the footprint would be "
                "wrong by up to 100 %). Use formulation: auto, a numerics.spacing_m below " +
                short_number(s.numerics.spacing_m * c.release_layers / unresolved_layers) +
                " m, or accept it with numerics.accept_unresolved: true.");
  } else if (const std::string key = column_key(s); !key.empty()) {
    c.depth_averaged = true;
    c.reason = "`formulation: auto`: `" + key + "` acts on columns";
  } else {
    c.depth_averaged = c.layers < resolved_layers;
    c.reason = "`formulation: auto`: " + layers_text(c) + (c.depth_averaged ? " (" : " (not ") +
               "fewer than 4)";
  }
  return c;
}

}  // namespace sturz
