// SPDX-License-Identifier: Apache-2.0
/// The hard cases by name; numbers are those of docs/physics.md B.13.
#pragma once

#include "tests/hard/hard_case.hpp"

namespace sturz::test {

/// I1: a bank with vertical faces of 0.75 of 4c/(rho g (1 - tan phi)), the critical height of
/// friction_cone: simple_shear.
CaseReport cohesive_bank_stands(States);
/// I1: the same of 1.2 of that height must come down.
CaseReport tall_bank_falls(States);
/// I1: both with friction_cone: plane_strain, whose height is 4c/(rho g) tan(45 + phi/2).
CaseReport plane_strain_bank_falls(States);
/// I1: of 0.9 of their heights both banks should stand. They do not, see stability_notes.md.
CaseReport bank_near_its_height(States);
CaseReport plane_strain_bank_near_its_height(States);
/// I1: no clumps and no crumbs where cohesive grains are pulled apart.
CaseReport stretched_bar(States);
/// I4: what may stay stays, on ground that leans.
CaseReport heap_on_a_slope(States);
/// I11: impact ten times faster than any fall of the scene.
CaseReport drop_on_60_degrees(States);
CaseReport drop_on_80_degrees(States);
/// I12: shear bands as thin as the particles are a fault of the law or of the scheme.
CaseReport banding(States);
/// I16: a wall that goes must not leave energy behind.
CaseReport gate_removal(States);
/// I17: one member of the random set, three times.
CaseReport same_bits(States);

// With all states of the grains only:

/// I5: the fraction goes up and down across 0.6 and across 0.02; names must not flicker.
CaseReport breathing(States);
/// I6: a loose layer hits the ground at 10 m/s and is pressed up to the largest fraction.
CaseReport pressed_to_the_limit(States);
/// I13: a mass that flies apart, until no particle has a neighbour.
CaseReport jet_breaks_up(States);
/// I14: particles that touch at 1e-6 to 1 m/s separate again, with the restitution that was set.
CaseReport slow_contacts_part(States);
/// I15: particles of one scene are alike in mass.
CaseReport masses_mix(States);
/// I16: going and coming of particles over a cliff must not make energy.
CaseReport isolated_come_and_go(States);

}  // namespace sturz::test
