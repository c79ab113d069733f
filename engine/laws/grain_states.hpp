// SPDX-License-Identifier: Apache-2.0
/// What grains are called by the fraction they fill, and how the laws fade into each other.
#pragma once

#include <algorithm>
#include <cstdint>

namespace sturz {

/// Gao et al. section 4.2; docs/physics.md B.9. A label for output and for `stress_mode:
/// paper_switch`: the stress itself is one continuous law.
enum class GrainState : std::uint8_t { dense, transition, dilute, ultradilute };

/// Fractions alpha_p that separate the states [-].
inline constexpr double dense_fraction = 0.60;        ///< above: dense
inline constexpr double transition_fraction = 0.50;   ///< above: enduring contacts carry load
inline constexpr double ultradilute_fraction = 0.02;  ///< below: isolated particles

/// Hysteresis of the labels, so that no grain flips each step (docs/physics.md B.9, I5).
inline constexpr double leave_dense_fraction = 0.58;    ///< a dense grain stays so down to here
inline constexpr double reenter_dense_fraction = 0.60;  ///< and becomes so again above
inline constexpr double detach_fraction = 0.02;         ///< below this, or with
inline constexpr int detach_neighbors = 4;              ///< fewer neighbours than this,
inline constexpr int detach_steps = 5;           ///< for so many steps on end: an isolated particle
inline constexpr double attach_fraction = 0.03;  ///< above this, and with
inline constexpr int attach_neighbors = 8;       ///< at least so many neighbours: a grain again

/// State by fraction alone, without memory.
inline GrainState grain_state(double fraction) {
  if (fraction > dense_fraction) return GrainState::dense;
  if (fraction >= transition_fraction) return GrainState::transition;
  if (fraction >= ultradilute_fraction) return GrainState::dilute;
  return GrainState::ultradilute;
}

/// S(x) = x^2 (3 - 2x), 0 below 0 and 1 above 1.
inline double smoothstep(double x) {
  const double y = std::clamp(x, 0.0, 1.0);
  return y * y * (3 - 2 * y);
}

/// w_k: share of the kinetic stresses, 1 up to alpha = 0.50 and 0 from 0.60 (docs/physics.md B.9).
inline double kinetic_weight(double fraction) {
  return 1 - smoothstep((fraction - transition_fraction) / (dense_fraction - transition_fraction));
}

}  // namespace sturz
