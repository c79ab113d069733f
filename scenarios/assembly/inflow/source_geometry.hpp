// SPDX-License-Identifier: Apache-2.0
/// Where the columns of one inflow enter and which way they go.
#pragma once

#include "engine/terrain/terrain.hpp"
#include "scenarios/inflow/hydrograph.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace sturz {

class SourceGeometry {
 public:
  /// \param direction_deg clockwise from north; none: down the ground below it
  /// \throws SetupError where the ground is level and no direction is given, or unknown
  SourceGeometry(const InflowSource&, const Terrain& bed, std::optional<double> direction_deg);

  /// Across the way; of a polygon its extent [m].
  double width_m() const { return width_; }
  /// Map distance over distance along the ground, the way it flows: cosine of the slope.
  double level() const { return level_; }

  struct Place {
    Vec2 at{0, 0};   ///< [m]
    Vec2 way{0, 0};  ///< unit vector
  };
  /// Of column k; `offset` in 0..1 shifts all of them.
  Place place(std::size_t k, double offset);

 private:
  struct Stretch {
    Vec2 from{0, 0}, to{0, 0}, way{0, 0};
    double until = 0;  ///< width up to its end [m]
  };
  void take_lines(const InflowSource&, const Terrain&, std::optional<Vec2> way);
  void take_rings(const InflowSource&, const Terrain&, std::optional<Vec2> way);
  bool inside(const Vec2&) const;
  Place place_in_polygon(std::size_t k, double offset);

  double width_ = 0, level_ = 1;
  std::vector<Stretch> stretches_;        ///< of a line
  std::vector<std::vector<Vec2>> rings_;  ///< of a polygon
  Vec2 low_{0, 0}, size_{0, 0}, way_{0, 0};
  std::size_t next_ = 0, tried_ = 0;  ///< of the polygon's sequence
};

}  // namespace sturz
