// SPDX-License-Identifier: Apache-2.0
/// Dense grains in full stress: neighbours, one fused pair pass, elastic + mu(I) update.
///
/// Brings the fields `density_change`, `stress`, `viscous_ratio` and `velocity_before`, and the
/// passes
///   neighbors: lists   gather: records   force: pair sweep   stress: density and stress n -> n+1
#pragma once

#include "engine/effects/dense/settings.hpp"
#include "engine/effects/step.hpp"

#include <memory>
#include <span>

namespace sturz {

struct GrainStress;  // what the effects of one set's grains share; engine/effects/dense/shared.hpp

/// Adds fields and passes to a set, and starts every particle in the geostatic state of its depth:
/// vertical stress rho g depth, horizontal K_0 = 1 - sin(phi) of it (tan phi = mu_s).
/// \param depth [n] vertical distance below the free surface [m]
/// \return what effects that build on it need: kinetic/effect.hpp, isolated/effect.hpp
std::shared_ptr<GrainStress> add_grain_stress(Step&, State&, std::size_t set,
                                              const GrainStressSettings&,
                                              std::span<const double> depth);

/// Memory of lists, records and sums of the pair sweep [bytes per particle]: lists and records
/// exist from the first step on, and those of a group of grains hold about 250 entries.
std::size_t grain_stress_bytes_per_particle();

}  // namespace sturz
