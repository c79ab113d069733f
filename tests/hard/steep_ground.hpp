// SPDX-License-Identifier: Apache-2.0
/// Ground that wants to break a slide: 50 degree slopes, cliffs, pits, saddles, sharp ridges.
#pragma once

#include "scenarios/scenario.hpp"
#include "scenarios/scene_inputs.hpp"

#include <cstdint>

namespace sturz::test {

/// 80 x 120 cells of 10 m: a 50 degree slope with sharp ridges and gullies, a 60 m cliff, pits, a
/// saddle and a terrace, over rolling ground whose boundary is open on all sides.
Raster<double> steep_ground();

/// One random scene on it: where the mass lies, how much, how it starts, bed, earth pressure,
/// spacing, all from the corners of what a scenario accepts.
struct HardMember {
  Scenario scenario;
  SceneInputs inputs;
};
HardMember hard_member(std::uint64_t number);

/// How many members to try: STURZ_HARD_MEMBERS, or `usual`.
int hard_members(int usual);

}  // namespace sturz::test
