// SPDX-License-Identifier: Apache-2.0
/// Every field that an effect can add to a particle set: name, components, unit, owner.
#pragma once

#include "engine/particles/field.hpp"

#include <cstdint>

namespace sturz::fields {

// Of every set that accounts for energy.
/// Velocity at the start of the step.
inline constexpr FieldKey velocity_before{"velocity_before", 3, "m s-1", "motion"};

// Grain stress (dense/).
/// Relative density change rho / rho_ref - 1.
inline constexpr FieldKey density_change{"density_change", 1, "1", "grain stress"};
/// Stress of enduring contacts, tension positive.
inline constexpr FieldKey stress{"stress", 6, "Pa", "grain stress"};
/// Artificial viscosity over the friction that acts, see dense/viscous_share.hpp.
inline constexpr FieldKey viscous_ratio{"viscous_ratio", 1, "1", "grain stress"};
/// Gradient of the density change, of the pair sweeps over 10 h/c0.
inline constexpr FieldKey density_gradient{"density_gradient", 3, "m-1", "grain stress"};
/// 0..1: how much of a grain's image in the ground acts, of the last pair sweep.
inline constexpr FieldKey ground_weight{"ground_weight", 1, "1", "grain stress", 1.0};

// Dilatancy (dilatancy/).
/// Density of the packing without load over the reference density, less 1.
inline constexpr FieldKey packing_change{"packing_change", 1, "1", "dilatancy"};

// States of the grains (kinetic/).
/// GrainState by number.
inline constexpr FlagKey state{"state", "states of the grains"};
/// How complete the support is with neighbours and ground, 1 inside a dense mass.
inline constexpr FieldKey support_completeness{"support_completeness", 1, "1",
                                               "states of the grains", 1.0};
inline constexpr FieldKey granular_temperature{"granular_temperature", 1, "m2 s-2",
                                               "kinetic theory"};
/// Stress of collisions, tension positive.
inline constexpr FieldKey kinetic_stress{"kinetic_stress", 6, "Pa", "kinetic theory"};

// Isolated particles (isolated/).
/// For how many steps on end a grain has been without neighbours, at most detach_steps.
inline constexpr FlagKey steps_alone{"steps_alone", "isolated particles"};
/// Membership by number.
inline constexpr FlagKey membership{"membership", "isolated particles"};
inline constexpr FieldKey spin{"spin", 3, "rad s-1", "contacts of isolated particles"};

// Grains one by one (discrete/).
/// By grain contacts in the last step: of the velocity [m s-2] and of the spin [rad s-2].
inline constexpr FieldKey grain_acceleration{"grain_acceleration", 6, "mixed", "grain contacts"};

/// Where a particle belongs: to the continuum, or on its own.
enum class Membership : std::uint8_t {
  listed,     ///< a grain of the continuum
  in_flight,  ///< isolated: in no neighbour list
  landed,     ///< isolated, and come to rest: taken back at the next sorting
};

// Liquid among grains (coupling/).
/// X: volume of grains per volume of liquid where a liquid particle is; the grains' share of the
/// space is X/(1 + X).
inline constexpr FieldKey grain_share{"grain_share", 1, "1", "grains in liquid"};
/// Divergence of the grains' flux past the liquid, div(alpha_p (v_p - v_f)).
inline constexpr FieldKey slip_divergence{"slip_divergence", 1, "s-1", "grains in liquid"};
/// What the liquid gave of a grain's change of velocity in this step.
inline constexpr FieldKey exchange_velocity{"exchange_velocity", 3, "m s-1", "grains in liquid"};

// Depth-averaged columns (columns/).
/// Normal to the ground.
inline constexpr FieldKey thickness{"thickness", 1, "m", "column pressure"};
/// Support radius of a column's smoothing.
inline constexpr FieldKey support_radius{"support_radius", 1, "m", "column pressure"};
/// Map area that a column stands for over what `column_area` says of it: as it was released, the
/// part of its lattice cell that the source covers; kept from then on.
inline constexpr FieldKey area_share{"area_share", 1, "1", "column pressure", 1.0};
/// Normal reaction of the ground per mass.
inline constexpr FieldKey normal_gravity{"normal_gravity", 1, "m s-2", "column pressure"};
/// Momentum per mass of curvature met and not yet borne by the ground.
inline constexpr FieldKey centripetal_momentum{"centripetal_momentum", 1, "m s-1",
                                               "column pressure"};
/// Slope east and north [-], second derivatives ee, en, nn [1/m] of the ground below.
inline constexpr FieldKey ground{"ground", 5, "mixed", "column pressure"};
/// Lateral over normal stress.
inline constexpr FieldKey earth_pressure{"earth_pressure", 1, "1", "column pressure", 1.0};

// Mixture of grains and pore fluid in columns (columns/mixture.hpp).
/// Volumes of grains and of water in a column, both constant.
inline constexpr FieldKey solids_volume{"solids_volume", 1, "m3", "pore pressure"};
inline constexpr FieldKey water_volume{"water_volume", 1, "m3", "pore pressure"};
/// Of the mixture, without the film of water on it.
inline constexpr FieldKey solid_fraction{"solid_fraction", 1, "1", "pore pressure"};
/// At the base, over that of still water: what a column carries along.
inline constexpr FieldKey excess_pressure{"excess_pressure", 1, "Pa", "pore pressure"};
/// At the base: excess and still water at the last kick.
inline constexpr FieldKey pore_pressure{"pore_pressure", 1, "Pa", "pore pressure"};
/// Normal gravity that the excess was last brought to; negative until the first step has
/// found the thickness.
inline constexpr FieldKey pore_gravity{"pore_gravity", 1, "m s-2", "pore pressure", -1.0};

/// Excess pressure at the nodes of a resolved profile, from the bed up; one key for each number of
/// nodes, least_pressure_nodes and up.
inline constexpr int least_pressure_nodes = 5, most_pressure_nodes = 10;
inline constexpr FieldKey excess_profile[] = {
    {"excess_profile", 5, "Pa", "pore pressure"}, {"excess_profile", 6, "Pa", "pore pressure"},
    {"excess_profile", 7, "Pa", "pore pressure"}, {"excess_profile", 8, "Pa", "pore pressure"},
    {"excess_profile", 9, "Pa", "pore pressure"}, {"excess_profile", 10, "Pa", "pore pressure"}};
constexpr const FieldKey& excess_profile_of(int nodes) {
  return excess_profile[nodes - least_pressure_nodes];
}

// Of a bed that the flow takes along (erosion/).
/// Part of a column's mass that was bed.
inline constexpr FieldKey entrained_mass{"entrained_mass", 1, "kg", "erosion"};

}  // namespace sturz::fields
