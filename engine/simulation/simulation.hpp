// SPDX-License-Identifier: Apache-2.0
/// One member from t = 0 to its stop.
#pragma once

#include "engine/simulation/member_result.hpp"

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace sturz {

struct SimulationParts;  // what assemble puts together; engine/simulation/parts.hpp

/// A running member's state in a few numbers.
struct Progress {
  double time_s = 0, end_time_s = 0;
  double front_travel_m = 0;  ///< farthest horizontal displacement of a particle
  double kinetic_energy_j = 0;
  double max_speed_m_s = 0;
  double dt_s = 0;
  std::size_t n_steps = 0, n_particles = 0;
  double wall_s = 0;
};

/// One instant of the particles for visualisation; spans are valid during the callback only.
struct ParticleFrame {
  double time_s = 0;
  std::span<const double> x, y, z, vx, vy, vz;      ///< [n] m, m/s
  std::span<const double> mass, density, pressure;  ///< [n] kg, kg/m3, Pa
  std::span<const std::uint32_t> id;                ///< [n] stable across the run
  std::span<const double> solid_fraction;           ///< [n] -; empty for columns
  std::span<const double> state;                    ///< [n] 0 dense .. 3 ultradilute; may be empty
  std::span<const double> granular_temperature;     ///< [n] m2/s2; may be empty
  std::string_view set = "grains";                  ///< name of the particle set
  std::size_t set_index = 0;                        ///< 0: the first set of the scene
};

struct RunControl {
  /// Called about every `progress_every_s` wall seconds; return false to cancel.
  std::function<bool(const Progress&)> on_progress;
  double progress_every_s = 0.2;
  /// Called at t = 0, every `frame_every_s` of simulated time, and at the end; once for each set.
  std::function<void(const ParticleFrame&)> on_frame;
  double frame_every_s = 1;  ///< 0: every step
  double max_wall_s = 0;     ///< 0 = none; beyond it the member fails with a reason
};

class Simulation {
 public:
  explicit Simulation(std::unique_ptr<SimulationParts>);
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;
  ~Simulation();

  /// Runs to the stop. Never throws for numerical trouble: that is an Outcome.
  MemberResult run(const RunControl& control = {});
  /// One step by hand, for tests and benchmarks.
  void step();
  SimulationParts& parts() { return *parts_; }
  const SimulationParts& parts() const { return *parts_; }

 private:
  std::unique_ptr<SimulationParts> parts_;
};

}  // namespace sturz
