// SPDX-License-Identifier: Apache-2.0
/// Grains and liquid that want to blow up: members of a debris flow's prior, in scenes by number.
#pragma once

#include "tests/hard/hard_case.hpp"
#include "tests/support/liquid/immersed_grains.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace sturz::test {

/// One random scene. By its number modulo eight:
///   0  a saturated mass collapses onto dry ground
///   1  dry grains fall and run into a wet mass
///   2  pores drain: saturation 0.6 in one half of the mass
///   3  the same with 0.05
///   4  a wet mass hits a wall at 5 to 20 m/s
///   5  a wet mass runs into still water at 5 to 20 m/s
///   6  one layer of wet grains
///   7  loose or dense grains under water come down at a slope of the dilatancy of 1 to 4
/// Prior of docs/physics.md D.2 and beyond: solids 0.3 to 0.7, grains of 1200 to 2900 kg/m^3 in
/// 1000 to 1150 (the lightest at a ratio of 1.04), viscosity 1e-3 to 0.1 Pa s, diameter of the drag
/// 0.03 to 30 mm (one of eight 0.1 mm), drag times 1 or 100, particles 0.05 to 1 m apart.
struct HardMixture {
  std::string name;
  ImmersedGrains scene;
  double wall_x = 0;  ///< where the wall at the liquid's end goes when the run starts [m]
  /// Both sets start at this velocity along x between two places, the others at rest [m/s, m].
  double speed = 0, from_x = 0, to_x = 0;
  double saturation = 1;  ///< of the pores beyond half of the grains' length
  double end_s = 0;
};
HardMixture hard_mixture(std::uint64_t number);

/// How it came through, both sets together.
struct MixtureSurvival {
  bool finite = false;
  std::string stopped;         ///< why a run ended early, empty: it did not
  double mass_error = 0;       ///< of the set that is worse, relative
  double leaked_share = 0;     ///< found under the ground
  double speed_ratio = 0;      ///< fastest particle / (free fall + 2 sqrt(g H))
  double energy_residual = 0;  ///< over the most that was released
  double numerical_share = 0;  ///< the same
  double least_dt_ratio = 0;   ///< shortest step over the first whole one
  double particles = 0, steps = 0, seconds = 0;
};
MixtureSurvival run(const HardMixture&);
std::vector<Check> checks_of(const MixtureSurvival&);

}  // namespace sturz::test
