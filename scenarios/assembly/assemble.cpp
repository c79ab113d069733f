// SPDX-License-Identifier: Apache-2.0
#include "scenarios/assembly/assemble.hpp"

#include "engine/core/error.hpp"
#include "engine/core/sum.hpp"
#include "engine/effects/motion/effect.hpp"
#include "engine/effects/motion/gravity.hpp"
#include "engine/simulation/parts.hpp"
#include "scenarios/assembly/scene_plan.hpp"
#include "scenarios/schema/schema.hpp"

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

State make_state(const Scenario& s, const ScenePlan& plan, int threads) {
  State state(plan.bed, plan.domain);
  state.threads = std::max(1, threads);
  const Release& r = plan.release;
  ParticleSet& p = state.grains;
  p.resize(r.x.size());
  p.x = r.x;
  p.y = r.y;
  p.z = r.z;
  p.mass = r.mass;
  const auto& v = s.release.velocity_m_s;
  std::fill(p.vx.begin(), p.vx.end(), v[0]);
  std::fill(p.vy.begin(), p.vy.end(), v[1]);
  std::fill(p.vz.begin(), p.vz.end(), v[2]);
  Sum released;
  for (double m : p.mass) released.add(m);
  state.ledger.released_mass = released.value();
  return state;
}

/// The effects that a scene calls for, in the order of the step.
Step make_step(const ScenePlan& plan, State& state) {
  Step step;
  if (plan.formulation.depth_averaged) {
    add_depth_averaged(step, state, plan.columns, plan.release.thickness);
  } else {
    add_grain_stress(step, state, plan.stress, plan.release.depth);
    add_gravity(step, state);
    add_terrain_contact(step, state, plan.contact);
    if (plan.parcel_contacts) add_parcel_contacts(step, state, *plan.parcel_contacts);
    add_motion(step, state, {plan.stress.spacing, plan.stress.smoothing_length});
  }
  refresh_motion(state, 0);
  state.ledger.kinetic_0 = state.ledger.kinetic;
  return step;
}

void require_numbers(const Scenario& s) {
  const auto uncertain = uncertain_keys(s);
  require(uncertain.empty(), uncertain.empty()
                                 ? ""
                                 : uncertain.front().path +
                                       ": is a distribution where a number is needed (one member "
                                       "is one set of numbers). Sample it first.");
}

/// Thickness that counts as reached [m]: what a tenth of a particle spread over its place gives;
/// columns thin out continuously, so for them a fixed one.
double reach_limit(const ScenePlan& plan, double dx) {
  return plan.formulation.depth_averaged ? 0.05 : std::max(0.05, dx / 10);
}

/// For estimates: v_ref, or the energy of the release spread over its mass.
double typical_speed(const ScenePlan& plan) {
  if (!plan.formulation.depth_averaged) return plan.reference_speed_m_s;
  double mass = 0;
  for (double m : plan.release.mass) mass += m;
  return 0.5 * std::sqrt(2 * plan.available_energy_j / mass);
}

std::string joined(const std::vector<std::string>& parts) {
  std::string out;
  for (const auto& p : parts) out += (out.empty() ? "" : "; ") + p;
  return out;
}

PeakMaps make_peaks(const Scenario& s, const ScenePlan& plan, const Grid& grid) {
  const double dx = s.numerics.spacing_m;
  return PeakMaps({grid, dx, plan.bulk_density_kg_m3, reach_limit(plan, dx)});
}

StopRule make_stop(const Scenario& s, const ScenePlan& plan) {
  return StopRule({s.numerics.end_time_s, s.numerics.stop_at_rest, s.numerics.spacing_m,
                   plan.release.max_thickness_m, plan.available_energy_j});
}

}  // namespace

Simulation assemble(const Scenario& numbers, const SceneInputs& inputs, std::int64_t member,
                    int threads, InstructionSet instruction_set) {
  require_numbers(numbers);
  ScenePlan plan = plan_scene(numbers, inputs, member);
  plan.stress.instruction_set = plan.columns.instruction_set = instruction_set;
  State state = make_state(numbers, plan, threads);
  Step step = make_step(plan, state);
  auto parts = std::make_unique<SimulationParts>(
      SimulationParts{std::move(state), std::move(step),
                      make_peaks(numbers, plan, inputs.hazard_grid), make_stop(numbers, plan)});
  parts->member = member;
  parts->spacing_m = numbers.numerics.spacing_m;
  parts->formulation = plan.formulation.name();
  parts->reference_density = plan.bulk_density_kg_m3;
  parts->reference_fraction = plan.reference_fraction;
  if (plan.formulation.depth_averaged) {
    parts->least_dt_s = 1e-6 * std::sqrt(numbers.numerics.spacing_m / parts->state.gravity);
  } else {
    // A hundredth of the acoustic limit at v_ref: below it something has run away.
    parts->least_dt_s =
        0.01 * plan.stress.courant * plan.stress.smoothing_length / (1.1 * plan.stress.sound_speed);
  }
  parts->release_layers = plan.release.layers;
  parts->release_volume_m3 = plan.release.volume_m3;
  for (std::size_t i = 0; i < plan.release.x.size(); ++i) {
    const double share = plan.release.mass[i] / parts->state.ledger.released_mass;
    parts->release_x_m += share * plan.release.x[i];
    parts->release_y_m += share * plan.release.y[i];
  }
  parts->release_top_m = *std::max_element(plan.release.z.begin(), plan.release.z.end());
  parts->warnings = joined(plan_warnings(numbers, plan));
  parts->start_x = plan.release.x;
  parts->start_y = plan.release.y;
  return Simulation(std::move(parts));
}

