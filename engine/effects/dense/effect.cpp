// SPDX-License-Identifier: Apache-2.0
#include "engine/effects/dense/effect.hpp"

#include "engine/core/error.hpp"
#include "engine/core/parallel.hpp"
#include "engine/effects/arrivals.hpp"
#include "engine/effects/dense/carried.hpp"
#include "engine/effects/dense/shared.hpp"
#include "engine/effects/dense/update.hpp"
#include "engine/effects/dense/viscous_share.hpp"
#include "engine/effects/fields.hpp"
#include "engine/effects/motion/wrapping.hpp"
#include "engine/neighbors/smoothing_kernel.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <iterator>

namespace sturz {
namespace {

std::int64_t now_ns() {
  using namespace std::chrono;
  return duration_cast<nanoseconds>(steady_clock::now().time_since_epoch()).count();
}

double ratio(std::int64_t part_ns, std::int64_t all_ns) {
  return all_ns > 0 ? static_cast<double>(part_ns) / static_cast<double>(all_ns) : 0;
}

class NeighborPass final : public Pass {
 public:
  explicit NeighborPass(std::shared_ptr<GrainStress> shared) : shared_(std::move(shared)) {}
  std::string_view name() const override { return "neighbor lists"; }
  std::string_view effect() const override { return EffectName::grain_stress; }
  Stage stage() const override { return Stage::neighbors; }

  void apply(State& s, double) override {
    MovingSet& p = s.sets[shared_->set];
    isolated_ns_ = all_ns_ = 0;
    if (!shared_->outdated(s, p)) return;
    const std::int64_t start = now_ns();
    wrap_particles(s.domain, p);
    rebuild(s, p, shared_->lists);
    make_room(p, shared_->lists.padded_size());
    ++p.n_sorts;
    all_ns_ = now_ns() - start;
  }
  EffectPart part() const override {
    // Asked when the pass is added, before isolated particles are.
    const auto& states = shared_->settings.states;
    if (!states || !states->ultradilute) return {};
    return {EffectName::isolated, "leaving and rejoining", ratio(isolated_ns_, all_ns_)};
  }
  std::size_t bytes() const override { return shared_->lists.bytes(); }

 private:
  void rebuild(State& s, MovingSet& p, NeighborLists& lists) {
    p.n_listed = p.size();
    if (shared_->changes) timed([&] { shared_->changes->before_sorting(p); });
    lists.rebuild(p, s.domain, s.threads, p.n_listed);
    if (!shared_->changes) return;
    timed([&] {
      if (shared_->changes->after_sorting(s.domain, p, lists))
        lists.rebuild(p, s.domain, s.threads, p.n_listed);
    });
  }

  template <class Work>
  void timed(Work&& work) {
    const std::int64_t start = now_ns();
    work();
    isolated_ns_ += now_ns() - start;
  }

  void make_room(MovingSet& p, std::size_t padded) const {
    shared_->make_room(p);
    for (auto& r : shared_->smooth) r.resize(padded);
    if (shared_->settings.states)
      for (auto& r : shared_->dispersed) r.resize(padded);
  }

  std::shared_ptr<GrainStress> shared_;
  std::int64_t isolated_ns_ = 0, all_ns_ = 0;  // of this step
};

/// Gathers the neighbour records of the pair sweep. Velocities go in extrapolated by half a step to
/// v_{n+1/2}: stress rates taken from v_{n-1/2} would feed energy into sound waves (forward Euler).
class GatherPass final : public Pass {
 public:
  explicit GatherPass(std::shared_ptr<GrainStress> shared) : shared_(std::move(shared)) {}
  std::string_view name() const override { return "gather"; }
  std::string_view effect() const override { return EffectName::grain_stress; }
  Stage stage() const override { return Stage::gather; }

