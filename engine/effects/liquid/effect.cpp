// SPDX-License-Identifier: Apache-2.0
#include "engine/effects/liquid/effect.hpp"

#include "engine/core/error.hpp"
#include "engine/core/parallel.hpp"
#include "engine/core/sum.hpp"
#include "engine/effects/arrivals.hpp"
#include "engine/effects/dense/carried.hpp"
#include "engine/effects/fields.hpp"
#include "engine/effects/liquid/pair_viscosity.hpp"
#include "engine/effects/liquid/shared.hpp"
#include "engine/effects/liquid/update.hpp"
#include "engine/effects/motion/wrapping.hpp"
#include "engine/neighbors/smoothing_kernel.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sturz {
namespace {

const double* scalar_or_null(const MovingSet& p, const FieldKey& key) {
  const Field* f = p.find(key);
  return f ? f->component[0].data() : nullptr;
}

class LiquidNeighbors final : public Pass {
 public:
  explicit LiquidNeighbors(std::shared_ptr<LiquidFlow> shared) : shared_(std::move(shared)) {}
  std::string_view name() const override { return "liquid neighbor lists"; }
  std::string_view effect() const override { return EffectName::liquid; }
  Stage stage() const override { return Stage::neighbors; }

  void apply(State& s, double) override {
    MovingSet& p = s.sets[shared_->set];
    shared_->lists.mirror_in(s.domain.walls, s.time);
    // A particle and its image in a wall close in at twice its speed, those of a stream, too.
    const double* range = p.motion.velocity_range;
    const double apart = std::hypot(range[0], range[1], range[2]);
    if (shared_->lists.mirrors())
      shared_->lists.add_relative_motion(s.previous_dt *
                                         std::fmax(0.0, 2 * p.motion.max_speed - apart));
    if (!shared_->outdated(s, p)) return;
    wrap_particles(s.domain, p);
    p.n_listed = p.size();
    shared_->lists.rebuild(p, s.domain, s.threads);
    const LiquidSettings& g = shared_->settings;
    const double factor = SmoothingKernel{g.smoothing_length}.discrete_gradient_factor();
    shared_->lists.weigh_images(factor * std::pow(g.spacing, 3));
    shared_->make_room(p);
    ++p.n_sorts;
  }
  std::size_t bytes() const override { return shared_->lists.bytes(); }

 private:
  std::shared_ptr<LiquidFlow> shared_;
};

/// Neighbour records, velocities extrapolated to v_{n+1/2} as in grain stress. Among grains a
/// particle's volume is that of the mixture which it fills, and its shear stress acts on its share
/// of every face.
class LiquidGather final : public Pass {
 public:
  explicit LiquidGather(std::shared_ptr<LiquidFlow> shared) : shared_(std::move(shared)) {}
  std::string_view name() const override { return "liquid gather"; }
  std::string_view effect() const override { return EffectName::liquid; }
  Stage stage() const override { return Stage::gather; }

  void apply(State& s, double dt) override {
    MovingSet& p = s.sets[shared_->set];
    const LiquidSettings& g = shared_->settings;
    const double ahead = s.extrapolation(dt), inv_density = 1 / g.reference_density;
    auto& before = p.components(fields::velocity_before);
    const auto& change = p.scalar(fields::density_change);
    const auto& stress = p.components(fields::stress);
    const double* share = scalar_or_null(p, fields::grain_share);
    const auto& viscous_ratio = p.scalar(fields::viscous_ratio);
    parallel_ranges(p.size(), reduction_block, s.threads, [&](std::size_t begin, std::size_t end) {
      shared_->lists.gather_positions(p, begin, end);
      NeighborRecord* records = shared_->lists.records();
      for (std::size_t i = begin; i < end; ++i) {
        NeighborRecord& r = records[i];
        const double x = share ? share[i] : 0;
        const double e = std::fmax(change[i], least_density_change(x));
        r.volume = static_cast<float>(p.mass[i] * inv_density * (1 + x) / (1 + e));
        r.vx = static_cast<float>(p.vx[i] + ahead * (p.vx[i] - before[0][i]));
        r.vy = static_cast<float>(p.vy[i] + ahead * (p.vy[i] - before[1][i]));
        r.vz = static_cast<float>(p.vz[i] + ahead * (p.vz[i] - before[2][i]));
        // Air in pores is not a dilation that diffusion should even out.
        r.density_change = static_cast<float>(
            std::fmax(e, (1 - in_pores(x)) * LiquidSettings::separation_threshold));
        const double mean = (stress[0][i] + stress[1][i] + stress[2][i]) / 3;
        const auto pairs = PairViscosity::of(viscous_ratio[i]);
        const double of = (1 - pairs.carried) / (1 + x);
        r.held_viscosity() = static_cast<float>(pairs.alpha / (1 + x));
        r.viscosity = static_cast<float>(g.viscosity + pairs.alpha / (1 + x));
        r.sxx = static_cast<float>(mean + of * (stress[0][i] - mean));
        r.syy = static_cast<float>(mean + of * (stress[1][i] - mean));
        r.szz = static_cast<float>(mean + of * (stress[2][i] - mean));
        r.sxy = static_cast<float>(of * stress[3][i]);
        r.syz = static_cast<float>(of * stress[4][i]);
        r.szx = static_cast<float>(of * stress[5][i]);
        before[0][i] = p.vx[i];
        before[1][i] = p.vy[i];
        before[2][i] = p.vz[i];
      }
    });
    shared_->lists.copy_images();
    gather_ground(*shared_, p, 2 * g.smoothing_length, s.threads);
  }

