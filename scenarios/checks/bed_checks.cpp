// SPDX-License-Identifier: Apache-2.0
// Rasters of the bed and its SamosAT form: what they may not be together with.
#include "scenarios/checks/combination_checks.hpp"
#include "scenarios/schema/raster_fields.hpp"
#include "scenarios/schema/value_text.hpp"

#include <string>

namespace sturz {
namespace {

using Problems = std::vector<Problem>;

void add(Problems& problems, const std::string& path, const std::string& why) {
  problems.push_back({path, path + why});
}

void check_rasters(const Scenario& s, Problems& problems) {
  for (const RasterField& field : raster_fields)
    if (raster_of(s.basal, field).factor && !names_raster(s.basal, field))
      add(problems, raster_path(field) + "_factor",
          " (there is no " + raster_path(field) +
              " that it could multiply). Name the raster or "
              "remove it.");
  if (!s.basal.rasters.crs.empty() && !names_any_raster(s.basal))
    add(problems, "basal.rasters.crs", " (there is no raster that it is for). Remove it.");
  const std::string pore = "basal.rasters.pore_pressure_ratio",
                    xi = "basal.rasters.turbulent_coefficient_m_s2";
  if (s.mixture && !s.basal.rasters.pore_pressure_ratio.path.empty())
    add(problems, pore,
        " (mixture is there too, which computes the pore pressure). Remove it; "
        "mixture.initial_pressure_ratio sets the pressure at the start.");
  if (s.formulation == Formulation::full_stress &&
      !s.basal.rasters.turbulent_coefficient_m_s2.path.empty())
    add(problems, xi,
        " (formulation is full_stress; only depth_averaged knows it). Remove it or set "
        "formulation: depth_averaged.");
}

/// SamosAT brings its own drag, and water of a mixture has its own pressure.
void check_samosat(const Scenario& s, Problems& problems) {
  if (!s.basal.samosat) return;
  const std::string path = "basal.samosat";
  const auto beside = [&](bool given, const std::string& other) {
    if (given)
      add(problems, path,
          " (" + other +
              " is there too; its drag is that of a logarithmic "
              "profile). Keep one of them.");
  };
  const BasalSpec& b = s.basal;
  beside(b.turbulent_coefficient_m_s2.has_value(), "basal.turbulent_coefficient_m_s2");
  beside(!b.rasters.turbulent_coefficient_m_s2.path.empty(),
         "basal.rasters.turbulent_coefficient_m_s2");
  beside(b.viscosity_pa_s.has_value(), "basal.viscosity_pa_s");
  if (const auto zone = zone_with_turbulence(b))
    beside(true, "basal.zones[" + std::to_string(*zone) + "].turbulent_coefficient_m_s2");
  if (s.mixture)
    add(problems, path,
        " (mixture is there too; SamosAT knows one mass with its water only). Keep one of them.");
  if (s.formulation == Formulation::full_stress)
    add(problems, path,
        " (formulation is full_stress; only depth_averaged knows it). Remove it or set "
        "formulation: depth_averaged.");
}

}  // namespace

void check_bed(const Scenario& s, Problems& problems) {
  check_rasters(s, problems);
  check_samosat(s, problems);
}

}  // namespace sturz
