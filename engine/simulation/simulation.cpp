// SPDX-License-Identifier: Apache-2.0
#include "engine/simulation/simulation.hpp"

#include "engine/core/constants.hpp"
#include "engine/core/cpu_time.hpp"
#include "engine/effects/fields.hpp"
#include "engine/simulation/end_state.hpp"
#include "engine/simulation/frame_buffers.hpp"
#include "engine/simulation/maps/erosion_result.hpp"
#include "engine/simulation/parts.hpp"
#include "engine/simulation/state_shares.hpp"
#include "engine/simulation/sums/mixture_state.hpp"
#include "engine/simulation/sums/phases.hpp"
#include "engine/simulation/sums/state_hash.hpp"
#include "engine/simulation/travel.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <optional>

namespace sturz {
namespace {

using Clock = std::chrono::steady_clock;

/// Between two looks at the motion at least [s]: a tenth of the time a particle takes to fall by
/// its own size.
double sample_interval(double spacing_m) { return 0.1 * std::sqrt(spacing_m / standard_gravity); }

/// Layers are averaged over a member's life and change slowly: counted in one record of so many.
constexpr std::size_t layers_every = 8;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::size_t n_created(const State& state) {
  std::size_t n = 0;
  for (const MovingSet& set : state.sets) n += set.n_created();
  return n;
}

bool any_has(const State& state, const auto& key) {
  return std::any_of(state.sets.begin(), state.sets.end(),
                     [&](const MovingSet& set) { return set.has(key); });
}

/// One member's run: the accounts around the step.
class Run {
 public:
  Run(SimulationParts& parts, const RunControl& control)
      : parts_(parts),
        control_(control),
        start_(Clock::now()),
        cpu_start_(team_cpu_seconds(parts.state.threads)),
        passes_before_(parts.step.timings()),
        removed_before_(n_created(parts.state) - parts.state.n_particles()),
        history_(sample_interval(parts.facts.spacing_m)) {}

  MemberResult operator()() {
    State& s = parts_.state;
    for (MovingSet& set : s.sets) set.ledger.kinetic_0 = set.ledger.kinetic;
    parts_.step.admit(s);
    if (parts_.gauges) gauges_.emplace(*parts_.gauges, s);
    record();
    sample_diagnostics();
    frame(true);
    while (!over()) {
      const StepLimit limit = parts_.step.limit(s);
      ++bound_[limit.name];
      const double left = parts_.stop.end_time_s() - s.time;
      // The step may grow by a twentieth at most: a sudden long step would break the staggering.
      double dt = std::min(limit.dt, s.previous_dt > 0 ? 1.05 * s.previous_dt : limit.dt);
      if (limit.dt < parts_.facts.least_dt_s || !std::isfinite(dt)) {
        end(Outcome::diverged, "time step collapsed (limit " + std::string(limit.name) + ")");
        break;
      }
      parts_.step.apply(s, std::min(dt, left));
      after_step();
    }
    return finish();
  }

 private:
  bool over() {
    State& s = parts_.state;
    if (ended_) return true;
    if (s.terrain.needs_more())
      return end(Outcome::cancelled, "ground beyond the part that was read is needed");
    if (s.n_particles() == 0 && !waits())
      return end(Outcome::left_terrain, "all mass left the terrain");
    if (parts_.stop.out_of_time(s.time)) return end(Outcome::out_of_time, "");
    return false;
  }

  /// For mass that is still to enter.
  bool waits() const {
    const auto& sets = parts_.state.sets;
    return std::any_of(sets.begin(), sets.end(), [](const auto& p) { return p.to_come > 0; });
  }

  bool end(Outcome outcome, std::string reason) {
    ended_ = true;
    result_.outcome = outcome;
    result_.reason = std::move(reason);
    return true;
  }

  void after_step() {
    State& s = parts_.state;
    for (const MovingSet& set : s.sets) {
      if (!set.motion.finite) {
        end(Outcome::diverged, "a particle's position or velocity is not finite");
        return;
      }
      if (set.sound_speed > 0)
        result_.scalars.max_mach =
            std::max(result_.scalars.max_mach, set.motion.max_speed / set.sound_speed);
    }
    if (gauges_) gauges_->after_step(s);
    to_next_record_ += parts_.peaks.share_of_record(s.sets, s.previous_dt);
    if (to_next_record_ >= 1) record();
    // A step of columns may be as long as the interval; looking costs as much as a pass.
    if (s.time - sampled_at_ > sample_interval(parts_.facts.spacing_m) &&
        s.n_steps - sampled_step_ >= 4)
      sample_diagnostics();
    frame(false);
    if (s.n_steps % 16 == 0) watch();
  }

