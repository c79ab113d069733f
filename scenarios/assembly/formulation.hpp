// SPDX-License-Identifier: Apache-2.0
/// Which formulation computes a member, and why.
#pragma once

#include "engine/terrain/terrain.hpp"
#include "scenarios/scenario.hpp"

#include <string>

namespace sturz {

struct FormulationChoice {
  bool depth_averaged = false;
  bool discrete = false;  ///< grains one by one; neither of them: full_stress
  std::string reason;
  double layers = 0;          ///< least number of layers that resolve the flow: of the two below
  double release_layers = 0;  ///< volume-weighted median release thickness / spacing
  double deposit_layers =
      0;  ///< expected deposit thickness / spacing; infinite in a confined scene

  /// The word of the scenario file and of every result.
  std::string name() const {
    return std::string(to_string(depth_averaged ? Formulation::depth_averaged
                                 : discrete     ? Formulation::discrete
                                                : Formulation::full_stress));
  }
};

inline constexpr double smoothing_ratio = 1.3;  ///< h/dx, docs/physics.md B.1
/// From this many layers on three-dimensional particles resolve a flow's footprint to about 10 %.
inline constexpr double resolved_layers = 4;
/// A release under this many is refused in full_stress unless the scenario accepts it.
inline constexpr double unresolved_layers = 2;
/// Deposit area over V^(2/3) of high-speed landslides (Griswold & Iverson 2008; D.1).
inline constexpr double area_over_volume23 = 20;

/// The scenario's `formulation`; `auto` takes full_stress where at least four layers resolve both
/// the release and the expected deposit, and the scene has internal friction and asks for nothing
/// that only depth_averaged has.
/// \param thickness of the release, vertical [m]
/// \throws SetupError for full_stress under two layers without numerics.accept_unresolved
FormulationChoice choose_formulation(const Scenario&, const Raster<double>& thickness);

/// Particle updates that `auto` spends on a member at most: ten minutes at 3 million a second. A
/// constant, so that members are computed alike on every machine.
inline constexpr double affordable_updates = 1.8e9;

/// What a member costs in either formulation, roughly: particles times steps to the end.
struct CostEstimate {
  double full_stress = 0, depth_averaged = 0;  ///< particle updates
};
CostEstimate estimate_cost(const Scenario&, const Raster<double>& thickness, const Terrain& ground,
                           double end_time_s);

/// Of a mass as it moves: friction that is left beside its pore pressure. A mixture's is not known
/// before it runs; one looser than critical is taken as nearly liquefied.
double typical_friction(const Scenario& numbers);
/// Share of the weight that a liquefied mass bears on its grains, where a bound needs one.
inline constexpr double liquefied_share = 0.1;

/// Internal friction for full_stress, and nothing that only columns or only full stress know.
bool has_both_formulations(const Scenario&);

/// Takes columns in place of a full_stress that `auto` chose and cannot afford; says either way
/// what the other would cost.
void weigh_cost(const Scenario&, const Raster<double>& thickness, const Terrain& ground,
                double end_time_s, FormulationChoice&);

}  // namespace sturz
