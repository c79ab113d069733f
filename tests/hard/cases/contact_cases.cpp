// SPDX-License-Identifier: Apache-2.0
// I14: the damper of a Hertz contact pulls while the two separate (A.5). Slow particles must
// come off each other all the same, with the restitution that was set.
#include "tests/hard/cases/cases.hpp"
#include "tests/support/isolated_flight.hpp"

#include <cmath>
#include <utility>

namespace sturz::test {
namespace {

/// Restitution as set, and as the cut of the pull turns it out (table of docs/physics.md A.5).
struct Restitution {
  double set, cut;

  /// Up to where the force changes sign both go the same way: what pulls makes the difference.
  double pulling_share() const { return (cut - set) / (1 + cut); }
};
constexpr Restitution restitutions[] = {{0.3, 0.397}, {0.5, 0.550}, {0.7, 0.718}, {0.9, 0.902}};
constexpr double speeds_m_s[] = {1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1};
constexpr double bound_m_s = 20, radius_m = 0.5;
constexpr int n_starts = 5;  // where in a fine step the two touch first

enum class Place { in_flight, on_the_ground };

/// What the contacts of the scene make of a grain, and how finely they are stepped.
struct Softened {
  ContactPair law;
  double fine_step = 0;

  /// \param partners  2: two particles, 1: a particle and the ground
  explicit Softened(int partners) {
    const GrainMaterial m = softened({}, softest_modulus(contact_density, bound_m_s));
    law.modulus = contact_modulus(m, m);
    law.radius = radius_m / partners;
    law.mass = 4.0 / 3 * std::numbers::pi * contact_density * std::pow(radius_m, 3) / partners;
    fine_step = contact_time_step(m, radius_m, law, bound_m_s);
  }
};

Scene scene_at(Place place, double restitution, bool cut, double friction) {
  Scene scene = free_flight(restitution, friction);
  scene.contacts.speed_bound = bound_m_s;
  scene.contacts.never_pulls = cut;
  scene.contacts.ground_friction = 0;
  if (place == Place::in_flight) return scene;
  scene.gravity = 9.81;
  scene.ground = scene.contacts.on_ground = true;
  return scene;
}

struct Meeting {
  double restitution = 0, pulling_share = 0;
  bool separated = false;
  double energy_gained = 0;  ///< of what the two had, in flight
};

/// Two particles at `speed` towards each other, followed until long after they have touched.
/// \param offset  of their paths, across [m]; \param steps  fine steps in one of the scene
Meeting meet(const Scene& scene, double speed, double offset, double steps, double start) {
  const Softened soft(2);
  const double dt = steps * soft.fine_step, z = scene.ground ? radius_m : 100;
  const double chord = std::sqrt(4 * radius_m * radius_m - offset * offset);
  const double half = 0.5 * (chord + speed * dt * (3 + start));
  Flight f({{{-half, 0, z}, {0.5 * speed, 0, 0}}, {{half, offset, z}, {-0.5 * speed, 0, 0}}},
           scene);
  Meeting m;
  double pushed = 0, pulled = 0, last = -speed;
  const double touching = impact_duration(soft.law, speed * chord / (2 * radius_m));
  for (double t = 0; t < 5 * dt + 3 * touching; t += dt) {
    f.advance(dt);
    const double now = f.velocity(1).x() - f.velocity(0).x();
    (now > last ? pushed : pulled) += std::abs(now - last);
    last = now;
  }
  const Vec3 offset = f.position(1) - f.position(0), separation = f.velocity(1) - f.velocity(0);
  m.restitution = last / speed;
  m.pulling_share = pulled / pushed;
  m.separated = offset.norm() > 2 * radius_m && separation.dot(offset) > 0;
  m.energy_gained = f.energy() / f.state.grains().ledger.kinetic_0 - 1;
  return m;
}

struct Worst {
  double off = 0, pulling = 0, together = 0;

