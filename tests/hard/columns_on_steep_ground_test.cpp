// SPDX-License-Identifier: Apache-2.0
// Depth-averaged members from the corners of the scenario on ground that wants to break them. No
// NaN, no column lost but over the domain boundary, the ledger closed, no speed from nowhere.
// STURZ_HARD_MEMBERS=500 runs as many, STURZ_HARD_FIRST=250 begins there; the usual number is for
// every change. docs/studies/hard_wet_members.py runs many and adds them up.
#include "engine/core/constants.hpp"
#include "engine/core/random.hpp"
#include "engine/effects/fields.hpp"
#include "engine/simulation/parts.hpp"
#include "io/site/scene_inputs.hpp"
#include "scenarios/assembly/assemble.hpp"
#include "tests/hard/priors.hpp"
#include "tests/hard/random_members.hpp"
#include "tests/hard/steep_ground.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>

namespace sturz::test {
namespace {

/// Height that the mass can have fallen, with what its own thickness and start speed add [m].
double head(const Scenario& s, const SimulationParts& parts, const Raster<double>& ground) {
  const auto [low, high] = std::minmax_element(ground.values.begin(), ground.values.end());
  double thickest = 0;
  for (const MovingSet& p : parts.state.sets) {
    const auto& all = p.scalar(fields::thickness);
    thickest += all.empty() ? 0 : *std::max_element(all.begin(), all.end());
  }
  const auto& v = s.release.velocity_m_s;
  return *high - *low + thickest + (v[0] * v[0] + v[1] * v[1]) / 19.62;
}

bool is_finite(const ParticleSet& p) {
  for (std::size_t i = 0; i < p.size(); ++i)
    if (!std::isfinite(p.x[i] + p.y[i] + p.z[i] + p.vx[i] + p.vy[i] + p.vz[i])) return false;
  return true;
}

/// The worst of many members.
struct Worst {
  std::map<std::string, int> outcomes;
  double residual = 0, mass = 0, speed = 0, dt = 1e300, seconds = 0;