  void apply(State& s, double dt) override {
    NeighborLists& lists = shared_->lists;
    MovingSet& p = s.sets[shared_->set];
    const double ahead = s.extrapolation(dt);
    const double reference = shared_->settings.reference_density;
    const bool cohesive = shared_->settings.law.cohesion > 0;
    auto& before = p.components(fields::velocity_before);
    const auto& density_change = p.scalar(fields::density_change);
    const auto& stress = p.components(fields::stress);
    const auto& viscous = p.scalar(fields::viscous_ratio);
    const Field* packing = p.find(fields::packing_change);
    parallel_ranges(
        p.n_listed, reduction_block, s.threads, [&](std::size_t begin, std::size_t end) {
          lists.gather_positions(p, begin, end);
          NeighborRecord* records = lists.records();
          for (std::size_t i = begin; i < end; ++i) {
            NeighborRecord& r = records[i];
            const double e = std::max(density_change[i], GrainStressSettings::separation_threshold);
            const double packed = packing ? 1 + packing->component[0][i] : 1;
            r.volume = static_cast<float>(p.mass[i] / (packed * reference * (1 + e)));
            r.vx = static_cast<float>(p.vx[i] + ahead * (p.vx[i] - before[0][i]));
            r.vy = static_cast<float>(p.vy[i] + ahead * (p.vy[i] - before[1][i]));
            r.vz = static_cast<float>(p.vz[i] + ahead * (p.vz[i] - before[2][i]));
            r.density_change = static_cast<float>(e);
            const double pressure = -(stress[0][i] + stress[1][i] + stress[2][i]) / 3;
            const ViscousShare v = viscous_share(viscous[i]);
            const double share = 1 - v.carried, mean = -v.carried * pressure;
            r.viscosity = static_cast<float>(v.acting);
            r.sxx = static_cast<float>(share * stress[0][i] + mean);
            r.syy = static_cast<float>(share * stress[1][i] + mean);
            r.szz = static_cast<float>(share * stress[2][i] + mean);
            r.sxy = static_cast<float>(share * stress[3][i]);
            r.syz = static_cast<float>(share * stress[4][i]);
            r.szx = static_cast<float>(share * stress[5][i]);
            if (cohesive) r.tension = artificial_pressure(stress, i, pressure);
            before[0][i] = p.vx[i];
            before[1][i] = p.vy[i];
            before[2][i] = p.vz[i];
          }
        });
    lists.copy_images();
    for (std::size_t i = p.n_listed; i < p.size(); ++i)
      before[0][i] = p.vx[i], before[1][i] = p.vy[i], before[2][i] = p.vz[i];
    gather_ground(*shared_, p, 2 * shared_->settings.smoothing_length, s.threads);
  }
  std::size_t bytes() const override {
    return shared_->ground.capacity() * sizeof(GroundRecord) +
           shared_->density_gradient.capacity() * sizeof(HalfDensityGradient);
  }

 private:
  /// epsilon = 0.3 of the largest principal tension there can be: 2 tau/sqrt(3) - p.
  static float artificial_pressure(const std::vector<std::vector<double>>& s, std::size_t i,
                                   double p) {
    const Symmetric d{s[0][i] + p, s[1][i] + p, s[2][i] + p, s[3][i], s[4][i], s[5][i]};
    const double tension = 2 * std::sqrt(d.norm2() / 3) - p;
    return static_cast<float>(0.3 * std::fmax(0.0, tension));
  }

  std::shared_ptr<GrainStress> shared_;
};

class SweepPass final : public Pass {
 public:
  explicit SweepPass(std::shared_ptr<GrainStress> shared) : shared_(std::move(shared)) {}
  std::string_view name() const override { return "pair sweep"; }
  std::string_view effect() const override { return EffectName::grain_stress; }
  Stage stage() const override { return Stage::force; }

  void limits(const State& s, std::vector<StepLimit>& out) const override {
    const GrainStressSettings& g = shared_->settings;
    out.push_back({"acoustic", g.courant * g.smoothing_length /
                                   (g.sound_speed + s.sets[shared_->set].motion.max_speed)});
  }

