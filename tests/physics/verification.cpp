// SPDX-License-Identifier: Apache-2.0
#include "tests/physics/verification.hpp"

#include "io/site/scene_inputs.hpp"
#include "scenarios/assembly/assemble.hpp"
#include "tests/physics/results/known_misses.hpp"
#include "tests/physics/results/results_file.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace sturz::test {

Simulation build(const Scenario& scenario, int threads, InstructionSet instruction_set) {
  return assemble(scenario, load_scene_inputs(scenario), 0, threads, instruction_set);
}

Finished run(const Scenario& scenario, const Watch& watch) { return run(build(scenario), watch); }

Finished run(Simulation simulation, const Watch& watch) {
  RunControl control;
  control.frame_every_s = watch.every_s;
  if (watch.look)
    control.on_frame = [&](const ParticleFrame& frame) {
      watch.look(frame.time_s, simulation.parts());
    };
  MemberResult result = simulation.run(control);
  return {std::move(simulation), std::move(result)};
}

MeanMotion mean_motion(const ParticleSet& p) {
  MeanMotion m;
  double mass = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double v2 = p.vx[i] * p.vx[i] + p.vy[i] * p.vy[i] + p.vz[i] * p.vz[i];
    mass += p.mass[i];
    m.x += p.mass[i] * p.x[i], m.y += p.mass[i] * p.y[i], m.z += p.mass[i] * p.z[i];
    m.vx += p.mass[i] * p.vx[i], m.vy += p.mass[i] * p.vy[i], m.vz += p.mass[i] * p.vz[i];
    m.speed += p.mass[i] * std::sqrt(v2);
    m.energy_height += p.mass[i] * v2 / (2 * gravity_m_s2);
    m.fastest = std::max(m.fastest, std::sqrt(v2));
  }
  for (double* value : {&m.x, &m.y, &m.z, &m.vx, &m.vy, &m.vz, &m.speed, &m.energy_height})
    *value /= mass;
  return m;
}

namespace {

bool are_columns(const Finished& f) {
  return f.result.formulation == to_string(Formulation::depth_averaged);
}

}  // namespace

void expect_mass_and_momentum(const Finished& f) {
  const State& s = f.simulation.parts().state;
  const Ledger ledger = s.ledger();
  EXPECT_TRUE(is_valid(f.result.outcome)) << to_string(f.result.outcome) << f.result.reason;
  if (ledger.lost_mass == 0) {
    EXPECT_EQ(s.n_particles(), static_cast<std::size_t>(f.result.scalars.n_particles));
  }
  // What is left is the rounding of two sums over the same numbers.
  EXPECT_LE(std::abs(f.result.scalars.mass_error), 1e-13);
  EXPECT_EQ(ledger.leaked_mass, 0);
  double impulse2 = 0;
  for (double i : ledger.stress_impulse) impulse2 += i * i;
  // Where mass leaves, the last force on it is not in the sum but its reaction is.
  // Columns of a sheet push each other hard and no one moves: there rounding weighs more.
  const double limit = ledger.lost_mass > 0 ? 1e-5 : are_columns(f) ? 1e-6 : 1e-7;
  EXPECT_LE(std::sqrt(impulse2), limit * ledger.stress_impulse_scale)
      << "pair forces push the whole";
}

void expect_conserved(const std::string& name, const Finished& f) {
  expect_mass_and_momentum(f);
  EXPECT_LE(std::abs(f.result.scalars.energy_residual), 0.01) << name;
  expect_numerical_bounded(name, f);
}

void expect_conserved(const Finished& columns) {
  EXPECT_TRUE(are_columns(columns)) << "full stress needs a name";
  expect_conserved("", columns);
}

void expect_numerical_bounded(const std::string& name, const Finished& f) {
  if (are_columns(f)) return;
  const Ledger ledger = f.simulation.parts().state.ledger();
  const double share = ledger.numerical() / ledger.available_energy();
  const double bound = share < 0 ? -least_numerical : largest_numerical;
  expect_within({name + ", numerical", "work / released", share, 0, share, bound}, f);
}

double slope_of(const std::vector<double>& t, const std::vector<double>& v) {
  double mt = 0, mv = 0, tt = 0, tv = 0;
  for (std::size_t i = 0; i < t.size(); ++i) mt += t[i] / t.size(), mv += v[i] / t.size();
  for (std::size_t i = 0; i < t.size(); ++i) {
    tt += (t[i] - mt) * (t[i] - mt);
    tv += (t[i] - mt) * (v[i] - mv);
  }
  return tv / tt;
}

