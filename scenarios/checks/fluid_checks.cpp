// SPDX-License-Identifier: Apache-2.0
// What a liquid in three dimensions needs, and what it may not be together with.
#include "scenarios/checks/combination_checks.hpp"
#include "scenarios/checks/distribution_check.hpp"
#include "scenarios/schema/number_text.hpp"
#include "scenarios/schema/raster_fields.hpp"
#include "scenarios/schema/value_text.hpp"

#include <cmath>
#include <string>
#include <utility>

namespace sturz {
namespace {

using Problems = std::vector<Problem>;

class Check {
 public:
  Check(const Scenario& s, Problems& problems) : s_(s), fluid_(*s.fluid), problems_(problems) {}

  void all() {
    law();
    columns();
    grains();
    bed_of_grains();
    if (fluid_.pool) pool(*fluid_.pool);
    if (s_.mixture)
      add("mixture",
          "mixture (fluid is there too: water in columns, and a liquid in three dimensions). Keep "
          "one of them.");
    if (!s_.material.empty())
      add("material", shown("material") +
                          " (fluid is there too; a material's friction is that of the whole flow "
                          "with its water, in columns). Keep one of them.");
  }

 private:
  void add(const std::string& path, std::string text) {
    problems_.push_back({path, std::move(text)});
  }
  std::string shown(const std::string& path) const {
    return path + " = " + value_text(find_key(path)->get(s_));
  }

  /// The law follows from what is given.
  void law() {
    const bool viscosity = fluid_.viscosity_pa_s.has_value();
    const bool consistency = fluid_.consistency_pa_sn.has_value();
    if (!viscosity && !consistency)
      add("fluid.viscosity_pa_s",
          "fluid.viscosity_pa_s (missing: nothing says how the liquid resists shear). Give it, "
          "0.001 for clear water, and for mud yield_stress_pa beside it; or consistency_pa_sn and "
          "index.");
    if (viscosity && consistency)
      add("fluid.consistency_pa_sn", shown("fluid.consistency_pa_sn") +
                                         " (fluid.viscosity_pa_s is there too). Keep one of them.");
    if (consistency && !fluid_.index)
      add("fluid.index",
          "fluid.index (missing; fluid.consistency_pa_sn needs it). Give it, below 1 for a liquid "
          "that thins with shear; with 1 write viscosity_pa_s instead.");
    if (!consistency && fluid_.index)
      add("fluid.index",
          shown("fluid.index") +
              " (fluid.consistency_pa_sn is missing). Give it in the place of viscosity_pa_s, or "
              "remove the index.");
  }

  /// What only columns know. A formulation that is asked for by name has its own words.
  void columns() {
    if (s_.formulation == Formulation::depth_averaged) {
      const std::string cure =
          s_.grains ? "or use mixture with phases: two, which is grains and liquid as columns."
                    : "or describe the mud as columns do: grains with its bulk density, "
                      "basal.viscosity_pa_s and basal.yield_stress_pa.";
      add("fluid",
          "fluid (formulation is depth_averaged; only full_stress knows a liquid with particles of "
          "its own). Set formulation: full_stress, " +
              cure);
    }
    if (s_.formulation != Formulation::automatic) return;
    const auto refuse = [&](bool given, const std::string& path) {
      if (given)
        add(path, path +
                      " (fluid is there too, which only full_stress computes; this is for "
                      "depth_averaged). Remove one of the two.");
    };
    const BasalSpec& b = s_.basal;
    refuse(b.turbulent_coefficient_m_s2 && s_.material.empty(), "basal.turbulent_coefficient_m_s2");
    refuse(b.viscosity_pa_s.has_value(), "basal.viscosity_pa_s");
    refuse(b.yield_stress_pa.has_value(), "basal.yield_stress_pa");
    refuse(b.samosat.has_value(), "basal.samosat");
    refuse(zone_with_turbulence(b).has_value(), "basal.zones");
    refuse(!b.rasters.turbulent_coefficient_m_s2.path.empty(),
           "basal.rasters.turbulent_coefficient_m_s2");
    refuse(s_.grains && asks_for_internal_friction(s_.grains->earth_pressure),
           "grains.earth_pressure");
    refuse(s_.erosion.has_value(), "erosion");
    refuse(!s_.inflow.empty(), "inflow");
    refuse(s_.release.start_time_s.has_value(), "release.start_time_s");
    refuse(!s_.release.start_time_attribute.empty(), "release.start_time_attribute");
  }

