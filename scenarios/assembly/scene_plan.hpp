// SPDX-License-Identifier: Apache-2.0
/// The numbers that follow from a scene before any engine object is made: shared by assemble and
/// describe, so that what is described is what is run.
#pragma once

#include "engine/core/domain.hpp"
#include "engine/effects/bed/effect.hpp"
#include "engine/effects/columns/effect.hpp"
#include "engine/effects/coupling/settings.hpp"
#include "engine/effects/dense/effect.hpp"
#include "engine/effects/dilatancy/settings.hpp"
#include "engine/effects/discrete/settings.hpp"
#include "engine/effects/erosion/settings.hpp"
#include "engine/effects/isolated/contacts.hpp"
#include "engine/effects/liquid/settings.hpp"
#include "engine/effects/phases/settings.hpp"
#include "engine/particles/release.hpp"
#include "scenarios/assembly/formulation.hpp"
#include "scenarios/assembly/inflow/inflow_plan.hpp"
#include "scenarios/assembly/inflow/staggered_release.hpp"
#include "scenarios/assembly/liquid/liquid_lattice.hpp"
#include "scenarios/assembly/time_cap.hpp"
#include "scenarios/scenario.hpp"
#include "scenarios/scene_inputs.hpp"

#include <cstdint>
#include <optional>

namespace sturz {

struct ScenePlan {
  Terrain bed;  ///< of this member, excavation laid over the shared raster
  Domain domain;
  FormulationChoice formulation;
  Release release;  ///< all of it; the first n_present particles start at 0
  double release_narrow_side_m = 0;
  double bulk_density_kg_m3 = 1;
  ZoneMap zones;
  BedRasters rasters;                          ///< over the zones
  GrainStressSettings stress;                  ///< full_stress
  ContactSettings contact;                     ///< full_stress
  std::optional<LiquidSettings> liquid;        ///< where there is `fluid`
  ContactSettings liquid_contact;              ///< of it
  LiquidLattice liquid_start;                  ///< where it starts
  std::optional<DilatancySettings> dilatancy;  ///< where shear changes the grains' packing
  std::optional<CouplingSettings> coupling;    ///< where grains lie in it
  std::optional<IsolatedContactSettings> isolated_contacts;  ///< where isolated particles may meet
  std::optional<DiscreteSettings> discrete;                  ///< grains one by one
  double reference_fraction = 0.6;         ///< solid fraction of the mass as it is set down
  DepthAveragedSettings columns;           ///< depth_averaged
  std::optional<TwoPhaseSettings> phases;  ///< where grains and liquid are two sets of columns
  std::optional<ErosionSettings> erosion;  ///< where columns take their bed along
  std::vector<double> release_start_s;     ///< of each particle; empty: all at 0
  std::size_t n_present = 0;               ///< particles of the release that start at 0
  std::vector<TimedArrival> later;         ///< those that start later
  InflowPlan inflow;                       ///< what enters over time
  double reference_speed_m_s = 0;  ///< v_ref of the fastest expected mass point; not of columns
  TimeCap end;                     ///< when it is stopped at the latest
  double available_energy_j = 0;   ///< release mass falling to the lowest ground within runout

  explicit ScenePlan(Terrain ground) : bed(std::move(ground)) {}
};

/// How much of a pile a release is [-]: none under a fifth as thick (median) as its narrow side in
/// the map, one from two fifths on, in proportion between. None where walls or periods stand.
double pile_share(const Scenario&, const ScenePlan&);
inline constexpr double sheet_aspect = 0.2, pile_aspect = 0.4;

/// Internal friction is given and takes or changes some of the thrust between columns.
bool knows_internal_friction(const DepthAveragedSettings&);

/// \throws SetupError naming the key
ScenePlan plan_scene(const Scenario& numbers, const SceneInputs& inputs, std::int64_t member);

/// What a reader of a member's result has to know: thin release, coarse grains, coarse maps.
std::vector<std::string> plan_warnings(const Scenario& numbers, const ScenePlan& plan);
/// The same, and what is true of all members alike: how the release lies in the terrain.
std::vector<std::string> scene_warnings(const Scenario& numbers, const SceneInputs& inputs,
                                        const ScenePlan& plan);

}  // namespace sturz
