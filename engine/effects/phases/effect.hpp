// SPDX-License-Identifier: Apache-2.0
/// Grains and liquid as two sets of depth-averaged columns over the same ground, each with its own
/// thickness and velocity (Pitman & Le 2005 in the form of Pelanti, Bouchut & Mangeney 2008; the
/// columns' twin of the two-phase coupling in three dimensions). With h = h_s + h_f, g =
/// rho_f/rho_s and G the reaction of the ground per mass:
///   D u_s = -(G/h_s) grad(h_s^2/2 + (1 - g) h_s h_f/2) - g G grad h_f + drag - (1 - g S) G mu
///   D u_f = -G grad h_f - G grad h_s - drag rho_s h_s/(rho_f h_f) - 3 eta u_f/(rho_f h^2) - G
///   u_f^2/(xi h)
/// S is the share of the grains' pores that liquid fills, at their densest packing: dry grains have
/// no buoyancy.
#pragma once

#include "engine/effects/phases/settings.hpp"
#include "engine/effects/step.hpp"

#include <span>

namespace sturz {

/// Makes columns of sets 0 (grains) and 1 (liquid), which may be empty, and couples them: shared
/// cells, pressure of each on the other, drag, accounts. \param grains, liquid vertical thickness
/// of each column's own material at release [m] \param grains_covered, liquid_covered see
/// add_depth_averaged
void add_two_phases(Step&, State&, const TwoPhaseSettings&, std::span<const double> grains,
                    std::span<const double> liquid, std::span<const double> grains_covered = {},
                    std::span<const double> liquid_covered = {});

/// Memory besides the sets' fields, of grains and liquid of one column [bytes].
std::size_t two_phase_bytes_per_particle();

}  // namespace sturz
