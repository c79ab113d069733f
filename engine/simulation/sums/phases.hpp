// SPDX-License-Identifier: Apache-2.0
/// Fronts, thicknesses and masses of grains and liquid that move at two velocities.
#pragma once

#include "engine/core/sum.hpp"
#include "engine/effects/state.hpp"
#include "engine/simulation/member_result.hpp"
#include "engine/simulation/parts.hpp"

#include <algorithm>
#include <cmath>

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

/// Farthest cell from the release's centre where the layer passes the limit and the flow came [m],
/// and the layer's largest value [m].
struct PhaseExtent {
  double runout = 0, thickest = 0;
};
inline PhaseExtent extent_of(const MemberResult& r, PeakLayer layer, const ReleaseFacts& release,
                             double limit_m) {
  const Window& w = r.window;
  PhaseExtent out;
  for (int row = 0; row < w.n_rows; ++row)
    for (int col = 0; col < w.n_cols; ++col) {
      const std::size_t k = static_cast<std::size_t>(row) * w.n_cols + col;
      const double h = r.layer(layer)[k];
      out.thickest = std::max(out.thickest, h);
      if (!(h > limit_m) || std::isnan(r.layer(PeakLayer::arrival)[k])) continue;
      out.runout = std::max(out.runout, std::hypot(r.grid.x_center(w.col0 + col) - release.x_m,
                                                   r.grid.y_center(w.row0 + row) - release.y_m));
    }
  return out;
}

/// What a member of two phases keeps of them; after the peak maps are written.
inline void write_phases(const State& s, const SimulationParts& parts, MemberResult& r) {
  if (!parts.peaks.settings().by_set) return;
  MemberScalars& m = r.scalars;
  const double limit = parts.peaks.settings().runout_limit_m;
  const PhaseExtent solid = extent_of(r, PeakLayer::solid, parts.facts.release, limit);
  const PhaseExtent liquid = extent_of(r, PeakLayer::liquid, parts.facts.release, limit);
  m.solid_runout_m = solid.runout, m.max_solid_thickness_m = solid.thickest;
  m.liquid_runout_m = liquid.runout, m.max_liquid_thickness_m = liquid.thickest;
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
