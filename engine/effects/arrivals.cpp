// SPDX-License-Identifier: Apache-2.0
#include "engine/effects/arrivals.hpp"

#include "engine/effects/fields.hpp"

#include <algorithm>

namespace sturz {
namespace {

void place(MovingSet& p, std::size_t i, const Arrival& a) {
  p.x[i] = a.position.x(), p.y[i] = a.position.y(), p.z[i] = a.position.z();
  p.vx[i] = a.velocity.x(), p.vy[i] = a.velocity.y(), p.vz[i] = a.velocity.z();
  p.mass[i] = a.mass;
  p.motion.max_speed = std::max(p.motion.max_speed, a.velocity.norm());
  (a.released ? p.ledger.released_mass : p.ledger.added_mass) += a.mass;
  p.ledger.added_volume += a.volume;
  p.ledger.added_momentum += a.mass * a.velocity;
  p.ledger.added_energy += 0.5 * a.mass * a.velocity.squaredNorm();
}

}  // namespace

void mark_start(const Domain& domain, MovingSet& p, std::size_t first) {
  p.start_x.resize(p.n_created());
  p.start_y.resize(p.n_created());
  for (std::size_t i = first; i < p.size(); ++i) {
    p.start_x[p.id[i]] = p.x[i];
    p.start_y[p.id[i]] = p.y[i];
  }
  if (!domain.x.active && !domain.y.active) return;
  p.wrapped_x.resize(p.n_created(), 0);
  p.wrapped_y.resize(p.n_created(), 0);
}

std::size_t enter_arrivals(const Domain& domain, MovingSet& p) {
  const std::size_t first = p.grow(p.arrivals.size());
  for (std::size_t k = 0; k < p.arrivals.size(); ++k) place(p, first + k, p.arrivals[k]);
  p.entering.swap(p.arrivals);
  p.arrivals.clear();
  if (Field* before = p.find(fields::velocity_before))
    for (std::size_t i = first; i < p.size(); ++i)
      before->component[0][i] = p.vx[i], before->component[1][i] = p.vy[i],
      before->component[2][i] = p.vz[i];
  mark_start(domain, p, first);
  for (auto* a : {&p.ax, &p.ay, &p.az}) a->resize(p.size(), 0.0f);
  p.order_changed = true;
  return first;
}

}  // namespace sturz
