// SPDX-License-Identifier: Apache-2.0
/// The one list of effects: which block of a scene calls for each, why, and what it adds.
/// `assemble` builds a member from it and `describe` speaks from it, so what is described is what
/// is run.
#pragma once

#include "engine/effects/step.hpp"
#include "scenarios/assembly/scene_plan.hpp"
#include "scenarios/scenario.hpp"

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace sturz {

/// A scene while its effects are added.
struct SceneParts {
  const Scenario& scenario;
  const ScenePlan& plan;
  Step& step;
  State& state;
  std::shared_ptr<GrainStress> grain_stress = nullptr;  ///< once the scene has it
};

/// Whether a scene has an effect, and the words for it.
struct Called {
  bool active = false;
  std::string reason;  ///< names the block or key that decides
};

struct EffectRow {
  std::string_view name;
  Called (*called)(const Scenario&, const ScenePlan&);
  /// Adds fields and passes where `called`; null for what another row's passes do with a number
  /// (an identity of a law is a parameter, not an effect).
  void (*add)(SceneParts&) = nullptr;
  /// Memory besides the set's own fields [bytes per particle]; null: none.
  std::size_t (*bytes_per_particle)() = nullptr;
  bool of_all_sets = false;  ///< that memory is one of sets that get no field, too
};

/// In the order in which they are added: passes of one stage run in this order.
std::span<const EffectRow> effect_table();

/// Adds one effect to the step, under the name of its row.
void add_effect(const EffectRow&, SceneParts&);
/// Adds every effect that the scene calls for.
void add_effects(SceneParts&);

}  // namespace sturz