  void print(int n) const {
    std::string text;
    for (const auto& [name, count] : outcomes) text += fmt::format(" {} {},", name, count);
    fmt::print(
        "{} members in {:.0f} s:{} energy residual <= {:.1e}, mass error <= {:.1e}, speed <= "
        "{:.2f} of free fall, mean step >= {:.3f} sqrt(dx/g)\n",
        n, seconds, text, residual, mass, speed, dt);
  }
};

/// Runs a member and checks what every one must keep. \return what is left of it
Simulation survive(const HardMember& m, int number, Worst& worst, MemberScalars& s) {
  Simulation simulation = assemble(m.scenario, m.inputs, number, 1);
  const double most =
      std::sqrt(2 * standard_gravity * head(m.scenario, simulation.parts(), *m.inputs.elevation));
  const MemberResult r = simulation.run();
  ++worst.outcomes[std::string(to_string(r.outcome))];
  s = r.scalars;
  const Ledger ledger = simulation.parts().state.ledger();
  EXPECT_TRUE(is_valid(r.outcome)) << to_string(r.outcome) << ": " << r.reason;
  for (const MovingSet& p : simulation.parts().state.sets) EXPECT_TRUE(is_finite(p));
  EXPECT_LE(std::abs(s.mass_error), 1e-12);
  EXPECT_EQ(ledger.leaked_mass, 0);
  if (m.scenario.terrain.nodata == TerrainEdge::wall) {
    EXPECT_EQ(ledger.lost_mass, 0);
  }
  // Of a mass that hardly fell the rest must be worth a hundredth of a spacing, as `doubts` has it.
  const double least =
      0.01 * m.scenario.numerics.spacing_m * standard_gravity * ledger.released_mass;
  EXPECT_LE(std::abs(ledger.residual()),
            std::max(0.01 * ledger.available_energy(), m.scenario.mixture ? least : 0))
      << "released " << ledger.available_energy() << " J, " << s.com_drop_m << " m of fall";
  if (!m.scenario.mixture) {
    EXPECT_LE(std::abs(s.energy_residual), 0.01);
  }
  EXPECT_LE(s.max_speed_m_s, most);
  const double step = s.mean_dt_s / std::sqrt(m.scenario.numerics.spacing_m / standard_gravity);
  EXPECT_GT(step, 1e-3);
  worst.residual = std::max(worst.residual, std::abs(s.energy_residual));
  worst.mass = std::max(worst.mass, std::abs(s.mass_error));
  worst.speed = std::max(worst.speed, s.max_speed_m_s / most);
  worst.dt = std::min(worst.dt, step);
  worst.seconds += s.cpu_s;
  return simulation;
}

TEST(SteepGround, ColumnsSurviveEveryCorner) {
  const int n = hard_members(60);
  Worst worst;
  MemberScalars s;
  for (int k = 0; k < n; ++k) {
    SCOPED_TRACE(fmt::format("member {}", k));
    survive(hard_member(static_cast<std::uint64_t>(k)), k, worst, s);
  }
  worst.print(n);
}

/// STURZ_HARD_COURANT=0.5 takes half of the steps' usual length: what then falls by four is an
/// error of the step.
double step_factor() {
  const char* asked = std::getenv("STURZ_HARD_COURANT");
  return asked ? std::atof(asked) : 1;
}

int first_member() {
  const char* asked = std::getenv("STURZ_HARD_FIRST");
  return asked ? std::max(0, std::atoi(asked)) : 0;
}

/// The same member with water in its pores, from the whole prior of a mixture.
HardMember soaked(HardMember m, int number) {
  int drawn = 0;
  const auto unit = [&] {
    return unit_random(0x5eed, static_cast<std::uint64_t>(number), drawn++);
  };
  const auto between = [&](double low, double high) { return low + (high - low) * unit(); };
  const auto log_between = [&](double low, double high) {
    return low * std::pow(high / low, unit());
  };
  Scenario& s = m.scenario;
  s.numerics.courant *= step_factor();
  s.basal.pore_pressure_ratio = 0;
  s.basal.viscosity_pa_s.reset();
  s.basal.yield_stress_pa.reset();
  s.grains->earth_pressure = LateralPressure::isotropic;
  s.grains->solid_fraction = between(0.3, 0.75);
  MixtureSpec& wet = s.mixture.emplace();
  wet.fluid_density_kg_m3 = between(1000, 1400);
  wet.fluid_viscosity_pa_s = log_between(1e-3, 10);
  wet.critical_solid_fraction = between(0.5, 0.7);
  wet.permeability_m2 = log_between(1e-13, 1e-6);
  wet.compressibility = log_between(0.003, 0.3);
  wet.stress_offset_pa = log_between(10, 1e4);
  wet.shear_grain_diameter_m = log_between(1e-4, 0.3);
  if (unit() < 0.3) wet.initial_pressure = InitialPressure::liquefied;
  if (wet.initial_pressure == InitialPressure::hydrostatic && unit() < 0.4)
    wet.initial_pressure_ratio = Uncertain(unit());
  if (number % 4 == 3) wet.pressure_profile = PressureProfile::resolved;
  if (number % 8 == 7) wet.drainage = Drainage::both;
  return m;
}

/// Whether every pressure is a number, or also between nothing and the weight.
bool all_within(const ParticleSet& p, bool finite_only) {
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double pressure = p.scalar(fields::pore_pressure)[i];
    if (!std::isfinite(pressure + p.scalar(fields::solid_fraction)[i])) return false;
    if (finite_only) continue;
    const double volume = p.scalar(fields::solids_volume)[i] + p.scalar(fields::water_volume)[i];
    const double weight =
        p.mass[i] / volume * p.scalar(fields::normal_gravity)[i] * p.scalar(fields::thickness)[i];
    if (pressure < 0 || pressure > weight * (1 + 1e-12) + 1e-9) return false;
  }
  return true;
}

/// The same member as grains and liquid at two velocities.
HardMember parted(const HardMember& m, int number) {
  HardMember out = soaked(m, number);
  Scenario& s = out.scenario;
  MixtureSpec& wet = *s.mixture;
  wet.phases = MixturePhases::two;
  wet.initial_pressure = InitialPressure::hydrostatic;
  wet.initial_pressure_ratio.reset();
  wet.pressure_profile = PressureProfile::parabola;
  wet.drainage = Drainage::top;
  const auto unit = [&](int k) {
    return unit_random(0xface, static_cast<std::uint64_t>(number), k);
  };
  s.grains->solid_fraction = 0.05 + 0.8 * unit(0);
  wet.permeability_m2 = std::pow(10, -13 + 10 * unit(1));
  if (unit(2) < 0.4) {
    wet.drag_law = PhaseDragLaw::settling;
    wet.settling_speed_m_s = Uncertain(std::pow(10, -3 + 5 * unit(3)));
  }
  if (unit(4) < 0.5) s.basal.turbulent_coefficient_m_s2 = Uncertain(200 + 1800 * unit(5));
  return out;
}

TEST(SteepGround, GrainsAndLiquidSurviveEveryCorner) {
  const int n = hard_members(40);
  Worst worst;
  double masses = 0, raised = 0, drag = 0;
  for (int k = 0; k < n; ++k) {
    SCOPED_TRACE(fmt::format("member {}", k));
    MemberScalars s;
    survive(parted(hard_member(static_cast<std::uint64_t>(k)), k), k, worst, s);
    EXPECT_LE(std::abs(s.solids_error), 1e-12);
    EXPECT_LE(std::abs(s.water_error), 1e-12);
    EXPECT_GE(s.drag_loss_fraction, -1e-3);
    masses = std::max({masses, std::abs(s.solids_error), std::abs(s.water_error)});
    raised = std::max(raised, s.drag_raised_fraction);
    drag = std::max(drag, s.drag_loss_fraction);
  }
  worst.print(n);
  fmt::print(
      "grains and liquid to {:.1e}; drag took at most {:.0f} %, was raised in up to {:.0f} %\n",
      masses, 100 * drag, 100 * raised);
}

/// Pressure between nothing and the weight in every column.
void expect_pressures_within_bounds(const ParticleSet& p) {
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double volume = p.scalar(fields::solids_volume)[i] + p.scalar(fields::water_volume)[i];
    const double pressure = p.scalar(fields::pore_pressure)[i];
    const double m = p.scalar(fields::solid_fraction)[i];
    ASSERT_TRUE(std::isfinite(pressure) && std::isfinite(m));
    ASSERT_GE(pressure, 0);
    // The weight of the last kick is that of the step's own gravity and thickness.
    ASSERT_LE(pressure, p.mass[i] / volume * p.scalar(fields::normal_gravity)[i] *
                                p.scalar(fields::thickness)[i] * (1 + 1e-12) +
                            1e-9);
    ASSERT_GT(m, 0.15);
    ASSERT_LT(m, 0.95);
  }
}

