// SPDX-License-Identifier: Apache-2.0
#include "tests/hard/survival.hpp"

#include "engine/core/constants.hpp"
#include "engine/effects/fields.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace sturz::test {
namespace {

constexpr double gravity = standard_gravity;

/// Kinetic energy and gravity's work over time.
struct Instant {
  double time = 0, kinetic = 0, gravity_work = 0;
};

/// Keeps the extremes of a run while it runs.
class Witness {
 public:
  explicit Witness(const SimulationParts& parts) : parts_(parts) { look(); }

  void look() {
    const State& s = parts_.state;
    for (double z : s.grains().z) lowest_z_ = std::min(lowest_z_, z);
    const BoundarySupport& b = s.grains().boundary;
    for (std::size_t i = 0; i < b.distance.size() && i < s.grains().fate.size(); ++i)
      if (s.grains().fate[i] == Fate::stays) lowest_ = std::min<double>(lowest_, b.distance[i]);
    if (const Field* theta = s.grains().find(fields::granular_temperature))
      for (double t : theta->component[0]) cold_ += !(t >= 0 && std::isfinite(t));
    fastest_ = std::max(fastest_, s.grains().motion.max_speed);
    if (s.n_steps > 1) least_dt_ = std::min(least_dt_, s.previous_dt);
    const Ledger& l = s.grains().ledger;
    history_.push_back({s.time, l.kinetic, l.gravity_work});
    most_created_ = std::max(most_created_, created(l));
    most_released_ = std::max(most_released_, l.released_energy());
  }

  void write(double start_speed, double estimated_dt, Survival& out) const {
    const double fall = std::max(0.0, parts_.facts.release.top_m - lowest_z_);
    out.cold = cold_;
    out.lowest_dx = lowest_ / parts_.facts.spacing_m;
    out.free_fall = std::sqrt(start_speed * start_speed + 2 * gravity * fall);
    out.speed_ratio = fastest_ / out.free_fall;
    if (estimated_dt > 0) out.least_dt_ratio = least_dt_ / estimated_dt;
    if (most_released_ > 0) write_ledger(out);
    write_end(out);
  }

 private:
  void write_ledger(Survival& out) const {
    const Ledger& l = parts_.state.grains().ledger;
    out.energy_residual = std::abs(l.residual()) / most_released_;
    out.numerical_share = l.numerical() / most_released_;
    out.created_energy = most_created_ / most_released_;
  }

  /// What is there and what is known to be spent, beyond what was given [J].
  static double created(const Ledger& l) {
    const double given = l.kinetic_0 + l.elastic_0 + l.spring_0 + l.gravity_work;
    const double stored =
        l.elastic + l.frictional + l.granular + l.rotational + l.isolated_elastic + l.spring;
    const double kept = l.kinetic + stored + l.lost_energy + l.granular_lost;
    const double spent = l.plastic + l.friction + l.rest_damping + l.damping() + l.collisions +
                         l.isolated_dissipated();
    return kept + spent - std::max(0.0, l.diffusion) - given;
  }

  void write_end(Survival& out) const {
    double peak = 0;
    for (const Instant& at : history_) peak = std::max(peak, at.kinetic);
    if (peak <= 0) return;
    const Instant& end = history_.back();
    const auto late = std::find_if(history_.begin(), history_.end(),
                                   [&](const Instant& at) { return at.time >= 0.9 * end.time; });
    out.kinetic_ratio = end.kinetic / peak;
    const double given = std::max(0.0, end.gravity_work - late->gravity_work);
    out.late_growth = std::max(0.0, end.kinetic - late->kinetic - given) / peak;
  }

  const SimulationParts& parts_;
  double lowest_z_ = 1e300, lowest_ = 1e300, fastest_ = 0, least_dt_ = 1e300;
  double cold_ = 0, most_released_ = 0, most_created_ = 0;
  std::vector<Instant> history_;
};

bool all_finite(const ParticleSet& p) {
  for (std::size_t i = 0; i < p.size(); ++i)
    if (!std::isfinite(p.x[i] + p.y[i] + p.z[i] + p.vx[i] + p.vy[i] + p.vz[i])) return false;
  return true;
}

}  // namespace

Survival survive(Simulation simulation, double start_speed, double estimated_dt,
                 const std::function<void(const SimulationParts&)>& also) {
  const SimulationParts& parts = simulation.parts();
  Witness witness(parts);
  RunControl control;
  control.progress_every_s = 0;
  control.max_wall_s = 300;  // a member that hangs is a failed one
  control.on_progress = [&](const Progress&) {
    witness.look();
    if (also) also(parts);
    return true;
  };
  const MemberResult r = simulation.run(control);
  witness.look();
  const MemberScalars& m = r.scalars;
  const Ledger& ledger = parts.state.grains().ledger;
  Survival out;
  out.outcome = r.outcome, out.reason = r.reason;
  out.finite = all_finite(parts.state.grains());
  out.particles = m.n_particles, out.steps = m.n_steps;
  out.end_time_s = m.end_time_s, out.seconds = m.wall_s;
  out.front_travel_m = m.front_travel_m, out.max_mach = m.max_mach;
  out.reported_residual = std::abs(m.energy_residual), out.mass_error = std::abs(m.mass_error);
  out.leaked_share = ledger.leaked_mass / ledger.released_mass;
  out.lost_share = ledger.lost_mass / ledger.released_mass;
  if (estimated_dt > 0) out.mean_dt_ratio = m.mean_dt_s / estimated_dt;
  witness.write(start_speed, estimated_dt, out);
  return out;
}

std::vector<Check> checks_of(const Survival& s, bool jets) {
  std::vector<Check> checks = {
      at_most("members without a valid outcome", is_valid(s.outcome) ? 0 : 1, 0),
      at_most("members with NaN", s.finite ? 0 : 1, 0),
      at_most("grains with a granular temperature below zero or NaN", s.cold, 0),
      at_most("mass error", s.mass_error, 1e-12),
      at_most("leaked share of the mass", s.leaked_share, 0),
      at_most("energy residual", s.energy_residual, 0.01),
      at_most("lowest centre, dx under ground", std::max(0.0, -s.lowest_dx), 0.1),
      at_most("energy created, of all that was given", s.created_energy, 0.01),
      at_most("kinetic energy grown from nothing, of its peak", s.late_growth, 0.01)};
  if (!jets) checks.push_back(at_most("largest speed / free fall", s.speed_ratio, 1.05));
  if (s.mean_dt_ratio > 0)
    checks.push_back(at_least("mean step / estimate", s.mean_dt_ratio, 0.05));
  return checks;
}

}  // namespace sturz::test
