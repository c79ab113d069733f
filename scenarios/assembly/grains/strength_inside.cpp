// SPDX-License-Identifier: Apache-2.0
#include "scenarios/assembly/grains/strength_inside.hpp"

#include "engine/laws/friction_cone.hpp"
#include "scenarios/schema/number_text.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sturz {
namespace {

double pore_pressure_inside(const Scenario& s) {
  return s.grains->pore_pressure_inside ? s.basal.pore_pressure_ratio.value : 0;
}

/// In degrees, to a tenth; "no finite angle" where none yields.
std::string degrees(double angle) {
  if (!std::isfinite(angle)) return "no finite angle";
  return short_number(std::round(10 * angle * 180 / std::numbers::pi) / 10);
}

/// Of slow and of very fast flow where they differ: "20.9 to 32.8".
std::string degrees(double slow, double fast) {
  const std::string from = degrees(slow), to = degrees(fast);
  return from == to ? from : from + " to " + to;
}

}  // namespace

MuIRheology friction_law(const GrainsSpec& g) {
  MuIRheology law;
  if (g.friction_angle_deg) {
    law.static_friction = law.dynamic_friction =
        std::tan(g.friction_angle_deg->value * std::numbers::pi / 180);
  } else {
    const FrictionLaw f = g.friction.value_or(FrictionLaw{});
    law.static_friction = f.static_coefficient.value;
    law.dynamic_friction = std::max(f.dynamic_coefficient.value, law.static_friction);
    law.inertial_number_scale = f.inertial_number_scale.value;
  }
  law.grain_diameter = g.diameter_m.value;
  law.grain_density = g.density_kg_m3.value;
  law.cohesion = g.cohesion_pa.value;
  return law;
}

MuIRheology law_inside(const Scenario& s) {
  return yielding_law(friction_law(*s.grains), s.grains->friction_cone, pore_pressure_inside(s));
}

std::string strength_text(const Scenario& s) {
  const GrainsSpec& g = *s.grains;
  const MuIRheology typed = friction_law(g), dry = yielding_law(typed, g.friction_cone, 0);
  const double slow = typed.static_friction, fast = typed.dynamic_friction;
  const auto in_plane_strain = [](const MuIRheology& law) {
    return degrees(plane_strain_angle(law.static_friction),
                   plane_strain_angle(law.dynamic_friction));
  };
  std::string text =
      "friction_cone: " + std::string(to_string(g.friction_cone)) + ", " +
      degrees(std::atan(slow), std::atan(fast)) + " degrees act as " +
      (g.friction_cone == FrictionCone::simple_shear
           ? in_plane_strain(dry) + " in plane strain"
           : degrees(std::atan(dry.static_friction), std::atan(dry.dynamic_friction)) +
                 " along a plane");
  const double ratio = s.basal.pore_pressure_ratio.value;
  if (g.pore_pressure_inside)
    text += "; pore_pressure_inside: a ratio of " + short_number(ratio) + " leaves " +
            in_plane_strain(law_inside(s)) + " degrees in plane strain";
  else if (ratio > 0)
    text += "; basal.pore_pressure_ratio weakens the bed only";
  return text;
}

}  // namespace sturz