/// What of the released mass is neither there nor over the edge.
double lost_inside(const Ledger& ledger, const MemberScalars& s) {
  return (std::abs(ledger.leaked_mass) + std::abs(s.mass_error * ledger.released_mass)) /
         ledger.released_mass;
}

/// Wet members and the same ones dry.
struct Twins {
  Worst dry, wet;
  double volumes = 0, slowest = 0, steps = 0, lost = 0;
  int not_finite = 0, out_of_bounds = 0, unexplained = 0;

  /// One line a member for the script.
  void tell(int number, const MemberScalars& with, const MemberScalars& without,
            const Ledger& ledger) const {
    if (!std::getenv("STURZ_HARD_TELL")) return;
    fmt::print(
        "member {} residual {:.3e} of {:.4g} J, fall {:.3g} m, travel {:.3g} m, steps {} dry {}, "
        "dt {:.3g} dry {:.3g} s, speed {:.3g} dry {:.3g}, pressure {:.2f}, clipped {:.2g}, "
        "J {:.3g}\n",
        number, with.energy_residual, ledger.available_energy(), with.com_drop_m, with.com_travel_m,
        with.n_steps, without.n_steps, with.mean_dt_s, without.mean_dt_s, with.max_speed_m_s,
        without.max_speed_m_s, with.max_pore_pressure_ratio, with.pore_clipped_fraction,
        ledger.residual());
  }

