// SPDX-License-Identifier: Apache-2.0
/// What every verification case does: build a scene through the public door, run it, check what it
/// must conserve, and write one line of the accuracy-versus-time table.
#pragma once

#include "engine/core/constants.hpp"
#include "engine/effects/sweep/fused_sweep.hpp"
#include "engine/simulation/parts.hpp"
#include "engine/simulation/simulation.hpp"
#include "scenarios/scenario.hpp"

#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace sturz::test {

inline constexpr double gravity_m_s2 = standard_gravity;
inline constexpr double degree = 0.017453292519943295;

/// Loads the inputs of a scene and assembles its member 0.
Simulation build(const Scenario&, int threads = 1,
                 InstructionSet instruction_set = best_instruction_set());

/// A finished member, its particles still at hand.
struct Finished {
  Simulation simulation;
  MemberResult result;
};

/// Looked at every `every_s` of simulated time, at t = 0 and at the end.
struct Watch {
  double every_s = 1;
  std::function<void(double time_s, const SimulationParts&)> look;
};
Finished run(const Scenario&, const Watch& = {});
/// Runs a simulation that was built and changed by hand.
Finished run(Simulation, const Watch& = {});

/// Mass averages.
struct MeanMotion {
  double x = 0, y = 0, z = 0;     ///< centre of mass [m]
  double vx = 0, vy = 0, vz = 0;  ///< [m/s]
  double speed = 0;               ///< mean |v| [m/s]
  double energy_height = 0;       ///< kinetic energy / (m g) [m]
  double fastest = 0;             ///< largest |v| [m/s]
};
MeanMotion mean_motion(const ParticleSet&);

/// V20: mass to the last bit, pair forces without net momentum.
void expect_mass_and_momentum(const Finished&);
/// The same, energy accounted for within 1 % of the energy that was set free, and
/// expect_numerical_bounded. The one without a name is for columns, of which nothing is recorded.
/// \param name  of the case, for the line that this records
void expect_conserved(const std::string& name, const Finished&);
void expect_conserved(const Finished& columns);

/// S4: what the stress law does not explain of the pair forces' work (Ledger::numerical) lies
/// between -2 % and 10 % of the energy that was set free. It is a term of the residual, which
/// therefore closes whatever the forces are: only its own size shows a wrong one. Full stress only:
/// columns have no stress power.
void expect_numerical_bounded(const std::string& name, const Finished&);
inline constexpr double least_numerical = -0.02, largest_numerical = 0.10;

/// Least-squares slope of v over t.
double slope_of(const std::vector<double>& t, const std::vector<double>& v);

/// Order p and limit f of f(dx) = f0 + c dx^p through three resolutions, coarse to fine.
struct Convergence {
  bool monotonic =
      false;  ///< differences of one sign that get smaller; else order and limit are NaN
  double order = 0;
  double limit = 0;
};
Convergence observed_convergence(const std::vector<double>& dx, const std::vector<double>& value);

inline constexpr double reported_only = std::numeric_limits<double>::quiet_NaN();

/// One line of the table.
struct Line {
  std::string name;      ///< "V1 particle, r_u 0.2": unique, it is the key of the line
  std::string quantity;  ///< what was measured, with its unit
  double measured = 0, reference = 0;
  double error = 0;  ///< in the sense and unit of the tolerance
  double tolerance = reported_only;
};
/// Prints the line, keeps it in tests/physics/results.csv of the build tree (the last run of a case
/// replaces its line) and attaches measured value and error to the running test. For lines without
/// a tolerance: one that has a tolerance is asserted.
void record(const Line&, const Finished&);
/// The same for a line with a tolerance. The test fails where the error is beyond it, unless the
/// line is on the list of known misses (known_misses.hpp), and where a listed line is met again.
void expect_within(const Line&, const Finished&);
/// Both for what is no member: spacing, steps and seconds of the line stay empty.
void record(const Line&);
void expect_within(const Line&);
/// A line whose error is the relative deviation from the reference.
Line relative(std::string name, std::string quantity, double measured, double reference,
              double tolerance = reported_only);

}  // namespace sturz::test
