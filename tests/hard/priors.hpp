// SPDX-License-Identifier: Apache-2.0
/// The default priors of a dry rock avalanche (docs/physics.md D.2) as a design of hard members.
#pragma once

#include "ensemble/sampling/design.hpp"

namespace sturz::test {

inline constexpr int n_corners = 64, n_random = 400, n_points = n_corners + n_random;

/// Ten marginals, the six with the largest rank correlation to the run-out first
/// (docs/studies/stability.md measures them). Names that are no scenario keys:
///   grains.friction_angle_deg  makes grains.friction.static = tan
///   grains.friction_gain       mu_2 - mu_s
///   release.volume_factor      of the volume that the survey gives
/// The bed has both the prior of mu_eff and that of r_u, so it gets weaker than either says.
std::vector<UncertainKey> rock_avalanche_priors();

/// Rows 0..63: all combinations of the 1 % and 99 % quantiles of the first six, the others at their
/// median. Rows 64..463: a Latin hypercube of all ten, with D.2's correlation of bed and internal
/// friction. The same numbers on every machine; drawn at the first call, so call it before workers
/// start.
const DesignTable& hard_points();

/// The scene with a row of hard_points in it; `volume_m3` is the survey's.
Scenario at_point(Scenario, int row, double volume_m3);

}  // namespace sturz::test