  void add(const Meeting& m, double restitution, double pulling_share) {
    off = std::max(off, std::abs(m.restitution - restitution));
    pulling = std::max(pulling, m.pulling_share - pulling_share);
    together += m.separated ? 0 : 1;
  }
};

/// Head on, with every restitution, speed and start; the impulse is looked at in fine steps, in
/// which nothing but the contact acts between two looks.
Worst head_on(Place place, bool cut) {
  Worst worst;
  for (const Restitution& e : restitutions) {
    const Scene scene = scene_at(place, e.set, cut, 0.5);
    for (const double speed : speeds_m_s)
      for (int k = 0; k < n_starts; ++k) {
        const double start = static_cast<double>(k) / n_starts;
        const double share = cut ? 0 : e.pulling_share();
        worst.add(meet(scene, speed, 0, 1, start), cut ? e.cut : e.set, share);
        Meeting coarse = meet(scene, speed, 0, 37.3, start);
        coarse.pulling_share = 0;
        worst.add(coarse, cut ? e.cut : e.set, share);
      }
  }
  return worst;
}

/// With friction and spins they come off each other, too. \return {together, energy gained}
std::pair<double, double> off_centre() {
  double together = 0, gained = -1;
  for (const Restitution& e : restitutions)
    for (const double speed : speeds_m_s)
      for (const double offset : {0.3, 0.7, 0.95}) {
        const Scene scene = scene_at(Place::in_flight, e.set, false, 0.5);
        const Meeting m = meet(scene, speed, offset, 7.7, 0.4);
        together += m.separated ? 0 : 1;
        gained = std::max(gained, m.energy_gained);
      }
  return {together, gained};
}

/// A particle against the ground as its partner. The ground's distance is a float: below 1e-3 m/s
/// its rounding shows in the restitution, but particles leave at any speed.
Worst against_the_ground() {
  Worst worst;
  const Softened soft(1);
  for (const Restitution& e : restitutions) {
    Scene scene = scene_at(Place::on_the_ground, 0.7, false, 0.5);
    scene.contacts.ground_restitution = e.set;
    scene.gravity = 0;
    for (const double speed : speeds_m_s) {
      const double dt = 9.3 * soft.fine_step;
      Flight f({{{0.3, 0.2, radius_m + 3.4 * speed * dt}, {0, 0, -speed}}}, scene);
      for (double t = 0; t < 5 * dt + 3 * impact_duration(soft.law, speed); t += dt) f.advance(dt);
      const double back = f.velocity(0).z() / speed;
      if (speed > 0.5e-3) worst.off = std::max(worst.off, std::abs(back - e.set));
      worst.together += back > 0 && f.position(0).z() > radius_m ? 0 : 1;
    }
  }
  return worst;
}

}  // namespace

CaseReport slow_contacts_part(States) {
  constexpr double off = 0.008;  // of V12, within the pass: steps of t_c/20
  const Worst flight = head_on(Place::in_flight, false),
              level = head_on(Place::on_the_ground, false);
  const Worst cut = head_on(Place::in_flight, true), ground = against_the_ground();
  const auto [oblique, gained] = off_centre();
  return {
      {at_most("pairs in flight that stay together", flight.together + oblique, 0),
       at_most("pairs on the ground that stay together", level.together, 0),
       at_most("particles that stay on the ground", ground.together, 0),
       at_most("restitution off what was set, in flight", flight.off, off),
       at_most("restitution off what was set, on the ground", level.off, off),
       at_most("restitution off what was set, against the ground, from 1e-3 m/s", ground.off, off),
       at_most("restitution off that of A.5 where the pull is cut", cut.off, off),
       at_most("pulling share of the impulse over that of A.5, in flight", flight.pulling, 0.002),
       at_most("pulling share of the impulse over that of A.5, on the ground", level.pulling,
               0.002),
       at_most("pulling share of the impulse where the pull is cut", cut.pulling, 1e-12),
       at_most("energy gained off centre, of all", gained, 0)},
      2,
      0};
}

}  // namespace sturz::test
