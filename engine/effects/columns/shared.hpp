// SPDX-License-Identifier: Apache-2.0
/// What the passes of depth-averaged columns share.
#pragma once

#include "engine/effects/columns/settings.hpp"
#include "engine/effects/columns/walls.hpp"
#include "engine/effects/fields.hpp"
#include "engine/effects/step.hpp"
#include "engine/neighbors/column_cells.hpp"

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

namespace sturz {

struct ColumnFlow {
  std::size_t set;  ///< index in State::sets
  DepthAveragedSettings settings;
  ColumnCells cells;
  ColumnWalls walls;
  std::vector<float> results[7];    ///< of the sweep, by record
  std::vector<double> strain_rate;  ///< div v of each column [1/s]; empty without a mixture
  double start_dt = 1e-3;           ///< of the first step [s]
  double fastest_wave = 0;          ///< largest sqrt(K g_n h) / h_s [1/s]
  double fastest_approach = 0;      ///< largest relative speed of neighbours / h_s [1/s]

  /// Column i beside a wall.
  ColumnAtWall at_wall(ParticleSet&, std::size_t i) const;

  ColumnFlow(std::size_t set_index, DepthAveragedSettings s)
      : set(set_index), settings(std::move(s)) {}

  ColumnSweepOutput output() {
    return {results[0].data(), results[1].data(), results[2].data(), results[3].data(),
            results[4].data(), results[5].data(), results[6].data()};
  }
  int zone_of(const Domain& domain, const ParticleSet& p, std::size_t i) const {
    if (!settings.zones.any()) return 0;
    double x = p.x[i], y = p.y[i], z = 0;
    domain.wrap(x, y, z);
    return settings.zones.at(x, y);
  }
};

/// The ground under a column, as its field "ground" keeps it.
struct ColumnGround {
  double east, north, curvature_ee, curvature_en, curvature_nn;

  Vec3 normal() const { return upward_normal(east, north); }
  /// The slopes a horizontal displacement (x, y) farther on.
  ColumnGround ahead(double x, double y) const {
    return {east + curvature_ee * x + curvature_en * y, north + curvature_en * x + curvature_nn * y,
            curvature_ee, curvature_en, curvature_nn};
  }
};

/// The arrays of field "ground", looked up once per pass.
struct GroundColumns {
  double* component[5];

  explicit GroundColumns(ParticleSet& p) {
    auto& ground = p.components(fields::ground);
    for (int k = 0; k < 5; ++k) component[k] = ground[k].data();
  }
  ColumnGround operator[](std::size_t i) const {
    return {component[0][i], component[1][i], component[2][i], component[3][i], component[4][i]};
  }
  void set(std::size_t i, const CurvedSurface& g) const {
    component[0][i] = g.east, component[1][i] = g.north;
    component[2][i] = g.curvature_ee, component[3][i] = g.curvature_en,
    component[4][i] = g.curvature_nn;
  }
};

/// A velocity in plain numbers, for loops that the compiler puts side by side.
struct Velocity {
  double x, y, z;

  double norm2() const { return x * x + y * y + z * z; }
  /// What lies in the plane with these slopes: v - (v . n) n.
  Velocity in_plane(double east, double north) const {
    const double off = (z - east * x - north * y) / (1 + east * east + north * north);
    return {x + east * off, y + north * off, z - off};
  }
  /// Turned into the plane with these slopes, its length kept: the ground's reaction does no work.
  Velocity turned(double east, double north) const {
    const Velocity along = in_plane(east, north);
    const double length2 = along.norm2(), factor = length2 > 0 ? norm2() / length2 : 0;
    const double scale = std::sqrt(factor);
    return {along.x * scale, along.y * scale, along.z * scale};
  }
};

/// Puts column i on the ground and keeps what lies below it.
/// \return false off the known ground
bool look_up_ground(const State&, ParticleSet&, const GroundColumns&, std::size_t i);

/// A kick at t_n leads from the middle of the last step to the middle of this one.
inline double kick_interval(const State& s, double dt) { return 0.5 * (s.previous_dt + dt); }

/// Puts columns from `first` on that entered during the run on the ground, without neighbours yet.
void enter_columns(const State&, ColumnFlow&, MovingSet&, std::size_t first);

void add_column_pressure(Step&, const std::shared_ptr<ColumnFlow>&);  ///< cells, gather, sweep
void add_column_motion(Step&, const std::shared_ptr<ColumnFlow>&);    ///< bed, drift

}  // namespace sturz
