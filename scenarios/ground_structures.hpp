// SPDX-License-Identifier: Apache-2.0
/// Dams and buildings as their files give them, ready to be laid over any part of the ground.
#pragma once

#include "engine/core/vec.hpp"
#include "engine/terrain/raster.hpp"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sturz {

/// One line of a dam, with points a cell of the terrain or less apart.
struct DamLine {
  std::size_t dam = 0;             ///< index in terrain.dams
  std::string name;                ///< "terrain.dams[0]", with its feature where there are several
  std::vector<Vec2> points;        ///< map coordinates
  std::vector<double> ground_m;    ///< elevation of the ground below them, without any dam
  std::optional<double> height_m;  ///< that its own feature gives
  double length_m = 0;
  /// How far the sides go down at most, in heights of the crest times their slope: settled once on
  /// all the ground around, so that no part of it decides.
  double foot_heights = 10;
};

/// A cell of the ground that a building covers.
struct RaisedCell {
  std::size_t cell = 0;  ///< index on the held cells
  double by_m = 0;
  int building = 0;  ///< which of them, counted over the whole layer
};

struct GroundStructures {
  std::vector<DamLine> dams;
  /// The ground around all dams without them, on cells of the working grid: so far as the foot of
  /// the highest may come. Empty without dams.
  Raster<double> site;
  /// By dam of the scene: its height is uncertain, so each member raises its own.
  std::vector<bool> by_member;
  std::vector<RaisedCell> buildings;  ///< rising by cell, each once
  int n_buildings = 0;                ///< of the layer

  bool any() const { return !dams.empty() || n_buildings > 0; }
  bool any_by_member() const {
    for (const bool one : by_member)
      if (one) return true;
    return false;
  }
};

}  // namespace sturz
