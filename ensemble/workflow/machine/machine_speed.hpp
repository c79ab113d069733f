// SPDX-License-Identifier: Apache-2.0
/// How fast this machine computes, measured once in about a second and remembered.
#pragma once

#include <filesystem>
#include <string>

namespace sturz::workflow {

/// Where a machine's speed is remembered from one process to the next.
struct SpeedCache {
  std::filesystem::path file;  ///< empty: nothing is remembered
  bool measure_again = false;  ///< ignore what is stored
};

/// Particle-updates per second of one thread in this formulation ("full_stress",
/// "depth_averaged").
///
/// Read from the cache when that was measured on this processor with this build, else measured by
/// a short slide on a plane and stored there. A cache that cannot be written costs a second next
/// time and nothing else.
double updates_per_second(const std::string& formulation, const SpeedCache&);

}  // namespace sturz::workflow
