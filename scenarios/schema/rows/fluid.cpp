// SPDX-License-Identifier: Apache-2.0
// Keys of a liquid in three dimensions and of what ties it to grains: fluid, coupling.
#include "scenarios/schema/rows/rows.hpp"

namespace sturz::schema_rows {
namespace {

constexpr auto fluid = blocks::at<&Scenario::fluid>;
constexpr auto pool = blocks::at<&Scenario::fluid, &FluidSpec::pool>;
constexpr auto pool_box = blocks::at<&Scenario::fluid, &FluidSpec::pool, &PoolSpec::box>;
constexpr auto coupling = blocks::at<&Scenario::coupling>;

constexpr double map_limit = 1e8;  // metres; no projected coordinate is larger

void add_liquid(std::vector<KeyInfo>& keys) {
  using enum ValueKind;
  const auto add = [&keys](auto member, const Row& row) {
    keys.push_back(key(fluid, member, row));
  };
  const auto add_positive = [&keys](auto member, const Row& row) {
    keys.push_back(above_min(key(fluid, member, row)));
  };
  add(&FluidSpec::density_kg_m3, {"fluid.density_kg_m3", uncertain, "kg m-3", 500, 2500,
                                  "Density of the liquid itself: water with its fines, or mud."});
  add_positive(&FluidSpec::viscosity_pa_s,
               {"fluid.viscosity_pa_s", uncertain, "Pa s", 0, 1e6,
                "Viscosity; clear water has 0.001. By itself Newton's law, with yield_stress_pa "
                "Bingham's."});
  add(&FluidSpec::yield_stress_pa,
      {"fluid.yield_stress_pa", uncertain, "Pa", 0, 1e6,
       "Shear stress that the liquid bears at rest, with viscosity_pa_s or consistency_pa_sn."});
  add_positive(&FluidSpec::consistency_pa_sn,
               {"fluid.consistency_pa_sn", uncertain, "Pa s^n", 0, 1e6,
                "K of Herschel and Bulkley's law, shear stress = "
                "yield_stress_pa + K rate^index, "
                "in the place of viscosity_pa_s."});
  add(&FluidSpec::index, {"fluid.index", uncertain, "1", 0.1, 1,
                          "n of Herschel and Bulkley's law; below 1 the liquid thins with shear."});
  add(&FluidSpec::saturation,
      {"fluid.saturation", uncertain, "1", 0, 1,
       "Share of the release's pores that the liquid fills at the start, from the bed up to this "
       "share of the height; 0.05 at least, but with `fluid.pool`. More liquid than pores is a "
       "lower grains.solid_fraction."});
  keys.push_back(choice_key(
      fluid, &FluidSpec::bed, "fluid.bed",
      "no_slip: the bed holds the liquid, whose shear beside it is resolved; film: drag of a flow "
      "too thin for that, by its depth; slip: no drag; auto: no_slip where at least four layers "
      "resolve release and expected deposit, else film."));
  add(&FluidSpec::artificial_viscosity,
      {"fluid.artificial_viscosity", number, "1", 0, 1,
       "Strength of the artificial viscosity of the liquid, which stops ringing; the rest of "
       "`numerics` holds for grains and liquid alike."});
}

void add_pool(std::vector<KeyInfo>& keys) {
  using enum ValueKind;
  keys.push_back(key(pool, &PoolSpec::surface_m,
                     {"fluid.pool.surface_m", uncertain, "m", -1e5, 1e5,
                      "Elevation of the level surface of standing water, which fills ground and "
                      "pores below it at rest."}));
  keys.push_back(text_key(pool, &PoolSpec::polygon, "fluid.pool.polygon", path,
                          "Polygon layer that outlines it, where the ground is low elsewhere, too; "
                          "without outline it is wherever walls and ground let it."));
  keys.push_back(text_key(pool, &PoolSpec::layer, "fluid.pool.layer", text,
                          "Layer inside fluid.pool.polygon; the first when absent."));
  keys.push_back(text_key(pool, &PoolSpec::crs, "fluid.pool.crs", text,
                          "Coordinate system of that file where it has none."));
  keys.push_back(with_size(key(pool_box, &MapBox::x_m,
                               {"fluid.pool.box.x_m", number_list, "m", -map_limit, map_limit,
                                "West and east edge of a rectangle in the place of the polygon."}),
                           2));
  keys.push_back(with_size(key(pool_box, &MapBox::y_m,
                               {"fluid.pool.box.y_m", number_list, "m", -map_limit, map_limit,
                                "South and north edge of it."}),
                           2));
}

}  // namespace

void add_fluid_keys(std::vector<KeyInfo>& keys) {
  using enum ValueKind;
  add_liquid(keys);
  add_pool(keys);
  keys.push_back(choice_key(
      coupling, &CouplingSpec::scheme, "coupling.scheme",
      "physical: drag, and buoyancy by the liquid's pressure; paper: drag alone, as Gao and others "
      "computed, which with basal.pore_pressure_ratio counts the pore pressure twice."));
  keys.push_back(above_min(key(coupling, &CouplingSpec::drag_diameter_m,
                               {"coupling.drag_diameter_m", uncertain, "m", 0, 100,
                                "Grain diameter of the drag, that of the fines where they set the "
                                "permeability; grains.diameter_m when absent."})));
  keys.push_back(above_min(key(coupling, &CouplingSpec::drag_multiplier,
                               {"coupling.drag_multiplier", uncertain, "1", 0, 1e6,
                                "Factor on the drag. 1 is physics, and any other is warned of in "
                                "every result."})));
  keys.push_back(key(coupling, &CouplingSpec::critical_solid_fraction,
                     {"coupling.critical_solid_fraction", uncertain, "1", 0.3, 0.8,
                      "Solid fraction that slow shear leaves as it is. Given, grains looser than "
                      "it tighten where they are sheared and press on the liquid, and denser ones "
                      "loosen and draw it in; without it a packing only changes under load."}));
  keys.push_back(key(coupling, &CouplingSpec::dilatancy_slope,
                     {"coupling.dilatancy_slope", uncertain, "1", 0.01, 20,
                      "k of tan psi = k (solid fraction - that of steady shear): 4 for glass beads "
                      "(Pailha and Pouliquen), 1 in D-Claw."}));
}

void add_fluid_blocks(std::vector<BlockInfo>& blocks) {
  blocks.push_back(optional_block(
      "fluid",
      "A liquid with particles of its own, alone or in the pores of `grains`; full_stress.",
      fluid));
  blocks.push_back(optional_block(
      "fluid.pool", "Standing water, in which or into which a mass collapses.", pool));
  blocks.push_back(optional_block("fluid.pool.box", "A rectangular outline of it.", pool_box));
  blocks.push_back(optional_block(
      "coupling", "What grains and liquid do to each other; without it the defaults.", coupling));
}

}  // namespace sturz::schema_rows