  /// Peak maps, whenever a particle may have moved by what they can tell apart.
  void record() {
    const double now = parts_.state.time;
    parts_.peaks.record(parts_.state.sets, now, n_records_++ % layers_every == 0);
    const LayerCount& layers = parts_.peaks.layers();
    const double span = now - recorded_at_;
    thin_time_ += layers.thin_fraction * span;
    median_time_ += layers.median * span;
    p10_time_ += layers.p10 * span;
    recorded_at_ = now;
    to_next_record_ = 0;
  }

  void sample_diagnostics() {
    const State& s = parts_.state;
    now_ = measure(s, each_);
    mixture_ = mixture_state(s.sets);
    most_pressure_ratio_ = std::max(most_pressure_ratio_, mixture_.pressure_ratio);
    const StateShares shares = state_shares(s.sets);
    state_times_.add(shares, s.time - sampled_at_);
    if (s.n_particles() > 0 && history_.wants(s.time)) history_.add(history_row(shares));
    sampled_at_ = s.time;
    sampled_step_ = s.n_steps;
    MemberScalars& m = result_.scalars;
    m.max_speed_m_s =
        std::max(m.max_speed_m_s, s.n_particles() > 1000 ? now_.high_speed : s.max_speed());
    m.max_mean_speed_m_s = std::max(m.max_mean_speed_m_s, now_.mean_speed);
    m.front_travel_m = std::max(m.front_travel_m, now_.front);
    for (const MovingSet& set : s.sets)
      if (const Field* c = set.find(fields::density_change))
        m.max_density_error = std::max(m.max_density_error, density_error(c->component[0]));
    const double kinetic = s.ledger().kinetic;
    peak_energy_ = std::max(peak_energy_, kinetic);
    at_rest_ = parts_.stop.at_rest({s.time, kinetic, now_.front, now_.com, waits()});
    if (at_rest_ && parts_.stop.stops_at_rest() && !ended_) end(Outcome::settled, "");
  }

  HistoryRow history_row(const StateShares& shares) {
    const State& s = parts_.state;
    const FrontAndTail ends = front_and_tail(each_);
    HistoryRow row;
    row.time_s = static_cast<float>(s.time);
    row.front_travel_m = static_cast<float>(now_.front);
    row.tail_travel_m = static_cast<float>(ends.tail_travel);
    row.com_travel_m = static_cast<float>(now_.com);
    row.front_speed_m_s = static_cast<float>(ends.front_speed);
    row.tail_speed_m_s = static_cast<float>(ends.tail_speed);
    row.mean_speed_m_s = static_cast<float>(now_.mean_speed);
    row.max_speed_m_s = static_cast<float>(s.max_speed());
    row.kinetic_energy_j = static_cast<float>(s.ledger().kinetic);
    row.dense = static_cast<float>(shares.dense);
    row.transition = static_cast<float>(shares.transition);
    row.dilute = static_cast<float>(shares.dilute);
    row.ultradilute = static_cast<float>(shares.ultradilute);
    row.mean_granular_temperature_m2_s2 = static_cast<float>(shares.mean_theta);
    row.max_granular_temperature_m2_s2 = static_cast<float>(shares.max_theta);
    row.mean_solid_fraction = static_cast<float>(mixture_.solid_fraction);
    row.mean_pore_pressure_ratio = static_cast<float>(mixture_.pressure_ratio);
    row.film_m3 = static_cast<float>(mixture_.film_m3);
    return row;
  }

  /// |rho/rho_ref - 1| under load that 99 % of the particles stay below.
  double density_error(const std::vector<double>& density_change) {
    loaded_.clear();
    for (double c : density_change)
      if (c > 0) loaded_.push_back(c);
    if (loaded_.empty()) return 0;
    const auto at = loaded_.begin() + static_cast<std::ptrdiff_t>(0.99 * (loaded_.size() - 1));
    std::nth_element(loaded_.begin(), at, loaded_.end());
    return *at;
  }

