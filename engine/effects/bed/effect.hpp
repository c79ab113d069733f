// SPDX-License-Identifier: Apache-2.0
/// The ground and analytic walls: pressure support, contact, Coulomb friction with pore pressure.
#pragma once

#include "engine/effects/bed_rasters.hpp"
#include "engine/effects/step.hpp"
#include "engine/laws/herschel_bulkley.hpp"
#include "engine/terrain/zone_map.hpp"

#include <optional>
#include <vector>

namespace sturz {

struct GroundFriction {
  double friction_coefficient = 0.4;  ///< mu_b [-]
  double pore_pressure_ratio = 0;     ///< r_u [-]
  double cohesion_pa = 0;             ///< c_b [Pa]
};

/// What a bed does to the liquid beside it.
enum class LiquidBed {
  slip,     ///< it pushes, and never drags
  film,     ///< drag of a film too thin for its shear to be resolved, by the depth of the flow
  no_slip,  ///< it holds the liquid: from about four layers on the shear beside it is resolved
};

struct LiquidContact {
  HerschelBulkley law;
  LiquidBed bed = LiquidBed::no_slip;
  /// By the domain's analytic walls: whether each drags the particles beside it by the shear
  /// between; those beyond its end slip.
  std::vector<bool> wall_holds = {};
};

struct ContactSettings {
  double spacing = 1;               ///< initial particle spacing dx [m]
  double smoothing_length = 1.3;    ///< h [m]; its support radius is 2h
  double reference_density = 1500;  ///< rho_ref [kg/m^3]
  double stiffness = 1;             ///< k [1/s^2]: max(10 g H/dx^2, (v_ref/(dx/2))^2)
  double restitution = 0.2;         ///< e_b [-]
  /// mu_s of the grains inside; the bed's friction on those that do not lie on it is no more than
  /// they hand on [-].
  double internal_friction = 1e300;
  std::vector<GroundFriction> bed{1};  ///< by zone, [0] where there is none
  ZoneMap zones;
  BedRasters rasters;  ///< over the ground of the zones
  /// Of a liquid; absent for grains. It has no Coulomb friction, so `bed` does not count.
  std::optional<LiquidContact> liquid;
};

/// Adds the look-up of ground and walls and the ground's contact. Reads the fields of grain stress
/// where the set has them (an isolated particle has no pressure).
void add_terrain_contact(Step&, std::size_t set, const ContactSettings&);
/// Adds the look-up of the ground alone, for particles that bring their own contact with it:
/// closest points count within half a `spacing`, distances are up to date within 2 h.
void add_ground_lookup(Step&, std::size_t set, const ContactSettings&);
/// Adds the contact of the domain's analytic walls, each until it is removed. After
/// add_terrain_contact.
void add_wall_contact(Step&, std::size_t set, const ContactSettings&);

}  // namespace sturz