  void apply(State& s, double dt) override {
    MovingSet& p = s.sets[shared_->set];
    const GrainStressSettings& g = shared_->settings;
    const double kept = gradient_share(s, g.sound_speed, g.smoothing_length, dt);
    const bool smooth = s.n_steps % GrainStressSettings::smoothing_interval == 0;
    shared_->smoothing_now =
        smooth ? g.stress_smoothing * GrainStressSettings::smoothing_interval : 0;
    const SweepConstants constants{g.smoothing_length,
                                   SmoothingKernel{g.smoothing_length}.discrete_gradient_factor(),
                                   g.reference_density,
                                   g.sound_speed,
                                   g.viscosity,
                                   g.density_diffusion,
                                   g.law.cohesion > 0,
                                   g.spacing,
                                   shared_->smoothing_now,
                                   g.ratio_floor()};
    const NeighborView view = shared_->view();
    SweepOutput out = shared_->output();
    SweepArrays::join_state(out, p);
    const BoundaryView wall = shared_->boundary(s.domain, p);
    const Sweeps& loops = sweeps(g.instruction_set);
    constexpr std::size_t groups_per_range = 16;
    dispersed_ns_ = all_ns_ = 0;
    parallel_ranges(shared_->lists.n_groups(), groups_per_range, s.threads,
                    [&](std::size_t begin, std::size_t end) {
                      if (g.states)
                        timed_kinetic(view, constants, wall, out, begin, end);
                      else
                        loops.dense(view, constants, wall, out, begin, end);
                      keep_for_next(out, p, begin * group_size, end * group_size, kept);
                    });
    for (std::size_t i = p.n_listed; i < p.size(); ++i) {
      p.ax[i] = p.ay[i] = p.az[i] = 0;
      for (auto& a : p.boundary.from_ground) a[i] = 0;
    }
  }
  EffectPart part() const override {
    if (!shared_->settings.states) return {};
    return {dispersed_effect(shared_->settings), "dispersed groups", ratio(dispersed_ns_, all_ns_)};
  }
  std::size_t bytes() const override {
    return (std::size(shared_->results) + std::size(shared_->smooth)) * sizeof(float) *
           shared_->results[0].size();
  }

 private:
  /// The sweep of a mass whose grains may disperse, and which part of its time dispersed groups
  /// take: two looks at the clock for 16 groups, and one where the kind of group changes.
  void timed_kinetic(const NeighborView& view, const SweepConstants& constants,
                     const BoundaryView& wall, const SweepOutput& out, std::size_t begin,
                     std::size_t end) {
    DispersedClock clock{&now_ns};
    const std::int64_t start = now_ns();
    sweeps(shared_->settings.instruction_set)
        .kinetic(view, {shared_->kinetic.data(), shared_->dense_group.data(), &clock}, constants,
                 wall, out, begin, end);
    all_ns_.fetch_add(now_ns() - start, std::memory_order_relaxed);
    dispersed_ns_.fetch_add(clock.spent_ns, std::memory_order_relaxed);
  }

  std::shared_ptr<GrainStress> shared_;
  std::atomic<std::int64_t> dispersed_ns_ = 0, all_ns_ = 0;  // of this step, all threads
};

class StressPass final : public Pass {
 public:
  explicit StressPass(std::shared_ptr<GrainStress> shared) : shared_(std::move(shared)) {}
  std::string_view name() const override { return "stress update"; }
  std::string_view effect() const override { return EffectName::grain_stress; }
  Stage stage() const override { return Stage::stress; }

  void apply(State& s, double dt) override {
    MovingSet& p = s.sets[shared_->set];
    StressColumns columns;
    columns.mass = p.mass.data();
    columns.vx = p.vx.data(), columns.vy = p.vy.data(), columns.vz = p.vz.data();
    columns.density_change = p.scalar(fields::density_change).data();
    for (int k = 0; k < 6; ++k) columns.stress[k] = p.components(fields::stress)[k].data();
    columns.viscous_ratio = p.scalar(fields::viscous_ratio).data();
    const SweepOutput rates = shared_->output();
    const GrainStressSettings& g = shared_->settings;
    columns.distance = p.boundary.distance.data();
    const StressUpdate update(g, dt, shared_->smoothing_now > 0);
    if (g.states && g.states->paper_switch) columns.state = p.flags(fields::state).data();
    const StressEnergies sums = ordered_reduce(
        p.n_listed, s.threads, StressEnergies{},
        [&](std::size_t begin, std::size_t end, StressEnergies& out) {
          if (g.states)
            update.apply(dilatant(g, dt), columns, rates, begin, end, out);
          else
            update.apply(columns, rates, begin, end, out);
        },
        [](StressEnergies& total, const StressEnergies& block) { total += block; });
    p.ledger.elastic = sums.elastic;
    p.ledger.frictional += sums.frictional;
    p.ledger.stress_power += sums.power;
    p.ledger.plastic += sums.plastic;
    p.ledger.diffusion += sums.diffusion;
    p.ledger.rest_damping += sums.rest;
    if (p.any_leaving) release_elastic(s, p);
  }

