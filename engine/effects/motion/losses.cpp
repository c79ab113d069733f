// SPDX-License-Identifier: Apache-2.0
#include "engine/effects/motion/losses.hpp"

#include "engine/effects/fields.hpp"

#include <cmath>

namespace sturz {
namespace {

/// At the start of the step, as the gather pass left it.
Vec3 start_velocity(const ParticleSet& p, std::size_t i) {
  const Field* before = p.find(fields::velocity_before);
  if (!before) return {p.vx[i], p.vy[i], p.vz[i]};
  return {before->component[0][i], before->component[1][i], before->component[2][i]};
}

/// Where the last step found it. One that was never on known ground is accounted for where it is.
Departure departure(const State& s, const MovingSet& p, std::size_t i) {
  const Vec3 v = start_velocity(p, i);
  // Its velocity has changed a little since, so one step back may not be quite enough.
  for (const double steps : {1.0, 2.0, 4.0}) {
    const double dt = steps * s.previous_dt;
    double x = p.x[i] - dt * v.x(), y = p.y[i] - dt * v.y(), z = p.z[i] - dt * v.z();
    s.domain.wrap(x, y, z);
    if (s.terrain.inside(x, y)) return {p.id[i], x, y, z, p.mass[i]};
  }
  return {p.id[i], p.x[i], p.y[i], p.z[i], p.mass[i]};
}

}  // namespace

void remove_outside(const State& s, MovingSet& p, std::vector<std::uint8_t>& keep, double dt) {
  keep.resize(p.size());
  std::size_t n_kept = 0, n_listed = 0;
  const Field *solids = p.find(fields::solids_volume), *water = p.find(fields::water_volume);
  for (std::size_t i = 0; i < p.size(); ++i) {
    keep[i] = !s.leaves(p, i);
    n_kept += keep[i];
    n_listed += keep[i] && i < p.n_listed;
    if (keep[i]) continue;
    p.corrupt = p.corrupt || !std::isfinite(p.x[i] + p.y[i] + p.z[i]);
    const bool taken = p.fate[i] == Fate::taken;
    if (p.fate[i] == Fate::off_terrain) p.departures.push_back(departure(s, p, i));
    const double energy = 0.5 * p.mass[i] * start_velocity(p, i).squaredNorm();
    const Vec3 last = p.mass[i] * dt * Vec3(p.ax[i], p.ay[i], p.az[i]);  // its partners have theirs
    p.ledger.stress_impulse += last;
    p.ledger.stress_impulse_scale += last.norm();
    (taken ? p.ledger.taken_mass : p.ledger.lost_mass) += p.mass[i];
    if (solids) p.ledger.lost_solids += solids->component[0][i];
    if (water) p.ledger.lost_water += water->component[0][i];
    (taken ? p.ledger.taken_energy : p.ledger.lost_energy) += energy;
  }
  if (n_kept == p.size()) return;
  for (auto* a : {&p.ax, &p.ay, &p.az}) {
    std::size_t n = 0;
    for (std::size_t i = 0; i < keep.size(); ++i)
      if (keep[i]) (*a)[n++] = (*a)[i];
    a->resize(n);
  }
  p.compact(keep);
  p.n_listed = n_listed;
  p.order_changed = true;
}

double stop_at_domain_boundary(const State& s, MovingSet& p, std::size_t i, double dt) {
  const double vx = p.vx[i], vy = p.vy[i];
  auto known = [&](double ux, double uy) {
    double x = p.x[i] + dt * ux, y = p.y[i] + dt * uy, z = p.z[i];
    s.domain.wrap(x, y, z);
    return s.terrain.inside(x, y);
  };
  if (known(p.vx[i], p.vy[i])) return 0;
  if (known(p.vx[i], 0)) {
    p.vy[i] = 0;
  } else if (known(0, p.vy[i])) {
    p.vx[i] = 0;
  } else {
    p.vx[i] = p.vy[i] = 0;
  }
  const Vec3 start = start_velocity(p, i);
  return 0.5 * ((vx - p.vx[i]) * (start.x() + p.vx[i]) + (vy - p.vy[i]) * (start.y() + p.vy[i]));
}

}  // namespace sturz
