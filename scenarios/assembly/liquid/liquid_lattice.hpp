// SPDX-License-Identifier: Apache-2.0
/// Where the liquid of a scene starts: in the release, and in the pool around and above it.
#pragma once

#include "engine/terrain/raster.hpp"
#include "scenarios/scenario.hpp"
#include "scenarios/scene_inputs.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sturz {

struct ScenePlan;

/// Particles of the liquid; arrays [n], those of the release first.
struct LiquidLattice {
  std::vector<double> x, y, z;  ///< [m]
  std::vector<double> mass;     ///< [kg]
  std::vector<double> depth;    ///< vertical, below the liquid's own surface at that place [m]
  std::size_t n_in_release = 0;
  /// [n of the release] Depth under the release's surface that the contacts of grains bear as
  /// weight of their own: less than all of it where liquid carries some [m].
  std::vector<double> grain_depth;
  double deepest_m = 0;  ///< of `depth`
  double pool_m3 = 0;    ///< from the ground to the pool's surface, grains included; 0: no pool
  double pool_area_m2 = 0, pool_depth_m = 0;
  double open_edge_m = 0;  ///< see Pool

  std::size_t size() const { return x.size(); }
};

/// Of a plan whose bed and release are known, with grains or without.
///
/// In the release it fills the pores from the bed up to `saturation` of each stack's height, and up
/// to the pool's surface where that is higher; a layer that it fills in part has a lighter
/// particle. Above the release and beside it the pool stands in stacks of its own. \param thickness
/// of the release [m]
LiquidLattice lay_out_liquid(const Scenario& numbers, const SceneInputs&, const ScenePlan&,
                             const Raster<double>& thickness, std::int64_t member);

}  // namespace sturz
