// SPDX-License-Identifier: Apache-2.0
/// How fast this machine computes, measured once in about a second and remembered.
#pragma once

#include <string>

namespace sturz::app {

/// Particle-updates per second of one thread in this formulation ("full_stress",
/// "depth_averaged").
///
/// Read from $XDG_CACHE_HOME/sturz/speed.json (or ~/.cache) when that was measured on this
/// processor with this build, else measured by a short slide on a plane and stored there. A cache
/// that cannot be written costs a second next time and nothing else.
/// \param measure_again ignore what is stored
double updates_per_second(const std::string& formulation, bool measure_again);

}  // namespace sturz::app
