// SPDX-License-Identifier: Apache-2.0
#include "engine/effects/grain_stress.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/error.hpp"
#include "engine/core/parallel.hpp"
#include "engine/effects/terms/grain_stress_shared.hpp"
#include "engine/effects/terms/grain_stress_update.hpp"
#include "engine/effects/terms/wrapping.hpp"
#include "engine/neighbors/smoothing_kernel.hpp"

namespace sturz {
namespace {

class NeighborPass final : public Pass {
 public:
  explicit NeighborPass(std::shared_ptr<GrainStress> shared) : shared_(std::move(shared)) {}
  std::string_view name() const override { return "neighbor lists"; }
  Stage stage() const override { return Stage::neighbors; }

  void apply(State& s, double) override {
    NeighborLists& lists = shared_->lists;
    const double* range = s.motion.velocity_range;
    lists.add_relative_motion(s.previous_dt * std::sqrt(range[0] * range[0] + range[1] * range[1] +
                                                        range[2] * range[2]));
    if (s.order_changed) lists.invalidate();
    s.order_changed = false;
    if (!lists.needs_rebuild()) return;
    wrap_particles(s);
    lists.rebuild(s.grains, s.domain, s.threads);
    for (auto& r : shared_->results) r.resize(lists.padded_size());
    for (auto& r : shared_->smooth) r.resize(lists.padded_size());
    for (int c = 0; c < 6; ++c) {
      s.boundary.moment[c].resize(lists.padded_size(), 0.0f);
      s.boundary.gradient[c].resize(lists.padded_size(), 0.0f);
    }
    s.boundary.share.resize(lists.padded_size(), 0.0f);
  }
  std::size_t bytes() const override { return shared_->lists.bytes(); }

 private:
  std::shared_ptr<GrainStress> shared_;
};

/// Fills the records of the pair sweep. Velocities go in extrapolated by half a step to v_{n+1/2}:
/// stress rates taken from v_{n-1/2} would feed energy into sound waves (forward Euler).
class PackPass final : public Pass {
 public:
  explicit PackPass(std::shared_ptr<GrainStress> shared) : shared_(std::move(shared)) {}
  std::string_view name() const override { return "pack"; }
  Stage stage() const override { return Stage::pack; }

  void apply(State& s, double dt) override {
    NeighborLists& lists = shared_->lists;
    ParticleSet& p = s.grains;
    const double ahead = s.extrapolation(dt);
    const double reference = shared_->settings.reference_density;
    auto& before = p.find_field("velocity_before")->component;
    const auto& compression = p.find_field("compression")->component[0];
    const auto& stress = p.find_field("stress")->component;
    parallel_ranges(p.size(), reduction_block, s.threads, [&](std::size_t begin, std::size_t end) {
      lists.pack_positions(p, begin, end);
      PackedRecord* records = lists.records();
      for (std::size_t i = begin; i < end; ++i) {
        PackedRecord& r = records[i];
        const double e = std::max(compression[i], GrainStressSettings::separation);
        r.volume = static_cast<float>(p.mass[i] / (reference * (1 + e)));
        r.vx = static_cast<float>(p.vx[i] + ahead * (p.vx[i] - before[0][i]));
        r.vy = static_cast<float>(p.vy[i] + ahead * (p.vy[i] - before[1][i]));
        r.vz = static_cast<float>(p.vz[i] + ahead * (p.vz[i] - before[2][i]));
        r.compression = static_cast<float>(e);
        r.sxx = static_cast<float>(stress[0][i]);
        r.syy = static_cast<float>(stress[1][i]);
        r.szz = static_cast<float>(stress[2][i]);
        r.sxy = static_cast<float>(stress[3][i]);
        r.syz = static_cast<float>(stress[4][i]);
        r.szx = static_cast<float>(stress[5][i]);
        const double pressure = -(stress[0][i] + stress[1][i] + stress[2][i]) / 3;
        r.inverse_pressure = static_cast<float>(1 / (pressure + shared_->settings.ratio_floor()));
        before[0][i] = p.vx[i];
        before[1][i] = p.vy[i];
        before[2][i] = p.vz[i];
      }
    });
    lists.copy_images();
  }

 private:
  std::shared_ptr<GrainStress> shared_;
};

class SweepPass final : public Pass {
 public:
  explicit SweepPass(std::shared_ptr<GrainStress> shared) : shared_(std::move(shared)) {}
  std::string_view name() const override { return "pair sweep"; }
  Stage stage() const override { return Stage::force; }

  void limits(const State& s, std::vector<StepLimit>& out) const override {
    const GrainStressSettings& g = shared_->settings;
    out.push_back({"acoustic", g.courant * g.smoothing_length /
                                   (g.sound_speed + s.motion.max_speed)});
  }

