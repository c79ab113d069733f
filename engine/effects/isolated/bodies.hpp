// SPDX-License-Identifier: Apache-2.0
/// Spheres in contact, stepped finely on their own: velocity Verlet over a handful of contacts.
#pragma once

#include "engine/core/vec.hpp"
#include "engine/laws/hertz_mindlin.hpp"

#include <cstdint>
#include <limits>
#include <vector>

namespace sturz {

struct IsolatedBody {
  Vec3 start{0, 0, 0};  ///< where the step began [m]
  Vec3 position{0, 0, 0}, velocity{0, 0, 0}, spin{0, 0, 0};
  Vec3 force{0, 0, 0}, torque{0, 0, 0};
  Vec3 velocity_ahead{0, 0, 0}, spin_ahead{0, 0, 0};  ///< predicted for the dampers
  double radius = 0, mass = 0;
  std::uint32_t particle = 0;  ///< in storage order
  std::uint32_t id = 0;

  double inertia() const { return 0.4 * mass * radius * radius; }
};

/// Between two bodies, or of one with the ground's plane.
struct IsolatedContact {
  static constexpr std::uint32_t ground = std::numeric_limits<std::uint32_t>::max();

  std::uint32_t a = 0, b = ground;  ///< bodies
  Vec3 image{0, 0, 0};              ///< to add to b's position [m]
  Vec3 normal{0, 0, 1};             ///< into a
  double height = 0;                ///< of a's start above the ground's plane [m]
  ContactPair law;
  Vec3 history{0, 0, 0};  ///< tangential spring [m]
  double overlap = 0;     ///< of the spheres [m]
  double unloaded = 0;    ///< part of it that no approach built up, carries nothing [m]
  double stored = 0;      ///< elastic energy [J]

  double loaded() const { return overlap - unloaded; }
};

/// Overlap and normal of a contact where its bodies are now.
void measure(IsolatedContact&, const std::vector<IsolatedBody>&);

/// n fine steps that add up to dt. Momentum and angular momentum of pairs are kept to rounding.
void step_bodies(std::vector<IsolatedBody>&, std::vector<IsolatedContact>&, double dt, int n);

}  // namespace sturz