  void survive_both(const HardMember& plain, int number) {
    MemberScalars with, without;
    const Simulation simulation = survive(soaked(plain, number), number, wet, with);
    survive(plain, number, dry, without);
    const MovingSet& p = simulation.parts().state.grains();
    not_finite += !is_finite(p) || !all_within(p, true);
    out_of_bounds += !all_within(p, false);
    unexplained += std::abs(with.energy_residual) > 0.01;
    lost = std::max(lost, lost_inside(p.ledger, with));
    if (std::min(with.n_steps, without.n_steps) > 20)  // in fewer the first, short ones count most
      steps = std::max(steps, with.n_steps / without.n_steps * without.end_time_s /
                                  std::max(1e-9, with.end_time_s));
    tell(number, with, without, p.ledger);
    expect_pressures_within_bounds(p);
    EXPECT_LE(std::abs(with.solids_error), 1e-12);
    EXPECT_LE(std::abs(with.water_error), 1e-12);
    EXPECT_GE(with.pore_clipped_fraction, 0);
    // Its steps are not shorter because of the water: only what moves limits them.
    EXPECT_GT(with.mean_dt_s * std::max(1.0, with.max_speed_m_s / without.max_speed_m_s),
              without.mean_dt_s / 3);
    volumes = std::max({volumes, std::abs(with.solids_error), std::abs(with.water_error)});
    if (std::min(with.cpu_s, without.cpu_s) < 0.02) return;  // no clock is so fine
    const double slower = with.cpu_s / with.n_steps / (without.cpu_s / without.n_steps);
    EXPECT_LT(slower, 3);
    slowest = std::max(slowest, slower);
  }
  void print(int n) const {
    wet.print(n);
    fmt::print(
        "grains and water to {:.1e}; a step at most {:.2f} times its dry twin's, all members "
        "{:.2f} times; {} members not finite, {} with a pressure out of bounds, {} over 1 % of "
        "energy, mass lost inside <= {:.1e}, steps a second at most {:.2f} times the dry twin's\n",
        volumes, slowest, wet.seconds / dry.seconds, not_finite, out_of_bounds, unexplained, lost,
        steps);
  }
};

TEST(SteepGround, WetColumnsSurviveEveryCorner) {
  const int n = hard_members(40), first = first_member();
  Twins twins;
  for (int k = first; k < first + n; ++k) {
    SCOPED_TRACE(fmt::format("member {}", k));
    twins.survive_both(hard_member(static_cast<std::uint64_t>(k)), k);
  }
  twins.print(n);
}

TEST(SteepGround, WetColumnsSurviveMonteMarsicano) {
  const std::string folder = STURZ_SHARED_DIR "/data/marsicano_tinitaly";
  if (!std::filesystem::exists(folder + "/marsicano_10m.tif"))
    GTEST_SKIP() << "shared data marsicano_tinitaly is not there";
  const RandomMembers mountain = RandomMembers::on_marsicano(folder);
  // Liquefied mass runs anywhere: the whole ground, as without friction.
  Scenario slippery = mountain.member(0).scenario;
  slippery.basal.friction_coefficient = 0;
  SceneInputs everywhere = load_scene_inputs(slippery);
  constexpr int all_of_it = 30;  // a level that no raster is wider than
  everywhere = load_larger_inputs(slippery, everywhere, all_of_it);
  const int n = hard_members(20), first = first_member();
  Twins twins;
  for (int k = first; k < first + n; ++k) {
    SCOPED_TRACE(fmt::format("member {}", k));
    HardMember m = mountain.member(k * 23 % n_points);
    m.inputs = everywhere;
    m.scenario.formulation = Formulation::depth_averaged;
    m.scenario.numerics.end_time_s = 90;
    twins.survive_both(m, k);
  }
  twins.print(n);
}

}  // namespace
}  // namespace sturz::test