 private:
  static DilatantPacking dilatant(const GrainStressSettings& g, double dt) {
    const GrainStatesSettings& s = *g.states;
    const double relaxation = 10 * g.smoothing_length / g.sound_speed;
    return {g.bulk_modulus(), s.reference_fraction, s.friction, s.paper_switch,
            std::exp(-dt / relaxation)};
  }

  /// What a particle that is about to leave has stored goes with it.
  void release_elastic(const State& s, MovingSet& p) const {
    for (std::size_t i = 0; i < p.n_listed; ++i) {
      if (!s.leaves(p, i)) continue;
      const double stored = stored_energy(shared_->settings, p, i);
      p.ledger.elastic -= stored;
      p.ledger.lost_energy += stored;
    }
  }

  std::shared_ptr<GrainStress> shared_;
};

/// As loosely as they were set down, under what such a packing bears.
void start_loose(MovingSet& p, const GrainStressSettings& g) {
  const GrainStatesSettings& states = *g.states;
  const double e = *states.loose_fraction / states.reference_fraction - 1;
  auto& change = p.scalar(fields::density_change);
  auto& stress = p.components(fields::stress);
  std::fill(change.begin(), change.end(), e);
  for (int k = 0; k < 3; ++k) std::fill(stress[k].begin(), stress[k].end(), -g.pressure_at(e));
}

void start_geostatic(MovingSet& p, double gravity, const GrainStressSettings& g,
                     std::span<const double> depth) {
  auto& density_change = p.scalar(fields::density_change);
  auto& stress = p.components(fields::stress);
  const double k0 = pressure_ratio_at_rest(g.friction_cone, g.law.static_friction);
  for (std::size_t i = 0; i < depth.size(); ++i) {
    const double vertical = g.reference_density * gravity * depth[i];
    const double mean = vertical * (1 + 2 * k0) / 3;
    density_change[i] = g.density_change_at(mean);
    // Near the surface the frictional pressure may ask for more than the depth gives.
    const double excess = g.pressure_at(density_change[i]) - mean;
    stress[0][i] = stress[1][i] = -k0 * vertical - excess;
    stress[2][i] = -vertical - excess;
    p.ledger.elastic += elastic_energy(g, p.mass[i] / g.reference_density, density_change[i],
                                       vertical * (1 - k0) / std::sqrt(3.0));
  }
  p.ledger.elastic_0 = p.ledger.elastic;
}

}  // namespace

std::size_t grain_stress_bytes_per_particle() {
  return 64 + 17 * 4 + 2 * (250 / 16) * 4 + 32 + sizeof(GroundRecord) + sizeof(HalfDensityGradient);
}

std::shared_ptr<GrainStress> add_grain_stress(Step& step, State& state, std::size_t set,
                                              const GrainStressSettings& settings,
                                              std::span<const double> depth) {
  MovingSet& p = state.sets[set];
  expect(depth.size() == p.size(), "one depth per particle");
  p.add(fields::density_change);
  p.add(fields::stress);
  p.add(fields::viscous_ratio);
  p.add(fields::density_gradient);
  p.add(fields::ground_weight);
  Field& before = p.add(fields::velocity_before);
  before.component[0] = p.vx;
  before.component[1] = p.vy;
  before.component[2] = p.vz;
  mark_start(state.domain, p, 0);
  GrainStressSettings first = settings;
  const bool follows = settings.least_sound_speed < settings.sound_speed;
  if (follows) first.sound_speed = sound_speed_at_start(p, settings);
  if (first.states && first.states->loose_fraction)
    start_loose(p, first);
  else
    start_geostatic(p, state.gravity, first, depth);
  auto shared = std::make_shared<GrainStress>(set, first);
  p.sound_speed = first.sound_speed;
  if (follows) add_sound_speed(step, shared, settings.sound_speed);
  step.add(std::make_unique<NeighborPass>(shared));
  step.add(std::make_unique<GatherPass>(shared));
  step.add(std::make_unique<SweepPass>(shared));
  step.add(std::make_unique<StressPass>(shared));
  return shared;
}

}  // namespace sturz