 private:
  std::shared_ptr<LiquidFlow> shared_;
};

class LiquidSweep final : public Pass {
 public:
  explicit LiquidSweep(std::shared_ptr<LiquidFlow> shared) : shared_(std::move(shared)) {}
  std::string_view name() const override { return "liquid pair sweep"; }
  std::string_view effect() const override { return EffectName::liquid; }
  Stage stage() const override { return Stage::force; }

  void limits(const State& s, std::vector<StepLimit>& out) const override {
    const LiquidSettings& g = shared_->settings;
    // Pressure and the elastic answer to shear travel together.
    const double c = g.sound_speed * std::sqrt(1 + 4.0 / 3.0 * g.shear_stiffness);
    out.push_back({"acoustic, liquid",
                   g.courant * g.smoothing_length / (c + s.sets[shared_->set].motion.max_speed)});
  }

  void apply(State& s, double dt) override {
    MovingSet& p = s.sets[shared_->set];
    const LiquidSettings& g = shared_->settings;
    SweepConstants constants;
    constants.h = g.smoothing_length;
    constants.gradient_factor = SmoothingKernel{g.smoothing_length}.discrete_gradient_factor();
    constants.reference_density = g.reference_density;
    constants.sound_speed = g.sound_speed;
    constants.viscosity = 1;  // records hold alpha itself
    constants.density_diffusion = g.density_diffusion;
    constants.spacing = g.spacing;
    const double kept = gradient_share(s, g.sound_speed, g.smoothing_length, dt);
    const NeighborView view = shared_->view();
    const SweepOutput out = shared_->output(p);
    const BoundaryView wall = shared_->boundary(s.domain, p);
    const Sweeps& loops = sweeps(g.instruction_set);
    const double* share = scalar_or_null(p, fields::grain_share);
    constexpr std::size_t groups_per_range = 16;
    parallel_ranges(shared_->lists.n_groups(), groups_per_range, s.threads,
                    [&](std::size_t begin, std::size_t end) {
                      loops.dense(view, constants, wall, out, begin, end);
                      if (share) lighten(p, share, begin * group_size, end * group_size);
                      keep_for_next(out, p, begin * group_size, end * group_size, kept);
                    });
  }
  std::size_t bytes() const override { return shared_->bytes(); }

 private:
  /// The sweep divides by the density that diffusion may see; what acts on a particle that does not
  /// fill its pores accelerates the mass that is there. With it m (1 + X) a of a pair is opposite.
  void lighten(MovingSet& p, const double* share, std::size_t begin, std::size_t end) const {
    const NeighborRecord* records = shared_->lists.records();
    const auto& change = p.scalar(fields::density_change);
    const double reach = 2 * shared_->settings.smoothing_length / shared_->lists.view().unit_m;
    auto& ground = p.boundary.from_ground;
    for (std::size_t i = begin; i < std::min(end, p.n_listed); ++i) {
      const double filled = 1 + std::fmax(change[i], least_density_change(share[i]));
      const double seen = 1 + static_cast<double>(records[i].density_change);
      if (filled >= seen) continue;
      const auto lighter = static_cast<float>(seen / filled);
      for (auto* a : {&p.ax, &p.ay, &p.az}) (*a)[i] *= lighter;
      if (shared_->ground[i].distance >= reach) continue;  // the sweep wrote nothing there
      for (auto& a : ground) a[i] *= lighter;
    }
  }

