// SPDX-License-Identifier: Apache-2.0
/// How much of the mass is dense, dilated, colliding or alone, at one instant and over time.
#pragma once

#include "engine/effects/moving_set.hpp"

#include <span>

namespace sturz {

struct MemberScalars;

/// A mass whose density fell by more than this has dilated: its grains carry no load as a dense
/// packing does. The same as GrainStressSettings::separation_threshold.
inline constexpr double dilated_density_change = -0.02;

/// Shares of the mass of grains that is present [1]; NaN and zeros where the scene has no such
/// field.
struct StateShares {
  double dilated = 0;                                             ///< NaN without a density change
  double dense = 0, transition = 0, dilute = 0, ultradilute = 0;  ///< sum 1, or all 0
  double mean_theta = 0, max_theta = 0;  ///< granular temperature [m^2/s^2]
};
StateShares state_shares(std::span<const MovingSet> sets);

/// Integrals of the shares over time.
class StateTimes {
 public:
  /// The shares held for the last `span_s` seconds.
  void add(const StateShares& shares, double span_s);
  /// Writes the shares of mass x time; what was never observed for any time stays as it is now.
  void write(MemberScalars& scalars) const;

 private:
  StateShares now_, sum_;
  double time_s_ = 0;
};

}  // namespace sturz