SceneDescription describe(const Scenario& s, const SceneInputs& inputs) {
  require_numbers(s);
  const ScenePlan plan = plan_scene(s, inputs, 0);
  State state = make_state(s, plan, 1);
  const Step step = make_step(plan, state);

  SceneDescription d;
  const bool walls = !s.domain.walls.empty(), periodic = !s.domain.periodic.empty();
  const bool columns = plan.formulation.depth_averaged;
  const auto& basal = s.basal;
  const bool zones = !basal.zones.empty();
  const bool varying_k = s.grains->earth_pressure != LateralPressure::isotropic;
  auto optional_note = [&](const char* name, const char* key, bool given) -> EffectNote {
    return {name, given, (given ? "`" : "no `") + std::string(key) + "`"};
  };
  const auto* states = s.grains->states ? &*s.grains->states : nullptr;
  auto states_note = [&](std::string_view name, const char* key, bool given) -> EffectNote {
    if (given && columns) return {std::string(name), false, "not in depth_averaged"};
    return {std::string(name), given, (given ? "`" : "no `") + std::string(key) + "`"};
  };
  d.effects = {
      {std::string(EffectName::gravity), true, "always"},
      {std::string(EffectName::base), true,
       "always: friction_coefficient, pore_pressure_ratio, cohesion_pa of `basal`"},
      {std::string(EffectName::grain_stress), !columns,
       columns ? "not in depth_averaged" : "`grains`: elastic + mu(I), 3-D, full stress"},
      states_note(EffectName::states, "grains.states", states != nullptr),
      states_note(EffectName::kinetic_theory, "grains.states.dilute", states && states->dilute),
      states_note(EffectName::lone_parcels, "grains.states.ultradilute",
                  states && states->ultradilute),
      states_note(EffectName::parcel_contacts, "grains.states.ultradilute.contacts: hertz_mindlin",
                  plan.parcel_contacts.has_value()),
      {std::string(EffectName::column_pressure), columns,
       !columns     ? "not in full_stress"
       : !varying_k ? "`grains.earth_pressure: isotropic`, K = 1"
                    : "`grains.earth_pressure: active_passive`"},
      optional_note("turbulent base", "basal.turbulent_coefficient_m_s2",
                    basal.turbulent_coefficient_m_s2.has_value()),
      optional_note("viscous base", "basal.viscosity_pa_s", basal.viscosity_pa_s.has_value()),
      optional_note("zones of the base", "basal.zones", zones),
      {std::string(EffectName::walls), walls, walls ? "`domain.walls`" : "no `domain.walls`"},
      {"periodic images", periodic, periodic ? "`domain.periodic`" : "no `domain.periodic`"},
      {std::string(EffectName::motion), true, "always"},
      {"excavation", s.release.surface == ReleaseSurface::pre_failure,
       "`release.surface: " + std::string(to_string(s.release.surface)) + "`"},
  };
  d.passes = step.pass_names();
  d.formulation = plan.formulation.name();
  d.formulation_reason = plan.formulation.reason;
  d.n_particles = state.grains.size();
  // Lists and records exist from the first step on; those of a group of grains hold ~250 entries.
  const std::size_t lists_per_particle =
      columns ? 48 + 2 * 40 + 7 * 4 + 16 : 64 + 13 * 4 + 2 * (250 / 16) * 4 + 32;
  d.memory_bytes = d.n_particles * (state.grains.bytes_per_particle() + 24 + lists_per_particle) +
                   inputs.hazard_grid.n_cells() * 60;
  d.spacing_m = s.numerics.spacing_m;
  d.release_volume_m3 = plan.release.volume_m3;
  d.release_area_m2 = plan.release.area_m2;
  d.layers = plan.release.layers;
  d.reference_speed_m_s = plan.reference_speed_m_s;
  d.sound_speed_m_s = columns ? 0 : plan.stress.sound_speed;
  state.motion.max_speed = 0.5 * typical_speed(plan);
  state.n_steps = 1;  // the first step is shorter than those that count
  const StepLimit limit = step.limit(state);
  d.dt_s = limit.dt;
  d.binding_limit = limit.name;
  d.n_steps = std::ceil(s.numerics.end_time_s / limit.dt);
  d.warnings = plan_warnings(s, plan);
  return d;
}

}  // namespace sturz
