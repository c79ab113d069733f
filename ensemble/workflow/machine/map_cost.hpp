// SPDX-License-Identifier: Apache-2.0
/// What making the maps of an ensemble will take, before anything is computed.
#pragma once

#include "ensemble/workflow/machine/machine_speed.hpp"
#include "scenarios/scenario.hpp"

#include <cstdint>

namespace sturz::workflow {

/// Computing time on this machine for the parts of making maps.
struct MapSpeed {
  double seconds_per_member = 0;         ///< opening its file, reading its scalars
  double seconds_per_touch = 0;          ///< one cell of one member: reading, sorting, statistics
  double seconds_per_plane = 0;          ///< one map: its file, style and picture, however small
  double seconds_per_plane_cell = 0;     ///< one cell of one map: writing and reading it
  double seconds_per_packed_member = 0;  ///< as seconds_per_member, in a pack
};

/// What the maps are made of.
struct MapWork {
  std::int64_t members = 0;
  double cells_per_member = 0;  ///< cells that one member touches, on average
  double cells = 0;             ///< of the rectangle around what all of them touch
  int planes = 0;               ///< of all layers, see map_planes()
  bool materials = false;       ///< grains and liquid are told apart
};

struct MapCost {
  double seconds = 0;       ///< of computing; the disk's waiting is not in it
  double memory_bytes = 0;  ///< largest at a time, without the terrain
  double disk_bytes = 0;    ///< of hazard.nc, GeoTIFFs, page and tables together
};

/// What the program and its libraries take, maps and page of hardly any cells included.
inline constexpr double program_bytes = 148e6;

/// Maps that this scene asks for, bounds included. \param erodes the flow takes its bed along
/// \param materials grains and liquid are told apart
int map_planes(const HazardSpec&, bool erodes = false, bool materials = false);
/// Whether grains and liquid move apart, so that each has maps of its own.
bool has_materials(const Scenario&);

MapCost predict_map_cost(const MapWork&, const MapSpeed&);

/// Read from the cache when that was measured on this processor with this build, else measured on
/// made-up members in a temporary folder (a second or two) and stored there.
MapSpeed map_speed(const SpeedCache&);

}  // namespace sturz::workflow
