// SPDX-License-Identifier: Apache-2.0
/// A release whose parts start at different times.
#pragma once

#include "engine/effects/inflow/settings.hpp"
#include "engine/particles/release.hpp"
#include "scenarios/scenario.hpp"
#include "scenarios/scene_inputs.hpp"

#include <string>
#include <vector>

namespace sturz {

struct StaggeredRelease {
  Release all;                  ///< particles by ascending start
  std::vector<double> start_s;  ///< of each particle; empty: all at 0
  std::size_t n_present = 0;    ///< that are there from the beginning

  std::size_t n_later() const { return all.x.size() - n_present; }
};

/// \param thickness of the whole release, vertical [m]; nothing of it above zero: an empty release
StaggeredRelease staggered_release(const Scenario& numbers, const SceneInputs&, const Terrain& bed,
                                   const Raster<double>& thickness, const ReleaseSettings&);

/// The particles that start later, with their velocities along the ground.
std::vector<TimedArrival> later_columns(const StaggeredRelease&, const Scenario& numbers,
                                        const Terrain& bed);

/// How much starts when, in words. \param later not empty
std::string later_text(const std::vector<TimedArrival>& later, const Scenario& numbers,
                       double bulk_density);

}  // namespace sturz
