// SPDX-License-Identifier: Apache-2.0
/// What the passes of depth-averaged columns share.
#pragma once

#include "engine/effects/columns/settings.hpp"
#include "engine/effects/columns/walls.hpp"
#include "engine/effects/fields.hpp"
#include "engine/effects/step.hpp"
#include "engine/neighbors/column_cells.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace sturz {

struct ColumnFlow {
  std::size_t set;  ///< index in State::sets
  DepthAveragedSettings settings;
  ColumnCells cells;
  ColumnWalls walls;
  std::vector<float> results[7];    ///< of the sweep, by record
  std::vector<double> share,        ///< of the ground's slope that pressure knows, by column [-]
      lateral_gravity;              ///< pressure over density and thickness where K = 1 [m/s^2]
  std::vector<double> strain_rate;  ///< div v of each column [1/s]; empty without a mixture
  bool steep = false;               ///< some share is under one
  /// Of cells that a second set of columns shares; null: cells around this set alone.
  const ColumnFrame* frame = nullptr;
  /// Thickness that the drag of the bed acts over, of each column [m]; empty: its own.
  std::vector<double> bed_thickness;
  /// Impulses from another set come between the start of a step and the bed.
  bool has_exchange = false;
  /// Columns with ids from this one on stand for the area that they were released on until this
  /// step: for so long support radii find what lies around them.
  static constexpr std::size_t settling_steps = 10;
  std::uint32_t settle_from = 0;
  std::size_t settle_until = settling_steps;
  double start_dt = 1e-3;           ///< of the first step [s]
  double fastest_wave = 0;          ///< largest sqrt(K g_n h) / h_s [1/s]
  double fastest_approach = 0;      ///< largest relative speed of neighbours / h_s [1/s]
  double release_thickness = 0;     ///< largest vertical thickness at release [m]
  double release_top = -1e300;      ///< energy head of the release: surface and v^2/2g [m]
  double highest_surface = -1e300;  ///< over the run so far [m]

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
  /// What lies below column i, with the numbers of rasters where there are any. \param own is
  /// written where the bed is no zone's
  const BasalResistance& bed_of(const Domain& domain, const ParticleSet& p, std::size_t i,
                                BasalResistance& own) const {
    const int zone = zone_of(domain, p, i);
    const BasalResistance& bed = settings.bed[static_cast<std::size_t>(zone)];
    if (!settings.rasters.any()) return bed;
    double x = p.x[i], y = p.y[i], z = 0;
    domain.wrap(x, y, z);
    own = settings.rasters.over(bed, zone, x, y);
    return own;
  }
  /// K of column i.
  EarthPressure earth_pressure_of(const Domain& domain, const ParticleSet& p, std::size_t i) const {
    if (!settings.rasters.any())
      return settings.earth_pressure[static_cast<std::size_t>(zone_of(domain, p, i))];
    BasalResistance own;
    return settings.active_passive ? settings.earth_pressure_over(bed_of(domain, p, i, own))
                                   : EarthPressure();
  }
  /// Share of the thrust that internal friction takes of column i over that bed.
  double spent_over(const Domain& domain, const ParticleSet& p, std::size_t i,
                    const BasalResistance& bed) const {
    if (!settings.rasters.any())
      return settings.spent_inside.empty()
                 ? 0
                 : settings.spent_inside[static_cast<std::size_t>(zone_of(domain, p, i))];
    if (!(settings.spent_share > 0)) return 0;
    return settings.spent_share * std::max(0.0, 1 - settings.earth_pressure_over(bed).active);
  }
};

/// The ground under a column, as its field "ground" keeps it.
struct ColumnGround {
  double east, north, curvature_ee, curvature_en, curvature_nn;

  Vec3 normal() const { return upward_normal(east, north); }
  double slope2() const { return east * east + north * north; }
  /// The slopes a horizontal displacement (x, y) farther on.
  ColumnGround ahead(double x, double y) const {
    return {east + curvature_ee * x + curvature_en * y, north + curvature_en * x + curvature_nn * y,
            curvature_ee, curvature_en, curvature_nn};
  }
};

/// Share of the ground's slope that pressure knows: one up to 40 degrees, none from 55 on (ADR
/// 0026).
inline double known_share(double slope2) {
  constexpr double gentle = 0.70408819, wall = 2.0396072;  // tan^2 of 40 and 55 degrees
  double t = (slope2 - gentle) * (1 / (wall - gentle));
  t = t < 0 ? 0 : t > 1 ? 1 : t;
  return 1 - t * t * (3 - 2 * t);
}

/// How many times as thick a column is along the normal of the true ground as along that of the
/// ground that pressure knows; exactly one on gentle ground.
inline double thinned(double share, double slope2) {
  return share < 1 ? std::sqrt((1 + share * share * slope2) / (1 + slope2)) : 1.0;
}

/// K of a column: walls bear what K would add or take.
inline double known_earth_pressure(double k, double share) {
  return share < 1 ? 1 + share * (k - 1) : k;
}

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

/// Where gravity, pressure and bed alone would lead the columns in this step; all [n].
struct ColumnForecast {
  std::vector<double> vx, vy, vz;  ///< [m/s]
  /// Of columns that the bed holds: how much more it could hold [m/s]; else zero.
  std::vector<double> spare;
};
void forecast(const State&, MovingSet&, const ColumnFlow&, double dt, ColumnForecast&);

/// Puts columns from `first` on that entered during the run on the ground, without neighbours yet.
void enter_columns(const State&, ColumnFlow&, MovingSet&, std::size_t first);

/// Mass at rest under a free surface steeper than `limit` [-], and the steepest one.
struct SteepRest {
  double share = 0, steepest = 0;  ///< of the whole mass [-]; slope [-]
};
SteepRest steep_rest(const State&, const ColumnFlow&, double limit);

/// Says what no mass of grains does: a surface above the energy head of the release, a rest steeper
/// than friction allows.
void warn_of_implausible(const State&, const ColumnFlow&, std::vector<std::string>&);
/// Says that a mixture lies still only as long as its pores pull: it dilated, and water flows back.
void warn_of_suction(const State&, const ColumnFlow&, std::vector<std::string>&);

void add_column_pressure(Step&, const std::shared_ptr<ColumnFlow>&);  ///< cells, gather, sweep
void add_column_bed(Step&, const std::shared_ptr<ColumnFlow>&);       ///< gravity and bed
void add_column_motion(Step&, const std::shared_ptr<ColumnFlow>&);    ///< drift

}  // namespace sturz