Convergence observed_convergence(const std::vector<double>& dx, const std::vector<double>& value) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  Convergence c{false, nan, nan};
  const double ratio = (value[0] - value[1]) / (value[1] - value[2]);
  // (dx0^p - dx1^p) / (dx1^p - dx2^p) grows with p, from log(dx0/dx1)/log(dx1/dx2) at p = 0.
  auto expected = [&](double p) {
    return (std::pow(dx[0], p) - std::pow(dx[1], p)) / (std::pow(dx[1], p) - std::pow(dx[2], p));
  };
  double low = 1e-3, high = 12;
  c.monotonic = ratio > expected(low) && ratio < expected(high);
  if (!c.monotonic) return c;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (expected(middle) < ratio ? low : high) = middle;
  }
  c.order = low;
  const double share =
      std::pow(dx[2], c.order) / (std::pow(dx[1], c.order) - std::pow(dx[2], c.order));
  c.limit = value[2] + (value[2] - value[1]) * share;
  return c;
}

namespace {

std::string verdict_of(const Line& line) {
  if (std::isnan(line.tolerance)) return "reported";
  if (std::abs(line.error) <= line.tolerance) return "met";
  return "missed";
}

void expect_no_objection(const Line& line) {
  const std::string against = objection(known_misses(), line.name, line.error, line.tolerance);
  EXPECT_EQ(against, "") << line.quantity << ' ' << line.measured << ", reference "
                         << line.reference;
}

void keep(const Line& line, const Finished& f) {
  const MemberScalars& m = f.result.scalars;
  const double dx = f.simulation.parts().facts.spacing_m;
  const std::string verdict = verdict_of(line);
  fmt::print(
      "{:<46} | dx {:.4g} m, {:g} particles | dt {:.3g} s ({}) | {:.2f} s | {} {:.6g}, "
      "reference {:.6g} | error {:.3g} of {:.3g}: {}\n",
      line.name, dx, m.n_particles, m.mean_dt_s, f.result.binding_limit, m.wall_s, line.quantity,
      line.measured, line.reference, line.error, line.tolerance, verdict);
  testing::Test::RecordProperty("measured", fmt::format("{:.8g}", line.measured));
  testing::Test::RecordProperty("error", fmt::format("{:.4g}", line.error));
  keep_line(
      line.name,
      fmt::format(
          "\"{}\",{:g},{:g},{:.4g},\"{}\",{:g},{:.3f},\"{}\",{:.8g},{:.8g},{:.4g},{:.4g},{}",
          line.name, dx, m.n_particles, m.mean_dt_s, f.result.binding_limit, m.n_steps, m.wall_s,
          line.quantity, line.measured, line.reference, line.error, line.tolerance, verdict));
}

}  // namespace

void record(const Line& line, const Finished& f) {
  EXPECT_TRUE(std::isnan(line.tolerance)) << line.name << " has a tolerance: assert it";
  keep(line, f);
}

void expect_within(const Line& line, const Finished& f) {
  keep(line, f);
  expect_no_objection(line);
}

namespace {

void keep(const Line& line) {
  fmt::print("{:<46} | {} {:.6g}, reference {:.6g} | error {:.3g} of {:.3g}: {}\n", line.name,
             line.quantity, line.measured, line.reference, line.error, line.tolerance,
             verdict_of(line));
  keep_line(line.name, fmt::format("\"{}\",,,,,,,\"{}\",{:.8g},{:.8g},{:.4g},{:.4g},{}", line.name,
                                   line.quantity, line.measured, line.reference, line.error,
                                   line.tolerance, verdict_of(line)));
}

}  // namespace

void record(const Line& line) {
  EXPECT_TRUE(std::isnan(line.tolerance)) << line.name << " has a tolerance: assert it";
  keep(line);
}

void expect_within(const Line& line) {
  keep(line);
  expect_no_objection(line);
}

Line relative(std::string name, std::string quantity, double measured, double reference,
              double tolerance) {
  return {std::move(name), std::move(quantity),      measured,
          reference,       measured / reference - 1, tolerance};
}

}  // namespace sturz::test
