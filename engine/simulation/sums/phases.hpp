// SPDX-License-Identifier: Apache-2.0
/// Fronts, thicknesses and masses of grains and liquid that move at two velocities.
#pragma once

#include "engine/core/sum.hpp"
#include "engine/effects/state.hpp"
#include "engine/simulation/member_result.hpp"
#include "engine/simulation/parts.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace sturz {

/// Farthest that a particle of the set is from its start, what left included [m].
inline double front_of(const MovingSet& p) {
  double far2 = 0;
  const auto look = [&](std::uint32_t id, double x, double y) {
    double dx = x - p.start_x[id], dy = y - p.start_y[id];
    if (!p.wrapped_x.empty()) dx += p.wrapped_x[id], dy += p.wrapped_y[id];
    far2 = std::max(far2, dx * dx + dy * dy);
  };
  for (std::size_t i = 0; i < p.size(); ++i) look(p.id[i], p.x[i], p.y[i]);
  for (const Departure& gone : p.departures) look(gone.id, gone.x, gone.y);
  return std::sqrt(far2);
}

/// (kept + lost - released) / released mass of the set; 0 of an empty one.
inline double mass_error_of(const MovingSet& p) {
  if (!(p.ledger.released_mass > 0)) return 0;
  Sum kept;
  for (const double m : p.mass) kept.add(m);
  return (kept.value() + p.ledger.lost_mass - p.ledger.released_mass) / p.ledger.released_mass;
}

/// What the maps of one phase say of it.
struct PhaseExtent {
  double runout = 0;        ///< from the release's centre to the farthest cell that it reached [m]
  double reached_area = 0;  ///< [m2]
};
inline PhaseExtent extent_of(const MemberResult& r, PeakLayer arrival,
                             const ReleaseFacts& release) {
  const Window& w = r.window;
  PhaseExtent out;
  for (int row = 0; row < w.n_rows; ++row)
    for (int col = 0; col < w.n_cols; ++col) {
      const std::size_t k = static_cast<std::size_t>(row) * w.n_cols + col;
      if (std::isnan(r.layer(arrival)[k])) continue;
      out.reached_area += r.grid.cell_m * r.grid.cell_m;
      out.runout = std::max(out.runout, std::hypot(r.grid.x_center(w.col0 + col) - release.x_m,
                                                   r.grid.y_center(w.row0 + row) - release.y_m));
    }
  return out;
}

inline double largest_of(const MemberResult& r, PeakLayer layer) {
  const std::vector<float>& all = r.layer(layer);
  return all.empty() ? 0 : *std::max_element(all.begin(), all.end());
}

/// Masses that left the known ground, which decide whether the results of a phase are cut off.
inline void write_phase_losses(const State& s, MemberScalars& m) {
  const auto share = [](const Ledger& l) {
    return l.brought_mass() > 0 ? l.lost_mass / l.brought_mass() : 0;
  };
  const Ledger &solid = s.sets[0].ledger, &liquid = s.sets[1].ledger;
  m.solid_lost_mass_kg = solid.lost_mass, m.solid_lost_fraction = share(solid);
  m.liquid_lost_mass_kg = liquid.lost_mass, m.liquid_lost_fraction = share(liquid);
}

/// " (3 % of the grains, 21 % of the liquid)"; nothing where they are not told apart.
inline std::string lost_by_phase(const MemberScalars& m) {
  if (std::isnan(m.solid_lost_fraction)) return {};
  const auto percent = [](double share) {
    const long whole = std::lround(100 * share);
    return (share > 0 && whole == 0 ? "under 1" : std::to_string(whole)) + std::string(" %");
  };
  return " (" + percent(m.solid_lost_fraction) + " of the grains, " +
         percent(m.liquid_lost_fraction) + " of the liquid)";
}

/// What a member of two phases keeps of them; after the peak maps are written.
inline void write_phases(const State& s, const SimulationParts& parts, MemberResult& r) {
  if (!parts.peaks.settings().by_set) return;
  MemberScalars& m = r.scalars;
  write_phase_losses(s, m);
  const PhaseExtent solid = extent_of(r, PeakLayer::solid_arrival, parts.facts.release);
  const PhaseExtent liquid = extent_of(r, PeakLayer::liquid_arrival, parts.facts.release);
  m.solid_runout_m = solid.runout, m.solid_reached_area_m2 = solid.reached_area;
  m.liquid_runout_m = liquid.runout, m.liquid_reached_area_m2 = liquid.reached_area;
  m.max_solid_thickness_m = largest_of(r, PeakLayer::solid);
  m.max_liquid_thickness_m = largest_of(r, PeakLayer::liquid);
  m.max_solid_speed_m_s = largest_of(r, PeakLayer::solid_speed);
  m.max_liquid_speed_m_s = largest_of(r, PeakLayer::liquid_speed);
  m.max_solid_energy_j_m2 = largest_of(r, PeakLayer::solid_energy);
  m.max_liquid_energy_j_m2 = largest_of(r, PeakLayer::liquid_energy);
  m.max_solid_pressure_pa = largest_of(r, PeakLayer::solid_pressure);
  m.max_liquid_pressure_pa = largest_of(r, PeakLayer::liquid_pressure);
  m.solid_front_travel_m = front_of(s.sets[0]);
  m.liquid_front_travel_m = front_of(s.sets[1]);
  const Ledger all = s.ledger();
  const double energy = all.available_energy();
  m.drag_loss_fraction = energy > 0 ? all.drag_loss / energy : 0;
  m.drag_raised_fraction = s.time > 0 ? all.drag_raised / (all.brought_mass() * s.time) : 0;
  m.solids_error = mass_error_of(s.sets[0]);
  m.water_error = mass_error_of(s.sets[1]);
}

}  // namespace sturz
