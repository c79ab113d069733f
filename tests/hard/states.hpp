// SPDX-License-Identifier: Apache-2.0
/// Whether a hard scene knows the dilute and ultradilute states of the grains: one place for all.
#pragma once

#include "scenarios/scenario.hpp"

#include <string_view>

namespace sturz::test {

enum class States { dense_only, all };
std::string_view to_string(States);

/// The scene with kinetic theory and isolated particles, or with dense grains alone.
/// \param restitution  of grains and particles
/// \param contacts     whether isolated particles meet each other
Scenario with_states(Scenario, States, double restitution = 0.7, bool contacts = false);

}  // namespace sturz::test