  std::shared_ptr<LiquidFlow> shared_;
};

class LiquidStress final : public Pass {
 public:
  explicit LiquidStress(std::shared_ptr<LiquidFlow> shared) : shared_(std::move(shared)) {}
  std::string_view name() const override { return "liquid stress update"; }
  std::string_view effect() const override { return EffectName::liquid; }
  Stage stage() const override { return Stage::stress; }

  void apply(State& s, double dt) override {
    MovingSet& p = s.sets[shared_->set];
    const LiquidUpdate update(shared_->settings, dt);
    const LiquidEnergies sums = ordered_reduce(
        p.size(), s.threads, LiquidEnergies{},
        [&](std::size_t begin, std::size_t end, LiquidEnergies& out) {
          move_on(p, update, begin, end, out);
        },
        [](LiquidEnergies& total, const LiquidEnergies& block) { total += block; });
    p.ledger.elastic = sums.elastic;
    p.ledger.stress_power += sums.power;
    p.ledger.plastic += sums.viscous;
    p.ledger.diffusion += sums.diffusion;
    if (p.any_leaving) release_elastic(s, p);
  }

 private:
  void move_on(MovingSet& p, const LiquidUpdate& update, std::size_t begin, std::size_t end,
               LiquidEnergies& out) const {
    const SweepOutput r = shared_->output();
    const float* gradient[9] = {r.lxx, r.lxy, r.lxz, r.lyx, r.lyy, r.lyz, r.lzx, r.lzy, r.lzz};
    auto& change = p.scalar(fields::density_change);
    auto& stress = p.components(fields::stress);
    auto& viscous_ratio = p.scalar(fields::viscous_ratio);
    const PairViscosity pair_viscosity(shared_->settings);
    const double* share = scalar_or_null(p, fields::grain_share);
    const double* slip = scalar_or_null(p, fields::slip_divergence);
    const LiquidSettings& g = shared_->settings;
    for (std::size_t i = begin; i < end; ++i) {
      LiquidParticle now;
      for (int k = 0; k < 9; ++k) now.l[k] = gradient[k][i];
      now.diffusion = r.diffusion[i];
      now.grain_share = share ? share[i] : 0;
      now.slip_divergence = slip ? slip[i] : 0;
      now.e = change[i];
      const double mean = (stress[0][i] + stress[1][i] + stress[2][i]) / 3;
      now.s = {stress[0][i] - mean, stress[1][i] - mean, stress[2][i] - mean,
               stress[3][i],        stress[4][i],        stress[5][i]};
      LiquidEnergies energies;
      update.apply(now, energies);
      const double volume = p.mass[i] / g.reference_density, pressure = g.pressure_at(now.e);
      out.elastic += volume * energies.elastic;
      out.power += volume * energies.power;
      out.viscous += volume * energies.viscous;
      out.diffusion += volume * energies.diffusion;
      change[i] = now.e;
      viscous_ratio[i] = pair_viscosity.ratio(now.l, std::sqrt(now.s.norm2()));
      stress[0][i] = now.s.xx - pressure;
      stress[1][i] = now.s.yy - pressure;
      stress[2][i] = now.s.zz - pressure;
      stress[3][i] = now.s.xy;
      stress[4][i] = now.s.yz;
      stress[5][i] = now.s.zx;
    }
  }

  /// What a particle that is about to leave has stored goes with it.
  void release_elastic(const State& s, MovingSet& p) const {
    const LiquidSettings& g = shared_->settings;
    const auto& change = p.scalar(fields::density_change);
    const auto& t = p.components(fields::stress);
    for (std::size_t i = 0; i < p.size(); ++i) {
      if (!s.leaves(p, i)) continue;
      const double mean = (t[0][i] + t[1][i] + t[2][i]) / 3;
      const Symmetric d{t[0][i] - mean, t[1][i] - mean, t[2][i] - mean, t[3][i], t[4][i], t[5][i]};
      const double stored = p.mass[i] * (g.stored_at(change[i]) +
                                         d.norm2() / (2 * g.shear_modulus() * g.reference_density));
      p.ledger.elastic -= stored;
      p.ledger.lost_energy += stored;
    }
  }

