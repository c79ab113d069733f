// SPDX-License-Identifier: Apache-2.0
/// Dense grains in full stress: neighbours, one fused pair pass, elastic + mu(I) update.
///
/// Brings the fields "compression" (rho/rho_ref - 1), "stress" (xx yy zz xy yz zx, tension
/// positive, Pa) and "velocity_before" (of the last half step), and the passes
///   neighbors: lists   pack: records   force: pair sweep   stress: density and stress n -> n+1
#pragma once

#include "engine/effects/dense/settings.hpp"
#include "engine/effects/step.hpp"

#include <span>

namespace sturz {

/// Adds fields and passes, and starts every particle in the geostatic state of its depth:
/// vertical stress rho g depth, horizontal K_0 = 1 - sin(phi) of it (tan phi = mu_s).
/// \param depth [n] vertical distance below the free surface [m]
void add_grain_stress(Step&, State&, const GrainStressSettings&, std::span<const double> depth);

}  // namespace sturz
