// SPDX-License-Identifier: Apache-2.0
/// What an effect is called wherever it is spoken of: `describe`, computing times, reports.
#pragma once

#include <string_view>

namespace sturz {

struct EffectName {
  static constexpr std::string_view gravity = "gravity";
  static constexpr std::string_view bed = "bed";
  static constexpr std::string_view grain_stress = "grain stress";
  static constexpr std::string_view dilatancy = "dilatancy";
  static constexpr std::string_view states = "states of the grains";
  static constexpr std::string_view kinetic_theory = "kinetic theory";
  static constexpr std::string_view isolated = "isolated particles";
  static constexpr std::string_view isolated_contacts = "contacts of isolated particles";
  static constexpr std::string_view grain_contacts = "grain contacts";
  static constexpr std::string_view column_pressure = "lateral pressure of columns";
  static constexpr std::string_view pore_pressure = "pore pressure and dilatancy";
  static constexpr std::string_view phase_drag = "drag between grains and liquid";
  static constexpr std::string_view liquid = "liquid";
  static constexpr std::string_view coupling = "grains in liquid";
  static constexpr std::string_view erosion = "erosion of the bed";
  static constexpr std::string_view inflow = "inflow";
  static constexpr std::string_view later_release = "later releases";
  static constexpr std::string_view walls = "walls";
  static constexpr std::string_view motion = "motion";
  /// No scenario key asks for it: peak maps, history, limits of the time step.
  static constexpr std::string_view bookkeeping = "bookkeeping";
};

}  // namespace sturz
