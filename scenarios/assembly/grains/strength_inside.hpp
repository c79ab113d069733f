// SPDX-License-Identifier: Apache-2.0
/// What the grains' friction is along a plane, and the law that full stress yields by inside.
#pragma once

#include "engine/laws/mu_i_rheology.hpp"
#include "scenarios/scenario.hpp"

#include <string>

namespace sturz {

/// As the scene gives it: tan(phi) along a plane, without pore pressure.
MuIRheology friction_law(const GrainsSpec&);

/// The same on the cone of `grains.friction_cone`, and where `grains.pore_pressure_inside` asks for
/// it on what pore pressure leaves.
MuIRheology law_inside(const Scenario& numbers);

/// Which cone acts, as which angle, and on what: "friction_cone: simple_shear, 33 degrees act as
/// 40.5 in plane strain".
std::string strength_text(const Scenario& numbers);

}  // namespace sturz
