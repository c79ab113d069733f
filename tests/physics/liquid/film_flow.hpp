// SPDX-License-Identifier: Apache-2.0
/// A film of liquid that runs down a slope without end, as half a plane channel of Morris et al.
/// (1997): their length, viscosity and body force.
#pragma once

#include "tests/physics/verification.hpp"
#include "tests/support/liquid/liquid_scene.hpp"

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

namespace sturz::test {

struct FilmFlow {
  static constexpr double depth = 5e-4;      ///< H, half of their channel [m]
  static constexpr double density = 1000;    ///< [kg/m^3]
  static constexpr double viscosity = 1e-6;  ///< nu [m^2/s]
  static constexpr double pull = 1e-4;       ///< g sin(theta) [m/s^2]
  static constexpr double slope = 0.2;
  static constexpr int period = 6;  ///< spacings along both ways

  int layers = 20;
  HerschelBulkley law{0, density* viscosity, 1};
  LiquidBed bed = LiquidBed::no_slip;
  double sound_speed = 0.15;  ///< the relaxation time K/G is then 0.2 ms
  bool level = false;         ///< the ground is, and nothing pulls

  double spacing() const { return depth / layers; }
  static double bed_stress() { return density * pull * depth; }
  static double free_speed() { return pull * depth * depth / (2 * viscosity); }

  LiquidBox box() const {
    LiquidBox b;
    const double dx = spacing(), tilt = level ? 0 : slope;
    const double cosine = 1 / std::hypot(1, tilt), sine = tilt * cosine;
    b.spacing = dx;
    b.n = {period, period, layers};
    b.slope = tilt;
    b.along_slope = true;
    b.gravity = pull * std::hypot(1, slope) / slope;
    b.half_width = 20 * dx;
    b.settings.law = law;
    b.settings.reference_density = density;
    b.settings.sound_speed = sound_speed;
    b.bed = bed;
    b.domain.x = {true, 0, period * dx * cosine, -period * dx * sine};
    b.domain.y = {true, 0, period * dx, 0};
    return b;
  }

  /// Height above the bed and speed along it of a particle.
  struct Place {
    double height, speed;
  };
  Place place(const ParticleSet& p, std::size_t i) const {
    const double tilt = level ? 0 : slope, cosine = 1 / std::hypot(1, tilt), sine = tilt * cosine;
    return {p.z[i] * cosine + p.x[i] * sine, p.vx[i] * cosine - p.vz[i] * sine};
  }
  double mean_speed(const ParticleSet& p) const {
    double sum = 0;
    for (std::size_t i = 0; i < p.size(); ++i) sum += place(p, i).speed;
    return sum / static_cast<double>(p.size());
  }
  /// sqrt(sum (u - u_exact)^2 / sum u_exact^2) over the particles. \param exact  of height [m/s]
  double profile_error(const ParticleSet& p, const std::function<double(double)>& exact) const {
    double error = 0, size = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
      const Place at = place(p, i);
      const double u = exact(at.height);
      error += (at.speed - u) * (at.speed - u), size += u * u;
    }
    return std::sqrt(error / size);
  }
};

/// A line for the table: asserted where it has a tolerance.
inline void put(const Line& line) {
  if (std::isnan(line.tolerance))
    record(line);
  else
    expect_within(line);
}

/// Velocities are those of the last half step.
inline double velocity_time(const State& s) { return s.time - 0.5 * s.previous_dt; }

inline void advance_to(HandMade& made, double time) {
  while (made.state.time < time) made.advance();
}

}  // namespace sturz::test
