// SPDX-License-Identifier: Apache-2.0
/// Grains on what does not move: the ground below, as a plane, and the domain's analytic walls.
#pragma once

#include "engine/effects/discrete/settings.hpp"
#include "engine/effects/discrete/touch.hpp"
#include "engine/effects/state.hpp"

#include <cmath>
#include <numbers>
#include <vector>

namespace sturz {

inline double sphere_radius(double mass, double density) {
  return std::cbrt(0.75 * mass / (std::numbers::pi * density));
}
inline double sphere_mass(double radius, double density) {
  return 4.0 / 3 * std::numbers::pi * density * radius * radius * radius;
}

/// One grain at the start of a step; `ahead` is predicted for its position.
struct GrainMotion {
  Vec3 position{0, 0, 0}, velocity{0, 0, 0}, ahead{0, 0, 0};
  Vec3 spin{0, 0, 0}, spin_ahead{0, 0, 0};
  double radius = 0, mass = 0;

  /// About a point of its surface [kg m^2].
  double rolling_inertia() const { return 1.4 * mass * radius * radius; }
};

/// What all planes together do to one grain.
struct PlaneForce {
  Vec3 force{0, 0, 0}, torque{0, 0, 0};
  double stored = 0, sliding = 0, damping = 0;  ///< [J], [J], [W]
  double overlap = 0;                           ///< greatest, over the radius
};

class GrainPlanes {
 public:
  explicit GrainPlanes(const DiscreteSettings&);

  /// Room for the grains and walls of a step.
  void start(const State&, const MovingSet&);
  /// Presses grain i on the ground and on every wall that stands. Grains off the known ground fall.
  PlaneForce press(const State&, const MovingSet&, const GrainMotion&, std::size_t i);
  std::size_t bytes() const;

 private:
  /// Friction of one place.
  struct Roughness {
    double friction = 0, rolling = 0;
    double cohesion_pa = 0;
  };
  struct Plane {
    double height = 0;  ///< of the grain's centre above it [m]
    Vec3 normal{0, 0, 1};
  };
  struct Kept {
    TouchMemory touch;
    bool known = false;  ///< the grain has been looked at on this plane
  };

  Roughness ground(const Domain&, const MovingSet&, std::size_t i) const;
  static void press_on(const ContactPair& clean, const Roughness&, const Plane&, const GrainMotion&,
                       double since, Kept&, PlaneForce& out);

  DiscreteSettings settings_;
  ContactPair law_;
  std::vector<std::vector<Kept>> kept_;  ///< by plane, ground first, and id
};

}  // namespace sturz
