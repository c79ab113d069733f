// SPDX-License-Identifier: Apache-2.0
/// Liquid in three dimensions: weakly compressible SPH on the pair sweep of the dense grains, whose
/// stress here is -P I + s with Tait's P and the s of a Herschel-Bulkley law.
///
/// Brings the fields `density_change`, `stress`, `viscous_ratio`, `density_gradient`,
/// `ground_weight` and `velocity_before`, and the passes
///   neighbors: lists   gather: records   force: pair sweep   stress: density and stress n -> n+1
#pragma once

#include "engine/effects/liquid/settings.hpp"
#include "engine/effects/step.hpp"

#include <cstddef>
#include <span>

namespace sturz {

/// Adds fields and passes to a set, and starts every particle under the weight of what lies above
/// it. Where the set has fields::grain_share (coupling/effect.hpp), volumes and stresses are those
/// of the mixture.
/// \param depth [n] vertical distance below the free surface of the liquid [m]; negative: it does
/// not fill its pores, and 1 + e is `saturation`
/// \param saturation [n] share of the pores that it fills, or empty: 1 everywhere
void add_liquid(Step&, State&, std::size_t set, const LiquidSettings&,
                std::span<const double> depth, std::span<const double> saturation = {});

/// Memory of lists, records and sums of its pair sweep [bytes per particle].
std::size_t liquid_bytes_per_particle();

}  // namespace sturz
