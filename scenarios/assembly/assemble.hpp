// SPDX-License-Identifier: Apache-2.0
/// The one door to the engine: turns a scene of numbers into a Simulation, and the only place
/// that knows which scenario block brings which effect.
#pragma once

#include "engine/effects/sweep/fused_sweep.hpp"
#include "engine/simulation/simulation.hpp"
#include "scenarios/scenario.hpp"
#include "scenarios/scene_inputs.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace sturz {

/// Builds member `member` of a scene. Every value must be fixed (no distribution left).
/// \param threads OpenMP threads inside this member, >= 1
/// \param instruction_set of the pair loop; avx2 and avx512 give the same bits
/// \throws SetupError naming the key when the scene cannot be built
Simulation assemble(const Scenario& numbers, const SceneInputs& inputs, std::int64_t member,
                    int threads, InstructionSet instruction_set = best_instruction_set());

/// An effect that the scene calls for, or not, and why.
struct EffectNote {
  std::string name;
  bool active = false;
  std::string reason;
  std::vector<std::string> fields;     ///< that it adds to the particles
  std::size_t bytes_per_particle = 0;  ///< with its fields
};

/// What a scene will be, before anything is computed.
struct SceneDescription {
  std::vector<EffectNote> effects;
  std::vector<std::string> passes;  ///< the step, in order
  std::string formulation, formulation_reason;
  std::size_t n_particles = 0;
  std::size_t memory_bytes = 0;  ///< of one member while it runs
  double spacing_m = 0, release_volume_m3 = 0, release_area_m2 = 0;  ///< area: of the outline
  double inflow_volume_m3 = 0, inflow_end_s = 0;  ///< of what enters over time; 0: nothing does
  double normal_over_vertical = 1;  ///< volume, if thicknesses count normal to the slope
  double bulk_density_kg_m3 = 0;    ///< of the mass as it is set down
  double layers = 0;                ///< volume-weighted median vertical thickness / spacing
  double narrow_side_m = 0;         ///< of the release, see scenarios/assembly/start_checks.hpp
  /// Cost of a member in the other formulation over that in this one, roughly; 0 where the scene
  /// cannot have the other.
  double other_formulation_cost = 0;
  bool friction_inside = false;  ///< columns whose thrust knows the grains' friction
  double reference_speed_m_s = 0, sound_speed_m_s = 0;
  double dt_s = 0, n_steps = 0;  ///< estimates
  std::string binding_limit;
  double end_time_s = 0;              ///< when a member is stopped at the latest
  std::string end_time_reason;        ///< where that comes from
  std::string ground;                 ///< which part of it is read, and why
  bool needs_more_ground = false;     ///< describe again with a larger part of the raster
  double predicted_seconds = 0;       ///< n_particles * n_steps / updates per second; by the caller
  std::vector<std::string> warnings;  ///< thin flow, grain larger than particle, ...
};
SceneDescription describe(const Scenario& numbers, const SceneInputs& inputs);

}  // namespace sturz
