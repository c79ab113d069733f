// SPDX-License-Identifier: Apache-2.0
/// From hydrographs to columns with a time, a place and a volume (decision 0031).
#pragma once

#include "engine/effects/inflow/settings.hpp"
#include "engine/terrain/terrain.hpp"
#include "scenarios/scenario.hpp"
#include "scenarios/scene_inputs.hpp"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace sturz {

/// Critical flow over a width: q = h u with u^2 = g h, so u = (g q)^(1/3); with a speed of its own
/// h = q / u.
struct InflowDepth {
  double thickness_m = 0;  ///< normal to the ground
  double speed_m_s = 0;    ///< along it
};
/// \param per_width q [m^2/s]  \param speed  of the source, NaN: critical; 0: as thick as critical
///                                           flow, at rest
InflowDepth inflow_depth(double per_width, double speed, double gravity);

/// What a member's inflow is, all sources together.
struct InflowPlan {
  std::vector<TimedArrival> columns;  ///< by time
  double volume_m3 = 0;               ///< bulk
  double first_s = 0, last_s = 0;     ///< of their times
  double peak_m3_s = 0;               ///< largest of a source
  double most_thickness_m = 0, most_speed_m_s = 0;
  double narrowest_m = 1e300;                       ///< width of the narrowest source
  double x_m = 0, y_m = 0;                          ///< mean place, by volume
  double top_x_m = 0, top_y_m = 0, top_m = -1e300;  ///< highest surface
  double fall_kg_m = 0;                             ///< mass times elevation
  double energy_j = 0, mass_kg = 0;                 ///< kinetic energy, mass
  bool empty() const { return columns.empty(); }
};

/// Columns of the spacing's size, at the rate of the hydrograph: column k enters when half of it
/// has passed, so that what has entered differs from the integral by half a column at most, and is
/// exact at the end. Places across the source follow the golden ratio by the column's number, so
/// that neighbours in time are none in space, with the jitter of the release.
/// \param density [kg/m^3] of a solid fraction; NaN: the scene's own
/// \throws SetupError where it enters off the known ground, where nothing says which way it flows,
///   or where the spacing is too fine
InflowPlan plan_inflow(const Scenario& numbers, const SceneInputs&, const Terrain& bed,
                       const std::function<double(double solid_fraction)>& density,
                       std::int64_t member);

/// What falling to the lowest ground and its speed give it [J]; 0 for nothing.
double available_energy(const InflowPlan&, double lowest_m);

/// Cells below a source, with one around.
Window cells_below(const InflowSource&, const Grid& whole);
/// Height of surface and speed over the ground at the source's peak, the largest of all members
/// [m].
double greatest_head(const InflowSpec&, const InflowSource&);

/// Volume, duration, peak and number of columns in words.
std::string inflow_text(const Scenario&, const InflowPlan&);

}  // namespace sturz