  void apply(State& s, double) override {
    const GrainStressSettings& g = shared_->settings;
    const bool smooth = s.n_steps % GrainStressSettings::smoothing_interval == 0;
    shared_->smoothing_now =
        smooth ? g.stress_smoothing * GrainStressSettings::smoothing_interval : 0;
    const SweepConstants constants{g.smoothing_length,
                                   SmoothingKernel{g.smoothing_length}.discrete_gradient_factor(),
                                   g.reference_density,
                                   g.sound_speed,
                                   g.viscosity,
                                   g.density_diffusion,
                                   shared_->smoothing_now};
    const PackedView view = shared_->lists.view();
    SweepOutput out = shared_->output();
    out.wall_share = s.boundary.share.data();
    BoundaryView wall;
    for (int c = 0; c < 6; ++c) {
      wall.moment[c] = s.boundary.moment[c].data();
      wall.gradient[c] = s.boundary.gradient[c].data();
    }
    const Sweeps& loops = sweeps(g.instruction_set);
    const std::size_t n = s.grains.size();
    constexpr std::size_t groups_per_range = 16;
    parallel_ranges(shared_->lists.n_groups(), groups_per_range, s.threads,
                    [&](std::size_t begin, std::size_t end) {
                      loops.dense(view, constants, wall, out, begin, end);
                      const std::size_t last = std::min(n, end * group_size);
                      for (std::size_t i = begin * group_size; i < last; ++i) {
                        s.ax[i] = out.ax[i];
                        s.ay[i] = out.ay[i];
                        s.az[i] = out.az[i];
                      }
                    });
  }
  std::size_t bytes() const override { return 13 * sizeof(float) * shared_->results[0].size(); }

 private:
  std::shared_ptr<GrainStress> shared_;
};

class StressPass final : public Pass {
 public:
  explicit StressPass(std::shared_ptr<GrainStress> shared) : shared_(std::move(shared)) {}
  std::string_view name() const override { return "stress update"; }
  Stage stage() const override { return Stage::stress; }

  void apply(State& s, double dt) override {
    ParticleSet& p = s.grains;
    StressColumns columns;
    columns.mass = p.mass.data();
    columns.vx = p.vx.data(), columns.vy = p.vy.data(), columns.vz = p.vz.data();
    columns.compression = p.find_field("compression")->component[0].data();
    for (int k = 0; k < 6; ++k) columns.stress[k] = p.find_field("stress")->component[k].data();
    const SweepOutput rates = shared_->output();
    const StressUpdate update(shared_->settings, dt, shared_->smoothing_now > 0);
    const StressEnergies sums = ordered_reduce(
        p.size(), s.threads, StressEnergies{},
        [&](std::size_t begin, std::size_t end, StressEnergies& out) {
          update.apply(columns, rates, begin, end, out);
        },
        [](StressEnergies& total, const StressEnergies& block) { total += block; });
    s.ledger.elastic = sums.elastic;
    s.ledger.stress_power += sums.power;
    s.ledger.plastic += sums.plastic;
    s.ledger.diffusion += sums.diffusion;
    s.ledger.rest_damping += sums.rest;
    if (s.any_outside) release_elastic(s);
  }

 private:
  /// What a particle that is about to leave has stored goes with it.
  void release_elastic(State& s) const {
    const GrainStressSettings& g = shared_->settings;
    const auto& e = s.grains.find_field("compression")->component[0];
    const auto& c = s.grains.find_field("stress")->component;
    for (std::size_t i = 0; i < s.grains.size(); ++i) {
      if (!s.leaves(i)) continue;
      const double p = -(c[0][i] + c[1][i] + c[2][i]) / 3;
      const double xx = c[0][i] + p, yy = c[1][i] + p, zz = c[2][i] + p;
      const double tau = std::sqrt(0.5 * (xx * xx + yy * yy + zz * zz) + c[3][i] * c[3][i] +
                                   c[4][i] * c[4][i] + c[5][i] * c[5][i]);
      const double stored =
          elastic_energy(g, s.grains.mass[i] / g.reference_density, e[i], tau);
      s.ledger.elastic -= stored;
      s.ledger.lost_energy += stored;
    }
  }

  std::shared_ptr<GrainStress> shared_;
};

void start_geostatic(State& s, const GrainStressSettings& g, std::span<const double> depth) {
  auto& compression = s.grains.find_field("compression")->component[0];
  auto& stress = s.grains.find_field("stress")->component;
  const double mu = g.law.static_friction;
  const double k0 = 1 - mu / std::sqrt(1 + mu * mu);
  for (std::size_t i = 0; i < depth.size(); ++i) {
    const double vertical = g.reference_density * s.gravity * depth[i];
    compression[i] = vertical * (1 + 2 * k0) / 3 / g.bulk_modulus();
    stress[0][i] = stress[1][i] = -k0 * vertical;
    stress[2][i] = -vertical;
    s.ledger.elastic += elastic_energy(g, s.grains.mass[i] / g.reference_density, compression[i],
                                       vertical * (1 - k0) / std::sqrt(3.0));
  }
  s.ledger.elastic_0 = s.ledger.elastic;
}

}  // namespace

void add_grain_stress(Step& step, State& state, const GrainStressSettings& settings,
                      std::span<const double> depth) {
  expect(depth.size() == state.grains.size(), "one depth per particle");
  state.grains.add_field("compression", 1);
  state.grains.add_field("stress", 6);
  Field& before = state.grains.add_field("velocity_before", 3);
  before.component[0] = state.grains.vx;
  before.component[1] = state.grains.vy;
  before.component[2] = state.grains.vz;
  prepare_wrapping(state);
  GrainStressSettings first = settings;
  const bool follows = settings.least_sound_speed < settings.sound_speed;
  if (follows) first.sound_speed = sound_speed_at_start(state, settings);
  start_geostatic(state, first, depth);
  auto shared = std::make_shared<GrainStress>(first);
  state.sound_speed = first.sound_speed;
  if (follows) add_sound_speed(step, shared, settings.sound_speed);
  step.add(std::make_unique<NeighborPass>(shared));
  step.add(std::make_unique<PackPass>(shared));
  step.add(std::make_unique<SweepPass>(shared));
  step.add(std::make_unique<StressPass>(shared));
}

}  // namespace sturz
