// SPDX-License-Identifier: Apache-2.0
#include "tests/hard/states.hpp"

namespace sturz::test {

std::string_view to_string(States states) {
  return states == States::all ? "all states" : "dense only";
}

Scenario with_states(Scenario s, States states, double restitution, bool contacts) {
  s.grains->states.reset();
  if (states == States::dense_only) return s;
  GrainStatesSpec& spec = s.grains->states.emplace();
  spec.dilute.emplace().restitution = restitution;
  spec.ultradilute.emplace().restitution = restitution;
  if (contacts) spec.ultradilute->contacts = IsolatedContactLaw::hertz_mindlin;
  return s;
}

}  // namespace sturz::test