  /// Wall time and progress.
  void watch() {
    const double wall = seconds_since(start_);
    const std::string when = " at t = " + std::to_string(parts_.state.time) + " s";
    if (control_.max_wall_s > 0 && wall > control_.max_wall_s && !ended_)
      end(Outcome::failed,
          "wall-time limit of " + std::to_string(control_.max_wall_s) + " s reached" + when);
    if (control_.on_progress && wall - progress_at_ >= control_.progress_every_s) {
      progress_at_ = wall;
      if (!control_.on_progress(progress(wall)) && !ended_)
        end(Outcome::cancelled, "cancelled" + when);
    }
  }

  Progress progress(double wall) const {
    const State& s = parts_.state;
    Progress p;
    p.time_s = s.time;
    p.end_time_s = parts_.stop.end_time_s();
    p.front_travel_m = now_.front;
    p.kinetic_energy_j = s.ledger().kinetic;
    p.max_speed_m_s = s.max_speed();
    p.dt_s = s.previous_dt;
    p.n_steps = s.n_steps;
    p.n_particles = s.n_particles();
    p.wall_s = wall;
    return p;
  }

  void frame(bool force) {
    if (!control_.on_frame) return;
    const State& s = parts_.state;
    if (!force && s.time < next_frame_) return;
    if (control_.frame_every_s > 0)
      next_frame_ = control_.frame_every_s * (std::floor(s.time / control_.frame_every_s) + 1);
    for (std::size_t k = 0; k < s.sets.size(); ++k) control_.on_frame(frames_.frame(s, k));
  }

  MemberResult finish() {
    State& s = parts_.state;
    const bool sound = result_.outcome != Outcome::diverged;
    if (sound && s.n_particles() > 0) {
      record();
      sample_diagnostics();
      history_.add_last(history_row(state_shares(s.sets)));
      frame(true);
    }
    // The time may have ended a member that rest would have ended, had it been asked to.
    if (result_.outcome == Outcome::out_of_time && at_rest_) result_.outcome = Outcome::settled;
    result_.needs_more_ground = s.terrain.needs_more();
    result_.member = parts_.facts.member, result_.formulation = parts_.facts.formulation;
    result_.warnings = parts_.facts.warnings;
    write_balance();
    result_.censoring =
        censoring_of(result_.scalars.lost_fraction > 0, result_.outcome == Outcome::out_of_time);
    write_averages();
    auto said = doubts(result_.scalars, s.ledger(), parts_.facts.spacing_m);
    if (sound) parts_.step.warnings(s, said);
    for (const std::string& text : said)
      result_.warnings += (result_.warnings.empty() ? "" : "; ") + text;
    if (sound) write_final_state();
    if (gauges_ && sound) result_.gauges = gauges_->finish(s);
    for (const auto& [name, count] : bound_)
      if (count > most_) most_ = count, result_.binding_limit = name;
    const auto rows = history_.rows();
    result_.history.rows.assign(rows.begin(), rows.end());
    result_.history.has_states = any_has(s, fields::state);
    result_.history.has_temperature = any_has(s, fields::granular_temperature);
    result_.history.has_mixture = any_has(s, fields::solid_fraction);
    result_.scalars.wall_s = seconds_since(start_);
    result_.scalars.cpu_s = team_cpu_seconds(s.threads) - cpu_start_;
    share_out(result_.scalars.wall_s);
    return std::move(result_);
  }

  /// Release, mass and energy, by the ledger.
  void write_balance() {
    const State& s = parts_.state;
    MemberScalars& m = result_.scalars;
    const Ledger ledger = s.ledger();
    const ReleaseFacts& release = parts_.facts.release;
    const double brought = ledger.brought_mass();
    write_travel(s, release, m);
    m.end_energy_fraction = peak_energy_ > 0 ? ledger.kinetic / peak_energy_ : 0;
    m.release_volume_m3 = release.volume_m3;
    m.release_layers = release.layers;
    m.released_mass_kg = ledger.released_mass;
    m.lost_mass_kg = ledger.lost_mass;
    if (parts_.facts.has_inflow) m.inflow_volume_m3 = ledger.added_volume;
    if (brought > 0) {  // not before anything started
      m.lost_fraction = ledger.lost_mass / brought;
      m.mass_error =
          (mass_on_terrain(s) + ledger.lost_mass + ledger.taken_mass - brought) / brought;
    }
    const double released = ledger.available_energy();
    m.energy_residual = released > 0 ? ledger.residual() / released : 0;
    m.take_off_fraction = s.time > 0 && brought > 0 ? ledger.detachment / (brought * s.time) : 0;
    m.n_particles = static_cast<double>(n_created(s) - removed_before_);
    if (s.bed_supply) write_erosion(*s.bed_supply, ledger, m);
  }

