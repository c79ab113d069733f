// SPDX-License-Identifier: Apache-2.0
// Keys that say what moves and on what: grains, basal, formulation.
#include "engine/effects/fields.hpp"
#include "scenarios/materials/materials.hpp"
#include "scenarios/schema/rows/rows.hpp"

namespace sturz::schema_rows {
namespace {

constexpr auto scene = blocks::scene;
constexpr auto grains = blocks::at<&Scenario::grains>;
constexpr auto friction = blocks::at<&Scenario::grains, &GrainsSpec::friction>;
constexpr auto states = blocks::at<&Scenario::grains, &GrainsSpec::states>;
constexpr auto dilute =
    blocks::at<&Scenario::grains, &GrainsSpec::states, &GrainStatesSpec::dilute>;
constexpr auto ultradilute =
    blocks::at<&Scenario::grains, &GrainsSpec::states, &GrainStatesSpec::ultradilute>;
constexpr auto mixture = blocks::at<&Scenario::mixture>;
constexpr auto basal = blocks::at<&Scenario::basal>;

void add_grains(std::vector<KeyInfo>& keys) {
  using enum ValueKind;
  keys.push_back(key(grains, &GrainsSpec::density_kg_m3,
                     {"grains.density_kg_m3", uncertain, "kg m-3", 200, 10000,
                      "Density of the grain material itself, without pores."}));
  keys.push_back(above_min(key(
      grains, &GrainsSpec::diameter_m,
      {"grains.diameter_m", uncertain, "m", 0, 100, "Grain diameter in the inertial number."})));
  keys.push_back(key(grains, &GrainsSpec::solid_fraction,
                     {"grains.solid_fraction", uncertain, "1", 0.05, 0.85,
                      "Share of the bulk volume that is grain at the start."}));
  keys.push_back(key(friction, &FrictionLaw::static_coefficient,
                     {"grains.friction.static", uncertain, "1", 0, 2,
                      "Internal friction coefficient of slow flow in mu(I)."}));
  keys.push_back(key(friction, &FrictionLaw::dynamic_coefficient,
                     {"grains.friction.dynamic", uncertain, "1", 0, 3,
                      "Internal friction coefficient of very fast flow in mu(I)."}));
  keys.push_back(key(friction, &FrictionLaw::inertial_number_scale,
                     {"grains.friction.inertial_number_scale", uncertain, "1", 1e-4, 10,
                      "Inertial number at which mu(I) is half way from static to dynamic."}));
  keys.push_back(key(grains, &GrainsSpec::friction_angle_deg,
                     {"grains.friction_angle_deg", uncertain, "degree", 0, 60,
                      "Internal friction angle without rate dependence, instead of "
                      "grains.friction."}));
  keys.push_back(
      key(grains, &GrainsSpec::cohesion_pa,
          {"grains.cohesion_pa", uncertain, "Pa", 0, no_limit, "Cohesion of the material."}));
  keys.push_back(key(
      grains, &GrainsSpec::poisson_ratio,
      {"grains.poisson_ratio", uncertain, "1", 0, 0.49, "Poisson's ratio of the elastic part."}));
  keys.push_back(choice_key(grains, &GrainsSpec::earth_pressure, "grains.earth_pressure",
                            "Lateral earth pressure of depth_averaged flow; auto: active where the "
                            "release is a pile, isotropic where it is a sheet."));
  keys.push_back(
      choice_key(grains, &GrainsSpec::friction_cone, "grains.friction_cone",
                 "Where the internal friction of full_stress holds: in shear along a "
                 "plane (33 degrees act as 40.5 in plane strain), or in plane strain (33 "
                 "degrees act as 28.6 along a plane)."));
  keys.push_back(key(grains, &GrainsSpec::pore_pressure_inside,
                     {"grains.pore_pressure_inside", flag, "", -no_limit, no_limit,
                      "Let basal.pore_pressure_ratio weaken the grains of full_stress inside too, "
                      "not their bed alone."}));
}

void add_states(std::vector<KeyInfo>& keys) {
  using enum ValueKind;
  keys.push_back(choice_key(
      states, &GrainStatesSpec::stress_mode, "grains.states.stress_mode",
      "unified: one continuous law from dense to dilute; paper_switch: the paper's switch between "
      "laws, with relaxation."));
  keys.back().renamed_choices = {{"seed", "paper_switch"}};
  keys.push_back(key(states, &GrainStatesSpec::max_fraction,
                     {"grains.states.max_fraction", uncertain, "1", 0.55, 0.95,
                      "Densest packing of the grains; by default solid_fraction + 0.08, at least "
                      "0.64."}));
  keys.push_back(key(states, &GrainStatesSpec::frictional_pressure_pa,
                     {"grains.states.frictional_pressure_pa", uncertain, "Pa", 0, 1e6,
                      "Scale of the pressure between fractions 0.5 and max_fraction."}));
  keys.push_back(above_min(key(dilute, &DiluteSpec::restitution,
                               {"grains.states.dilute.restitution", uncertain, "1", 0, 0.999,
                                "Share of the speed that two colliding grains keep. The theory is "
                                "made for 0.7 and more."})));
  keys.push_back(choice_key(ultradilute, &UltradiluteSpec::contacts,
                            "grains.states.ultradilute.contacts",
                            "What isolated particles do when they meet."));
  keys.push_back(above_min(key(ultradilute, &UltradiluteSpec::restitution,
                               {"grains.states.ultradilute.restitution", uncertain, "1", 0, 0.999,
                                "Share of the speed that two isolated particles keep."})));
  keys.push_back(key(ultradilute, &UltradiluteSpec::friction_coefficient,
                     {"grains.states.ultradilute.friction_coefficient", uncertain, "1", 0, 2,
                      "Friction between two isolated particles."}));
  keys.push_back(
      above_min(key(ultradilute, &UltradiluteSpec::youngs_modulus_pa,
                    {"grains.states.ultradilute.youngs_modulus_pa", number, "Pa", 0, 1e13,
                     "Stiffness of the grains; softened to what the speeds of the "
                     "scene need."})));
}

void add_mixture_keys(std::vector<KeyInfo>& keys) {
  using enum ValueKind;
  const auto add = [&keys](auto member, const Row& row) {
    keys.push_back(key(mixture, member, row));
  };
  const auto add_positive = [&keys](auto member, const Row& row) {
    keys.push_back(above_min(key(mixture, member, row)));
  };
  add(&MixtureSpec::fluid_density_kg_m3, {"mixture.fluid_density_kg_m3", uncertain, "kg m-3", 800,
                                          2200, "Density of the pore fluid: water with fines."});
  add_positive(&MixtureSpec::fluid_viscosity_pa_s,
               {"mixture.fluid_viscosity_pa_s", uncertain, "Pa s", 0, 100,
                "Viscosity of the pore fluid; clear water has 0.001."});
  keys.push_back(
      choice_key(mixture, &MixtureSpec::initial_pressure, "mixture.initial_pressure",
                 "Pore pressure at the start: that of still water, or all of the weight."));
  add(&MixtureSpec::initial_pressure_ratio,
      {"mixture.initial_pressure_ratio", uncertain, "1", 0, 1,
       "Pore pressure at the start over total normal stress, instead of a word."});
  add(&MixtureSpec::critical_solid_fraction,
      {"mixture.critical_solid_fraction", uncertain, "1", 0.3, 0.8,
       "Solid fraction that slow shear leaves as it is: looser than it a mass contracts and "
       "liquefies, denser it dilates and sticks."});
  add_positive(&MixtureSpec::permeability_m2,
               {"mixture.permeability_m2", uncertain, "m2", 0, 1e-3,
                "Permeability k_r at permeability_fraction; k = k_r exp((m_r - m)/0.04)."});
  add(&MixtureSpec::permeability_fraction,
      {"mixture.permeability_fraction", uncertain, "1", 0.3, 0.8,
       "Solid fraction m_r at which permeability_m2 holds."});
  add_positive(
      &MixtureSpec::compressibility,
      {"mixture.compressibility", uncertain, "1", 0, 1,
       "a of the grain skeleton: compliance a/(m (effective stress + stress_offset_pa))."});
  add_positive(&MixtureSpec::stress_offset_pa,
               {"mixture.stress_offset_pa", uncertain, "Pa", 0, 1e6,
                "Keeps the skeleton from being infinitely soft where it is liquefied."});
  add(&MixtureSpec::shear_grain_diameter_m,
      {"mixture.shear_grain_diameter_m", uncertain, "m", 0, 1,
       "Grain size at which collisions loosen the sheared mass."});
  keys.push_back(choice_key(mixture, &MixtureSpec::pressure_profile, "mixture.pressure_profile",
                            "Excess pore pressure over the depth: a parabola, which drains thick "
                            "masses 22 % too fast, or "
                            "resolved at nodes."));
  add(&MixtureSpec::pressure_nodes,
      {"mixture.pressure_nodes", integer, "1", fields::least_pressure_nodes,
       fields::most_pressure_nodes, "Nodes of a resolved profile; 8 when absent."});
  keys.push_back(choice_key(mixture, &MixtureSpec::drainage, "mixture.drainage",
                            "Where excess pore pressure of a resolved profile drains to: the free "
                            "surface, or both it and the bed."));
  keys.push_back(choice_key(mixture, &MixtureSpec::phases, "mixture.phases",
                            "one: grains and water move together and pore pressure evolves; two: "
                            "each has a velocity and a thickness of its own, so that liquid may "
                            "run ahead of the grains."));
  keys.push_back(choice_key(mixture, &MixtureSpec::drag_law, "mixture.drag_law",
                            "Drag between grains and liquid, with phases: two: Darcy's by "
                            "permeability_m2, or by the settling speed of one grain."));
  add_positive(&MixtureSpec::settling_speed_m_s,
               {"mixture.settling_speed_m_s", uncertain, "m s-1", 0, 100,
                "Settling speed of one grain in the liquid, with drag_law: settling; by default of "
                "a natural grain of grains.diameter_m."});
}

void add_basal(std::vector<KeyInfo>& keys) {
  using enum ValueKind;
  keys.push_back(key(basal, &BasalSpec::friction_coefficient,
                     {"basal.friction_coefficient", uncertain, "1", 0, 2,
                      "Coulomb friction coefficient between mass and ground."}));
  keys.push_back(key(basal, &BasalSpec::pore_pressure_ratio,
                     {"basal.pore_pressure_ratio", uncertain, "1", 0, 0.99,
                      "Pore pressure over normal stress at the bed, r_u."}));
  keys.push_back(key(
      basal, &BasalSpec::cohesion_pa,
      {"basal.cohesion_pa", uncertain, "Pa", 0, no_limit, "Cohesion between mass and ground."}));
  keys.push_back(key(basal, &BasalSpec::restitution,
                     {"basal.restitution", uncertain, "1", 0, 0.95,
                      "Share of the normal speed that a rebound from the ground keeps."}));
  keys.push_back(above_min(key(basal, &BasalSpec::turbulent_coefficient_m_s2,
                               {"basal.turbulent_coefficient_m_s2", uncertain, "m s-2", 0, no_limit,
                                "Voellmy's xi: drag that grows with the square of the speed, in "
                                "depth_averaged flow."})));
  keys.push_back(above_min(key(basal, &BasalSpec::viscosity_pa_s,
                               {"basal.viscosity_pa_s", uncertain, "Pa s", 0, no_limit,
                                "Viscosity of the laminar drag at the bed, in depth_averaged "
                                "flow."})));
  keys.push_back(key(basal, &BasalSpec::yield_stress_pa,
                     {"basal.yield_stress_pa", uncertain, "Pa", 0, no_limit,
                      "Yield stress of a Bingham fluid, with basal.viscosity_pa_s."}));
  add_bed_field_keys(keys);
  keys.push_back(
      key(basal, &BasalSpec::zones,
          {"basal.zones", zone_list, "", -no_limit, no_limit,
           "Parts of the ground with values of their own, such as forest or a glacier: a "
           "polygon layer and numbers or distributions in the place of basal's."}));
}

}  // namespace

void add_material_keys(std::vector<KeyInfo>& keys) {
  keys.push_back(with_choices(
      text_key(scene, &Scenario::material, "material", ValueKind::choice,
               "Ready-made priors of a process for keys that the file does not give; `describe` "
               "names values and sources. Calibrated for depth_averaged."),
      material_names()));
  add_grains(keys);
  add_states(keys);
  add_discrete_keys(keys);
  add_mixture_keys(keys);
  add_fluid_keys(keys);
  add_basal(keys);
  keys.push_back(
      choice_key(scene, &Scenario::formulation, "formulation",
                 "auto: full_stress where at least four layers of particles resolve the flow, else "
                 "depth_averaged; full_stress: three-dimensional particles with a full stress "
                 "tensor; depth_averaged: columns on the terrain; discrete: every grain by itself, "
                 "the dearest by far."));
}

void add_material_blocks(std::vector<BlockInfo>& blocks) {
  blocks.push_back(optional_block("grains", "The moving mass.", grains));
  blocks.push_back(optional_block(
      "grains.friction", "Internal friction that grows with the shear rate, mu(I).", friction));
  blocks.push_back(optional_block(
      "grains.states", "Grains that part: pressure of loose packings, dilute and isolated grains.",
      states));
  blocks.push_back(optional_block("grains.states.dilute",
                                  "Grains that collide: kinetic theory, granular temperature.",
                                  dilute));
  blocks.push_back(optional_block("grains.states.ultradilute",
                                  "Grains without neighbours: isolated particles in free flight.",
                                  ultradilute));
  blocks.push_back(optional_block(
      "mixture", "Water in the pores whose pressure follows from shear; depth_averaged only.",
      mixture));
}

}  // namespace sturz::schema_rows
