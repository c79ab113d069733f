// SPDX-License-Identifier: Apache-2.0
#include "scenarios/assembly/assemble.hpp"

#include "engine/core/constants.hpp"
#include "engine/core/error.hpp"
#include "engine/core/sum.hpp"
#include "engine/effects/arrivals.hpp"
#include "engine/effects/inflow/effect.hpp"
#include "engine/effects/motion/accounts.hpp"
#include "engine/simulation/parts.hpp"
#include "engine/simulation/reference_speed.hpp"
#include "scenarios/assembly/bed/bed_rasters_plan.hpp"
#include "scenarios/assembly/discrete/discrete_plan.hpp"
#include "scenarios/assembly/effect_table.hpp"
#include "scenarios/assembly/ground_words.hpp"
#include "scenarios/assembly/liquid/liquid_plan.hpp"
#include "scenarios/assembly/phases/phase_plan.hpp"
#include "scenarios/assembly/release_pattern.hpp"
#include "scenarios/assembly/scene_plan.hpp"
#include "scenarios/schema/schema.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sturz {
namespace {

State make_state(const Scenario& s, const ScenePlan& plan, int threads) {
  State state(plan.bed, plan.domain);
  state.threads = std::max(1, threads);
  Release r = plan.release;
  for (auto* column : {&r.x, &r.y, &r.z, &r.mass}) column->resize(plan.n_present);
  MovingSet& p = state.grains();
  p.spacing = s.numerics.spacing_m;
  p.bulk_density = plan.bulk_density_kg_m3;
  p.reference_fraction = plan.reference_fraction;
  p.grow(r.x.size());
  p.x = r.x;
  p.y = r.y;
  p.z = r.z;
  p.mass = r.mass;
  const auto& v = s.release.velocity_m_s;
  std::fill(p.vx.begin(), p.vx.end(), v[0]);
  std::fill(p.vy.begin(), p.vy.end(), v[1]);
  std::fill(p.vz.begin(), p.vz.end(), v[2]);
  mark_start(state.domain, p, 0);
  Sum released;
  for (double m : p.mass) released.add(m);
  p.ledger.released_mass = released.value();
  if (plan.phases) split_phases(state, *plan.phases, s.grains->solid_fraction.value);
  if (plan.liquid) lay_liquid(state, s, plan);
  return state;
}

/// The effects that a scene calls for, in the order of the step.
Step make_step(const Scenario& s, const ScenePlan& plan, State& state) {
  Step step;
  SceneParts parts{s, plan, step, state};
  add_effects(parts);
  for (MovingSet& set : state.sets) {
    refresh_motion(state, set, 0);
    set.ledger.kinetic_0 = set.ledger.kinetic;
  }
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

/// Thickness that counts as reached [m]: 5 cm, in a laboratory (spacings under 10 cm) half a
/// spacing; of particles at least what a tenth of one spread over its place gives.
double runout_limit(const ScenePlan& plan, double dx) {
  const double thin = std::min(0.05, dx / 2);
  return plan.formulation.depth_averaged ? thin : std::max(thin, dx / 10);
}

/// For estimates: v_ref, or the energy of the release spread over its mass.
double typical_speed(const ScenePlan& plan) {
  if (!plan.formulation.depth_averaged) return plan.reference_speed_m_s;
  double mass = 0;
  for (double m : plan.release.mass) mass += m;
  mass += plan.inflow.mass_kg;
  return 0.5 * std::sqrt(2 * plan.available_energy_j / mass);
}

/// Of a particle set without effects: its fixed columns, accelerations, starts.
const std::size_t bare_bytes_per_particle = ParticleSet().bytes_per_particle() + 24;
/// Of the peak maps, where the whole grid is touched.
constexpr std::size_t bytes_per_hazard_cell = 60;

/// A member with a dam of its own height has its own ground, and what columns feel of it.
std::size_t own_ground_bytes(const SceneInputs& in) {
  if (!in.structures.any_by_member() || in.elevation == nullptr) return 0;
  return 2 * in.elevation->values.size() * sizeof(double);
}

/// Cells of the maps that one member may touch: a quarter of what lies within the energy line's
/// bounds, because hardly a flow goes every way at once.
double touched_cells(const SceneInputs& in) {
  const auto all = static_cast<double>(in.hazard_grid.n_cells());
  if (!in.reach) return all;
  const double shorter = in.terrain_grid().cell_m / in.hazard_grid.cell_m;
  return std::min(all, 0.25 * static_cast<double>(in.reach->window.n_cells()) * shorter * shorter);
}

std::string joined(const std::vector<std::string>& parts) {
  std::string out;
  for (const auto& p : parts) out += (out.empty() ? "" : "; ") + p;
  return out;
}

PeakMaps make_peaks(const Scenario& s, const ScenePlan& plan, const Grid& grid) {
  PeakMapSettings settings{grid, runout_limit(plan, s.numerics.spacing_m)};
  settings.by_set = plan.phases || plan.coupling;
  return PeakMaps(settings);
}

StopRule make_stop(const Scenario& s, const ScenePlan& plan) {
  return StopRule({plan.end.end_time_s, s.numerics.stop_at_rest, s.numerics.spacing_m,
                   std::max(plan.release.max_thickness_m, plan.inflow.most_thickness_m),
                   plan.available_energy_j, s.numerics.stop_energy_fraction});
}

/// Masses spread and settle while a point is long at rest.
constexpr double settling = 1.5;

/// How long a member will probably move [s]; its own end time where it gives one.
double expected_time(const Scenario& s, const SceneInputs& inputs, const ScenePlan& plan) {
  if (s.numerics.end_time_s || !s.domain.periodic.empty()) return plan.end.end_time_s;
  const auto& v0 = s.release.velocity_m_s;
  const double start = std::sqrt(v0[0] * v0[0] + v0[1] * v0[1] + v0[2] * v0[2]);
  const double friction = typical_friction(with_typical_bed(s, inputs));
  double moving = time_to_rest(plan.bed, plan.release, friction, start, plan.end.end_time_s);
  double deepest = plan.release.max_thickness_m, last = 0;
  if (!plan.later.empty()) last = plan.later.back().time_s;
  if (!plan.inflow.empty()) {
    Release entering;
    for (const TimedArrival& c : plan.inflow.columns)
      entering.x.push_back(c.arrival.position.x()), entering.y.push_back(c.arrival.position.y());
    moving = std::max(moving, time_to_rest(plan.bed, entering, friction, plan.inflow.most_speed_m_s,
                                           plan.end.end_time_s));
    deepest = std::max(deepest, plan.inflow.most_thickness_m);
    last = std::max(last, plan.inflow.last_s);
  }
  const double spreading = 5 * std::sqrt(deepest / standard_gravity);
  return std::min(plan.end.end_time_s, last + settling * (moving + spreading));
}

/// The largest c0 of grains and liquid; 0 where nothing sounds.
double sound_speed(const Scenario& s, const ScenePlan& plan) {
  if (plan.formulation.depth_averaged || plan.discrete) return 0;
  return std::max(s.grains ? plan.stress.sound_speed : 0,
                  plan.liquid ? plan.liquid->sound_speed : 0);
}

double least_step(const Scenario& s, const ScenePlan& plan) {
  if (plan.formulation.depth_averaged)
    return 1e-6 * std::sqrt(s.numerics.spacing_m / standard_gravity);
  if (plan.discrete) return 0.01 * grain_time_step(*plan.discrete, 2 * plan.reference_speed_m_s);
  // A hundredth of the acoustic limit at v_ref: below it something has run away.
  return 0.01 * s.numerics.courant * smoothing_ratio * s.numerics.spacing_m /
         (1.1 * sound_speed(s, plan));
}

/// Where mass only enters over time, the source of that counts as the release.
ReleaseFacts inflow_facts(const InflowPlan& inflow, double spacing_m) {
  ReleaseFacts facts;
  facts.layers = inflow.most_thickness_m / spacing_m;
  facts.x_m = inflow.x_m, facts.y_m = inflow.y_m;
  facts.crown_x_m = inflow.top_x_m, facts.crown_y_m = inflow.top_y_m;
  facts.crown_z_m = facts.top_m = inflow.top_m;
  return facts;
}

ReleaseFacts release_facts(const ScenePlan& plan, double spacing_m) {
  const Release& r = plan.release;
  if (r.x.empty()) return inflow_facts(plan.inflow, spacing_m);
  ReleaseFacts facts;
  Sum released;
  for (const double m : r.mass) released.add(m);
  const double released_mass = released.value();
  facts.layers = r.layers;
  facts.volume_m3 = r.volume_m3;
  for (std::size_t i = 0; i < r.x.size(); ++i) {
    const double share = r.mass[i] / released_mass;
    facts.x_m += share * r.x[i];
    facts.y_m += share * r.y[i];
  }
  facts.crown_x_m = r.crown_x_m, facts.crown_y_m = r.crown_y_m, facts.crown_z_m = r.crown_z_m;
  facts.top_m = *std::max_element(r.z.begin(), r.z.end());
  if (!plan.inflow.empty()) facts.top_m = std::max(facts.top_m, plan.inflow.top_m);
  return facts;
}

/// See SceneDescription::other_formulation_cost.
double other_cost(const Scenario& s, const SceneInputs& inputs, const ScenePlan& plan) {
  if (!has_both_formulations(s)) return 0;
  const CostEstimate cost =
      estimate_cost(with_typical_bed(s, inputs), release_thickness(s.release, inputs), plan.bed,
                    expected_time(s, inputs, plan));
  return plan.formulation.depth_averaged ? cost.full_stress / cost.depth_averaged
                                         : cost.depth_averaged / cost.full_stress;
}

/// Adds an effect and notes what it brings; memory is the mean over the particles of all sets.
void add_measured(const EffectRow& row, SceneParts& parts, EffectNote& note) {
  std::vector<MovingSet>& sets = parts.state.sets;
  std::vector<std::pair<std::size_t, std::size_t>> before;  // fields, bytes
  for (const MovingSet& set : sets)
    before.emplace_back(set.field_names().size(), set.bytes_per_particle());
  add_effect(row, parts);
  const std::size_t own = row.bytes_per_particle ? row.bytes_per_particle() : 0;
  std::size_t bytes = 0, n = 0;
  for (std::size_t k = 0; k < sets.size(); ++k) {
    const auto names = sets[k].field_names();
    const std::size_t grown = sets[k].bytes_per_particle() - before[k].second;
    if (note.fields.empty())
      note.fields.assign(names.begin() + static_cast<std::ptrdiff_t>(before[k].first), names.end());
    // A set without a new field is not that effect's, unless it brings none at all.
    const bool belongs = grown > 0 || sets.size() == 1 || row.of_all_sets;
    bytes += (grown + (belongs ? own : 0)) * std::max<std::size_t>(1, sets[k].size());
    n += std::max<std::size_t>(1, sets[k].size());
  }
  note.bytes_per_particle = bytes / n;
}

/// Which effects there are and why, and what each brings: its row is added to a scene of its own
/// only where the scene calls for it.
std::vector<EffectNote> effect_notes(const Scenario& s, SceneParts& parts) {
  std::vector<EffectNote> notes;
  for (const EffectRow& row : effect_table()) {
    const Called called = row.called(s, parts.plan);
    EffectNote& note = notes.emplace_back();
    note.name = row.name;
    note.active = called.active;
    note.reason = called.reason;
    if (!called.active || !row.add) continue;
    add_measured(row, parts, note);
  }
  return notes;
}

}  // namespace

namespace {

std::optional<GaugeSettings> make_gauges(const Scenario& s, const ScenePlan& plan,
                                         const SceneInputs& in) {
  if (!s.gauges) return std::nullopt;
  GaugeSettings gauges;
  gauges.interval_s = s.gauges->interval_s;
  gauges.reached_m = runout_limit(plan, s.numerics.spacing_m);
  for (const Gauge& point : in.gauge_points)
    gauges.points.push_back({point.name, point.corners.front()});
  for (const Gauge& line : in.gauge_lines) gauges.lines.push_back({line.name, line.corners});
  return gauges;
}

}  // namespace

Simulation assemble(const Scenario& given, const SceneInputs& inputs, std::int64_t member,
                    int threads, InstructionSet instruction_set) {
  require_numbers(given);
  const Scenario numbers = with_grain_spacing(given);
  ScenePlan plan = plan_scene(numbers, inputs, member);
  plan.stress.instruction_set = plan.columns.instruction_set = instruction_set;
  if (plan.liquid) plan.liquid->instruction_set = instruction_set;
  State state = make_state(numbers, plan, threads);
  Step step = make_step(numbers, plan, state);
  RunFacts facts{.member = member,
                 .formulation = plan.formulation.name(),
                 .spacing_m = numbers.numerics.spacing_m,
                 .least_dt_s = least_step(numbers, plan),
                 .release = release_facts(plan, numbers.numerics.spacing_m),
                 .has_inflow = !numbers.inflow.empty(),
                 .warnings = joined(plan_warnings(numbers, plan))};
  return Simulation(std::make_unique<SimulationParts>(SimulationParts{
      std::move(state), std::move(step), make_peaks(numbers, plan, inputs.hazard_grid),
      make_stop(numbers, plan), std::move(facts), make_gauges(numbers, plan, inputs)}));
}

SceneDescription describe(const Scenario& given, const SceneInputs& inputs) {
  require_numbers(given);
  const Scenario s = with_grain_spacing(given);
  const ScenePlan plan = plan_scene(s, inputs, 0);
  State state = make_state(s, plan, 1);
  Step step;
  SceneParts parts{s, plan, step, state};
  SceneDescription d;
  d.effects = effect_notes(s, parts);
  for (MovingSet& set : state.sets) refresh_motion(state, set, 0);
  d.passes = step.pass_names();
  d.formulation = plan.formulation.name();
  d.formulation_reason = plan.formulation.reason;
  d.n_particles = state.n_particles() + plan.later.size() + plan.inflow.columns.size();
  std::size_t bytes = bare_bytes_per_particle;
  for (const EffectNote& note : d.effects) bytes += note.bytes_per_particle;
  d.memory_bytes = d.n_particles * bytes +
                   static_cast<std::size_t>(touched_cells(inputs)) * bytes_per_hazard_cell +
                   (plan.later.size() + plan.inflow.columns.size()) * waiting_column_bytes() +
                   own_ground_bytes(inputs);
  d.spacing_m = s.numerics.spacing_m;
  d.release_volume_m3 = plan.release.volume_m3;
  d.inflow_volume_m3 = plan.inflow.volume_m3;
  d.inflow_end_s = plan.inflow.last_s;
  d.release_area_m2 = inputs.source_area_m2 > 0 ? inputs.source_area_m2 : plan.release.area_m2;
  d.normal_over_vertical = inputs.normal_over_vertical;
  d.bulk_density_kg_m3 = plan.bulk_density_kg_m3;
  d.layers = plan.release.x.empty() ? plan.inflow.most_thickness_m / s.numerics.spacing_m
                                    : plan.release.layers;
  d.reference_speed_m_s = plan.reference_speed_m_s;
  d.sound_speed_m_s = sound_speed(s, plan);
  state.grains().motion.max_speed = 0.5 * typical_speed(plan);
  state.n_steps = 1;  // the first step is shorter than those that count
  const StepLimit limit = step.limit(state);
  d.dt_s = limit.dt;
  d.binding_limit = limit.name;
  d.n_steps = std::ceil(expected_time(s, inputs, plan) / limit.dt);
  d.end_time_s = plan.end.end_time_s;
  d.end_time_reason = plan.end.reason;
  d.ground = ground_line(s, inputs);
  d.warnings = ground_warnings(s, inputs);
  const auto warnings = scene_warnings(s, inputs, plan);
  d.warnings.insert(d.warnings.end(), warnings.begin(), warnings.end());
  d.needs_more_ground = state.terrain.needs_more() || plan.bed.needs_more();
  d.narrow_side_m = plan.release_narrow_side_m;
  d.other_formulation_cost = other_cost(s, inputs, plan);
  d.friction_inside = plan.formulation.depth_averaged && knows_internal_friction(plan.columns);
  return d;
}

}  // namespace sturz
