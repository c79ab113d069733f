// SPDX-License-Identifier: Apache-2.0
/// How fast a flow wears down the bed that it runs over (docs/physics.md F.8).
#pragma once

#include "engine/core/constants.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sturz {

/// A column of the flow as its bed meets it.
struct FlowOverBed {
  double thickness = 0;       ///< h, along the normal [m]
  double speed = 0;           ///< |u| [m/s]
  double density = 1;         ///< rho, bulk [kg/m^3]
  double normal_gravity = 0;  ///< g_n [m/s^2]
  double drive = 0;           ///< gravity along the motion, positive downhill [m/s^2]
  double brake = 0;           ///< tau_1 / (rho h): what the bed takes from the flow [m/s^2]
};

/// Depth that goes per time, normal to the bed [m/s]:
///   exponential    E = E_s h |u|                   volume grows by E_s per metre of path
///   (McDougall
///                                                  & Hungr 2005)
///   shear_stress   E = rate until e_m is reached   e_m = d (tau - tau_c), tau = rho h g_s, g_s
///                                                  gravity along the motion (Frank et al. 2015)
///   momentum_jump  E = 2 (tau_1 - tau_2)/(rho_b |u|)  from the jump of traction across the
///                                                  interface, slip speed |u|/2 of a linear profile
///                                                  (Iverson 2012); tau_2 = mu_b (1 - r_b) rho h
///                                                  g_n
/// None takes anything at rest, against the motion's fall (shear_stress) or where the bed resists
/// as much as the flow pulls (momentum_jump).
struct Entrainment {
  enum class Law { exponential, shear_stress, momentum_jump };

  Law law = Law::exponential;
  double growth_rate = 0;          ///< E_s [1/m]
  double rate = 0.025;             ///< [m/s]
  double depth_per_stress = 1e-4;  ///< d [m/Pa]
  double critical_stress = 1e3;    ///< tau_c [Pa]
  double bed_friction = 0;         ///< mu_b [-]
  double bed_pressure_ratio = 1;   ///< r_b: pore pressure in the bed over the normal stress [-]

  /// The jump law is none of a flow that creeps: its depth per path grows as 1/u^2.
  static constexpr double least_jump_speed = 0.1;  ///< [m/s]

  /// E [m/s]. \param bed_density rho_b [kg/m^3]
  double erosion_rate(const FlowOverBed& flow, double bed_density) const {
    if (!(flow.speed > 0) || !(flow.thickness > 0)) return 0;
    switch (law) {
      case Law::exponential:
        return growth_rate * flow.thickness * flow.speed;
      case Law::shear_stress:
        return most_depth(flow) > 0 ? rate : 0;
      case Law::momentum_jump: {
        if (flow.speed < least_jump_speed) return 0;
        const double held = bed_friction * (1 - bed_pressure_ratio) * flow.normal_gravity;
        const double jump = flow.density * flow.thickness * (flow.brake - held);
        return std::max(0.0, 2 * jump / (bed_density * flow.speed));
      }
    }
    return 0;
  }

  /// Depth that this flow can take at one place in all, normal to the bed [m].
  double most_depth(const FlowOverBed& flow) const {
    if (law != Law::shear_stress) return std::numeric_limits<double>::infinity();
    const double stress = flow.density * flow.thickness * flow.drive;
    return std::max(0.0, depth_per_stress * (stress - critical_stress));
  }
};

}  // namespace sturz
