// SPDX-License-Identifier: Apache-2.0
#include "engine/effects/discrete/planes.hpp"

#include <algorithm>

namespace sturz {

GrainPlanes::GrainPlanes(const DiscreteSettings& c) : settings_(c) {
  law_.modulus = contact_modulus(c.material, c.material);
  law_.shear_modulus = contact_shear_modulus(c.material, c.material);
  law_.damping = damping_ratio(c.bed_restitution);
}

void GrainPlanes::start(const State& s, const MovingSet& p) {
  kept_.resize(1 + s.domain.walls.size());
  for (auto& plane : kept_)
    if (plane.size() != p.n_created()) plane.resize(p.n_created());
}

GrainPlanes::Roughness GrainPlanes::ground(const Domain& domain, const MovingSet& p,
                                           std::size_t i) const {
  double x = p.x[i], y = p.y[i], z = 0;
  domain.wrap(x, y, z);
  const int zone = settings_.zones.at(x, y);
  BasalResistance bed = settings_.bed[static_cast<std::size_t>(zone)];
  if (settings_.rasters.any()) bed = settings_.rasters.over(bed, zone, x, y);
  const double friction = bed.effective_friction();
  return {friction, settings_.bed_rolling_friction.value_or(friction), bed.cohesion_pa};
}

PlaneForce GrainPlanes::press(const State& s, const MovingSet& p, const GrainMotion& g,
                              std::size_t i) {
  PlaneForce out;
  const std::uint32_t id = p.id[i];
  const BoundarySupport& b = p.boundary;
  Kept& ground_memory = kept_[0][id];
  if (p.fate[i] == Fate::stays && b.distance[i] < g.radius) {
    Vec3 n(b.nx[i], b.ny[i], b.nz[i]);
    n.normalize();  // of single precision
    press_on(law_, ground(s.domain, p, i), {b.distance[i], n}, g, s.previous_dt, ground_memory,
             out);
  } else {
    ground_memory.touch.open();
    ground_memory.known = true;
  }
  for (std::size_t k = 0; k < s.domain.walls.size(); ++k) {
    const Wall& wall = s.domain.walls[k];
    Kept& memory = kept_[k + 1][id];
    const double height = (g.position - wall.point).dot(wall.normal);
    if (s.time < wall.remove_at_s && height < g.radius)
      press_on(law_,
               {wall.friction_coefficient,
                settings_.bed_rolling_friction.value_or(wall.friction_coefficient), 0},
               {height, wall.normal}, g, s.previous_dt, memory, out);
    else
      memory.touch.open();
    memory.known = true;
  }
  return out;
}

/// An overlap that grew by more than the grain came down is a jump of the ground's distance (an
/// edge of a bilinear cell): that part carries nothing until it has opened again, so it sets no
/// energy free.
void GrainPlanes::press_on(const ContactPair& clean, const Roughness& rough, const Plane& plane,
                           const GrainMotion& g, double since, Kept& kept, PlaneForce& out) {
  TouchMemory& memory = kept.touch;
  const double overlap = g.radius - plane.height, before = memory.overlap;
  const double room = 1e-3 * g.radius + 1.5 * since * std::max(0.0, -g.velocity.dot(plane.normal));
  memory.close_to(overlap);
  if (!kept.known)
    memory.unloaded = overlap;
  else
    memory.unloaded += std::max(0.0, overlap - before - room);
  kept.known = true;

  ContactPair law = clean;
  law.radius = g.radius;
  law.mass = g.mass;
  law.friction = rough.friction;
  const double loaded = memory.overlap - memory.unloaded;
  if (rough.cohesion_pa > 0 && loaded > 0) {
    const double pressed = 4.0 / 3 * law.modulus * std::sqrt(law.radius * loaded) * loaded;
    law.friction += rough.cohesion_pa * std::numbers::pi * g.radius * g.radius / pressed;
  }
  const Vec3 arm = -plane.height * plane.normal;
  TouchMotion m;
  m.velocity = g.ahead + g.spin_ahead.cross(arm);
  m.slip = since * (g.velocity + g.spin.cross(arm));
  m.spin = g.spin_ahead;
  m.roll = since * g.spin;
  const TouchForce f =
      press_grains(law, {rough.rolling, g.rolling_inertia()}, plane.normal, m, memory);
  out.force += f.force;
  out.torque += arm.cross(f.force) + f.moment;
  out.stored += memory.stored;
  out.sliding += f.sliding;
  out.damping += f.damping;
  out.overlap = std::max(out.overlap, memory.loaded / g.radius);
}

std::size_t GrainPlanes::bytes() const {
  std::size_t total = 0;
  for (const auto& plane : kept_) total += plane.capacity() * sizeof(Kept);
  return total;
}

}  // namespace sturz
