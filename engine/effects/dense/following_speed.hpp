// SPDX-License-Identifier: Apache-2.0
/// The rule by which a numerical sound speed follows the flow.
#pragma once

#include <algorithm>
#include <cstddef>

namespace sturz {

/// Keeps c0 at `factor` times the present largest speed (so the Mach number stays at 1/factor),
/// never under what the mass needs at rest and never over twice what its descent asks for.
struct FollowingSpeed {
  double factor = 10;  ///< c0 over the largest speed
  double least = 0;    ///< what the mass needs at rest [m/s]
  double planned = 0;  ///< c0 of the whole descent [m/s]

  /// \param c0  at present [m/s] \param fastest  largest speed [m/s] \return c0 from now on
  double next(double c0, double fastest, std::size_t n_steps) const {
    const double needed = factor * fastest;
    const double wanted = std::clamp(room * needed, least, 2 * std::max(planned, least));
    if (wanted > c0 && needed > c0) return wanted;
    if (n_steps % interval == 0 && wanted < c0) return std::max(wanted, fall * c0);
    return c0;
  }

 private:
  /// Raised at once with this much room, so that an accelerating flow does not ask every step.
  static constexpr double room = 1.1;
  /// Lowered slowly: by this factor every so many-th step.
  static constexpr double fall = 0.97;
  static constexpr int interval = 16;
};

}  // namespace sturz