  /// What is averaged over the run's time.
  void write_averages() {
    const State& s = parts_.state;
    MemberScalars& m = result_.scalars;
    const LayerCount& layers = parts_.peaks.layers();
    m.thin_fraction = s.time > 0 ? thin_time_ / s.time : layers.thin_fraction;
    m.layers_median = s.time > 0 ? median_time_ / s.time : layers.median;
    m.layers_p10 = s.time > 0 ? p10_time_ / s.time : layers.p10;
    state_times_.write(m);
    write_mixture(mixture_state(s.sets), most_pressure_ratio_, s.ledger(), m);
    double largest_temperature = 0;
    for (const MovingSet& set : s.sets)
      largest_temperature = std::max(largest_temperature, set.largest_granular_temperature);
    m.max_granular_temperature_m2_s2 = largest_temperature;
    m.granular_ratio =
        m.max_speed_m_s > 0 ? largest_temperature / (m.max_speed_m_s * m.max_speed_m_s) : 0;
    m.end_time_s = s.time;
    m.n_steps = static_cast<double>(s.n_steps);
    m.mean_dt_s = s.n_steps ? s.time / s.n_steps : 0;
  }

  void write_final_state() {
    const State& s = parts_.state;
    const Ledger ledger = s.ledger();
    parts_.peaks.finish(s.sets, result_);
    write_eroded_depth(s, result_);
    result_.scalars.runout_m = runout_of(result_, parts_.facts.release);
    write_phases(s, parts_, result_);
    write_crown_to_toe(s.terrain, parts_.facts.release, parts_.peaks.deposit_cells(),
                       places_left(s), result_.grid, result_.scalars);
    result_.state_hash = hash_of(s);
    if (is_valid(result_.outcome) && ledger.lost_mass > 0.01 * ledger.brought_mass()) {
      result_.outcome = Outcome::left_terrain;
      result_.reason = std::to_string(std::lround(100 * ledger.lost_mass / ledger.brought_mass())) +
                       " % of the mass left the terrain" + lost_by_phase(result_.scalars);
      if (ledger.leaked_mass > 0) result_.reason += ", some of it through the ground";
    }
  }

  /// Where the computing time went; what lies between the steps is the rest.
  void share_out(double wall_s) {
    double rest = wall_s;
    std::vector<PassTime> passes = parts_.step.timings();
    for (std::size_t k = 0; k < passes.size(); ++k) {
      passes[k].seconds -= passes_before_[k].seconds;
      passes[k].part_seconds -= passes_before_[k].part_seconds;
      rest -= passes[k].seconds;
    }
    passes.push_back(
        {"peak maps, history, limits", std::max(0.0, rest), std::string(EffectName::bookkeeping)});
    result_.pass_seconds = by_pass(passes);
    result_.effect_seconds = by_effect(passes);
  }

  SimulationParts& parts_;
  const RunControl& control_;
  Clock::time_point start_;
  double cpu_start_;
  std::vector<PassTime> passes_before_;  // of steps that were made by hand
  std::size_t removed_before_;           // particles that a set was cut by before its run
  MemberResult result_;
  Displacement now_;
  MixtureState mixture_;
  double most_pressure_ratio_ = 0;
  std::map<std::string, std::size_t> bound_;
  std::size_t most_ = 0;
  bool ended_ = false, at_rest_ = false;
  std::size_t sampled_step_ = 0, n_records_ = 0;
  double to_next_record_ = 0, sampled_at_ = 0, recorded_at_ = 0, thin_time_ = 0, median_time_ = 0,
         p10_time_ = 0, progress_at_ = 0, next_frame_ = 0, peak_energy_ = 0;
  std::vector<ParticleTravel> each_;
  std::vector<double> loaded_;
  StateTimes state_times_;
  HistoryRecorder history_;
  FrameBuffers frames_;
  std::optional<GaugeRecorder> gauges_;
};

}  // namespace

Simulation::Simulation(std::unique_ptr<SimulationParts> parts) : parts_(std::move(parts)) {}
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;
Simulation::~Simulation() = default;

MemberResult Simulation::run(const RunControl& control) { return Run(*parts_, control)(); }

void Simulation::step() {
  parts_->step.admit(parts_->state);
  parts_->step.apply(parts_->state, parts_->step.limit(parts_->state).dt);
}

}  // namespace sturz