  void grains() {
    if (!s_.grains) {
      if (fluid_.saturation != Uncertain(1))
        add("fluid.saturation", shown("fluid.saturation") +
                                    " (there are no grains whose pores it could fill). Remove it, "
                                    "or add grains.");
      return;
    }
    const double least = support(fluid_.saturation).first;
    if (!fluid_.pool && least < least_saturation && least >= 0)
      add("fluid.saturation", shown("fluid.saturation") + " (must be " +
                                  number_text(least_saturation) +
                                  " at least: only beside fluid.pool may the release be dry). "
                                  "Raise it, remove `fluid`, or give the pool.");
    const double heaviest = support(fluid_.density_kg_m3).second;
    const double lightest = support(s_.grains->density_kg_m3).first;
    if (heaviest >= lightest)
      add("fluid.density_kg_m3",
          "fluid.density_kg_m3 = " + number_text(heaviest) +
              " (must be below grains.density_kg_m3 = " + number_text(lightest) +
              ": grains that float have no effective stress).");
    if (s_.coupling && s_.coupling->critical_solid_fraction && s_.grains->states)
      add("coupling.critical_solid_fraction",
          shown("coupling.critical_solid_fraction") +
              " (grains.states is there too, which says how a packing bears its load). Keep one "
              "of them.");
    if (s_.coupling && !s_.coupling->critical_solid_fraction &&
        s_.coupling->dilatancy_slope != CouplingSpec{}.dilatancy_slope)
      add("coupling.dilatancy_slope",
          shown("coupling.dilatancy_slope") +
              " (no effect without coupling.critical_solid_fraction). Give that, or remove it.");
    if (s_.coupling && s_.coupling->critical_solid_fraction &&
        s_.coupling->scheme == CouplingScheme::paper)
      add("coupling.critical_solid_fraction",
          shown("coupling.critical_solid_fraction") +
              " (coupling.scheme: paper has no pressure that acts on grains). Keep one of them.");
    const bool physical = !s_.coupling || s_.coupling->scheme == CouplingScheme::physical;
    if (physical && s_.grains->pore_pressure_inside)
      add("grains.pore_pressure_inside",
          "grains.pore_pressure_inside = true (fluid is there too, whose pressure carries the "
          "grains inside). Remove it.");
  }

  /// What only grains feel of bed and walls.
  void bed_of_grains() {
    if (s_.grains) return;
    for (const RasterField& field : raster_fields)
      if (names_raster(s_.basal, field))
        add(raster_path(field), raster_path(field) +
                                    " (there are no grains, and the bed of a liquid alone is "
                                    "fluid.bed). Remove it, or add grains.");
    for (std::size_t i = 0; i < s_.domain.walls.size(); ++i)
      if (s_.domain.walls[i].friction_coefficient != 0)
        add("domain.walls", "domain.walls[" + std::to_string(i) + "].friction_coefficient = " +
                                number_text(s_.domain.walls[i].friction_coefficient) +
                                " (there are no grains that it could act on). Remove it; `liquid: "
                                "sticks` is a wall that drags a liquid.");
  }

  void pool(const PoolSpec& pool) {
    if (!pool.surface_m)
      add("fluid.pool.surface_m",
          "fluid.pool.surface_m (missing: how high does the water stand?). Give the elevation of "
          "its surface.");
    if (!pool.polygon.empty() && pool.box)
      add("fluid.pool.box", "fluid.pool.box (fluid.pool.polygon is there too). Keep one of them.");
    const auto of_polygon = [&](const std::string& value, const std::string& path) {
      if (!value.empty() && pool.polygon.empty())
        add(path, path + " (fluid.pool.polygon is missing). Remove it or name the polygon file.");
    };
    of_polygon(pool.layer, "fluid.pool.layer");
    of_polygon(pool.crs, "fluid.pool.crs");
    if (pool.box)
      for (const auto& [edges, path] : {std::pair{pool.box->x_m, "fluid.pool.box.x_m"},
                                        std::pair{pool.box->y_m, "fluid.pool.box.y_m"}})
        if (!(edges[0] < edges[1]))
          add(path, std::string(path) +
                        " (the second edge must be above the first). Give [smaller, larger].");
    for (std::size_t i = 0; i < s_.domain.walls.size(); ++i) {
      const auto& n = s_.domain.walls[i].normal;
      if (std::abs(n[2]) > 1e-6 * std::hypot(n[0], n[1]))
        add("domain.walls", "domain.walls[" + std::to_string(i) +
                                "].normal (leans, and fluid.pool is cut along upright walls "
                                "only). Give it no vertical part, or remove the pool.");
    }
  }

  static constexpr double least_saturation = 0.05;
  const Scenario& s_;
  const FluidSpec& fluid_;
  Problems& problems_;
};

}  // namespace

void check_fluid(const Scenario& s, Problems& problems) {
  if (s.fluid) Check(s, problems).all();
  for (std::size_t i = 0; i < s.domain.walls.size() && !s.fluid; ++i)
    if (s.domain.walls[i].liquid != WallSpec{}.liquid)
      problems.push_back({"domain.walls", "domain.walls[" + std::to_string(i) +
                                              "].liquid = sticks (there is no `fluid`). Remove "
                                              "it."});
  if (!s.coupling || (s.fluid && s.grains)) return;
  const std::string missing = s.fluid ? "grains" : s.grains ? "fluid" : "grains and fluid";
  problems.push_back({"coupling", "coupling (" + missing +
                                      " missing: it is for grains in a liquid). Add " + missing +
                                      " or remove it."});
}

}  // namespace sturz
