// SPDX-License-Identifier: Apache-2.0
/// Blocks `fluid` and `coupling`: a liquid in three dimensions, by itself or among grains.
#pragma once

#include "scenarios/choices.hpp"
#include "scenarios/map_box.hpp"
#include "scenarios/uncertain.hpp"

#include <array>
#include <optional>

namespace sturz {

/// What the bed does to a liquid in three dimensions; `automatic` decides by the layers that
/// resolve its flow.
enum class FluidBed { automatic, no_slip, film, slip };
constexpr auto words_of(FluidBed) {
  using enum FluidBed;
  return std::array{Word{automatic, "auto"}, Word{no_slip, "no_slip"}, Word{film, "film"},
                    Word{slip, "slip"}};
}

/// Drag and buoyancy between grains and liquid in three dimensions, or the paper's drag alone.
enum class CouplingScheme { physical, paper };
constexpr auto words_of(CouplingScheme) {
  using enum CouplingScheme;
  return std::array{Word{physical, "physical"}, Word{paper, "paper"}};
}

/// Standing water: the liquid from the ground up to one level, and in the pores of what lies in it.
/// At most one of polygon and box; neither: wherever the ground lies below that level, as far as
/// walls let it.
struct PoolSpec {
  std::optional<Uncertain> surface_m;  ///< elevation of the level surface; always needed
  std::string polygon;                 ///< any OGR polygon layer
  std::string layer;                   ///< layer name inside `polygon`; empty: the first
  std::string crs;                     ///< where `polygon` has none
  std::optional<MapBox> box;
  bool operator==(const PoolSpec&) const = default;
};

/// A liquid with particles of its own; full_stress only. Its law follows from what is given:
/// Newton's by a viscosity, Bingham's by a yield stress beside it, Herschel and Bulkley's by
/// consistency and index.
struct FluidSpec {
  Uncertain density_kg_m3{1000};
  std::optional<Uncertain> viscosity_pa_s;
  std::optional<Uncertain> yield_stress_pa;
  std::optional<Uncertain> consistency_pa_sn;  ///< K of tau = tau_y + K rate^n
  std::optional<Uncertain> index;              ///< n of it
  Uncertain saturation{1};       ///< share of the pores' height that it fills, from the bed
  std::optional<PoolSpec> pool;  ///< absent: no more of it than in the release
  FluidBed bed = FluidBed::automatic;
  double artificial_viscosity = 0.02;  ///< alpha_v of B.4, of the liquid
  bool operator==(const FluidSpec&) const = default;
};

/// What grains and liquid do to each other; absent: the defaults where a scene has both.
struct CouplingSpec {
  CouplingScheme scheme = CouplingScheme::physical;
  std::optional<Uncertain> drag_diameter_m;  ///< absent: grains.diameter_m
  Uncertain drag_multiplier{1};              ///< 1 is physics
  /// Where shear neither loosens nor tightens the grains; given: they do elsewhere.
  std::optional<Uncertain> critical_solid_fraction;
  Uncertain dilatancy_slope{4};  ///< k of tan psi = k (solid fraction - that of steady shear)
  bool operator==(const CouplingSpec&) const = default;
};

}  // namespace sturz