  std::shared_ptr<LiquidFlow> shared_;
};

/// Shares the mass out by the density of each place, so that particles set down at equal distances
/// fill them under their weight: with equal masses the lowest would be closer together than they
/// stand, by gH/c0^2, and every pressure three times as much too high. The sum stays.
void hold_places(MovingSet& p, const std::vector<double>& change) {
  Sum before, after;
  for (std::size_t i = 0; i < p.size(); ++i) {
    before.add(p.mass[i]);
    p.mass[i] *= 1 + std::fmax(0.0, change[i]);
    after.add(p.mass[i]);
  }
  if (!(after.value() > before.value())) return;
  Sum released;
  for (double& m : p.mass) {
    m *= before.value() / after.value();
    released.add(m);
  }
  p.ledger.released_mass = released.value();
}

void start_hydrostatic(MovingSet& p, double gravity, const LiquidSettings& g,
                       std::span<const double> depth, std::span<const double> saturation) {
  auto& change = p.scalar(fields::density_change);
  auto& stress = p.components(fields::stress);
  for (std::size_t i = 0; i < depth.size(); ++i) {
    if (!saturation.empty() && saturation[i] < 1) {
      change[i] = saturation[i] - 1;
      continue;
    }
    const double pressure = g.reference_density * gravity * std::fmax(0.0, depth[i]);
    change[i] = g.density_change_at(pressure);
    for (int k = 0; k < 3; ++k) stress[k][i] = -pressure;
  }
  hold_places(p, change);
  for (std::size_t i = 0; i < depth.size(); ++i)
    p.ledger.elastic += p.mass[i] * g.stored_at(change[i]);
  p.ledger.elastic_0 = p.ledger.elastic;
}

double speed_at_start(const ParticleSet& p) {
  double fastest2 = 0;
  for (std::size_t i = 0; i < p.size(); ++i)
    fastest2 = std::max(fastest2, p.vx[i] * p.vx[i] + p.vy[i] * p.vy[i] + p.vz[i] * p.vz[i]);
  return std::sqrt(fastest2);
}

}  // namespace

std::size_t liquid_bytes_per_particle() {
  return 64 + 14 * 4 + 2 * (250 / 16) * 4 + sizeof(GroundRecord) + sizeof(HalfDensityGradient);
}

void add_liquid(Step& step, State& state, std::size_t set, const LiquidSettings& settings,
                std::span<const double> depth, std::span<const double> saturation) {
  MovingSet& p = state.sets[set];
  expect(depth.size() == p.size(), "one depth per particle");
  expect(saturation.empty() || saturation.size() == p.size(), "one saturation per particle");
  p.add(fields::density_change);
  p.add(fields::stress);
  p.add(fields::density_gradient);
  p.add(fields::ground_weight);
  Field& ratio = p.add(fields::viscous_ratio);
  std::fill(ratio.component[0].begin(), ratio.component[0].end(), PairViscosity::none);
  Field& before = p.add(fields::velocity_before);
  before.component[0] = p.vx;
  before.component[1] = p.vy;
  before.component[2] = p.vz;
  mark_start(state.domain, p, 0);
  p.boundary.mirrored_walls = true;
  LiquidSettings first = settings;
  const bool follows = settings.least_sound_speed < settings.sound_speed;
  if (follows)
    first.sound_speed =
        std::max(settings.least_sound_speed, settings.speed_factor * speed_at_start(p));
  start_hydrostatic(p, state.gravity, first, depth, saturation);
  p.sound_speed = first.sound_speed;
  const auto shared = std::make_shared<LiquidFlow>(set, first);
  if (follows) add_liquid_sound_speed(step, shared, settings.sound_speed);
  step.add(std::make_unique<LiquidNeighbors>(shared));
  step.add(std::make_unique<LiquidGather>(shared));
  step.add(std::make_unique<LiquidSweep>(shared));
  step.add(std::make_unique<LiquidStress>(shared));
}

}  // namespace sturz
