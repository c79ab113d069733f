// SPDX-License-Identifier: Apache-2.0
#include "engine/effects/kinetic/effect.hpp"

#include "engine/core/parallel.hpp"
#include "engine/effects/dense/shared.hpp"
#include "engine/effects/fields.hpp"
#include "engine/effects/kinetic/update.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sturz {
namespace {

/// Gathers the kinetic records, after the neighbour records.
class KineticGather final : public Pass {
 public:
  explicit KineticGather(std::shared_ptr<GrainStress> shared) : shared_(std::move(shared)) {}
  std::string_view name() const override { return "kinetic gather"; }
  std::string_view effect() const override { return dispersed_effect(shared_->settings); }
  Stage stage() const override { return Stage::gather; }

  void apply(State& s, double) override {
    const MovingSet& p = s.sets[shared_->set];
    GrainStress& g = *shared_;
    const std::size_t groups = g.lists.n_records_rounded() / group_size;
    g.kinetic.resize(groups * group_size);
    g.dense_group.assign(groups, 1);
    parallel_ranges(p.n_listed, reduction_block, s.threads,
                    [&](std::size_t begin, std::size_t end) { gather(p, begin, end); });
    std::fill(g.kinetic.begin() + static_cast<std::ptrdiff_t>(p.n_listed),
              g.kinetic.begin() + static_cast<std::ptrdiff_t>(g.lists.padded_size()),
              KineticRecord{});
    g.lists.for_each_image([&](std::size_t image, std::size_t source) {
      g.kinetic[image] = g.kinetic[source];
      if (!g.dense_group[source / group_size]) g.dense_group[image / group_size] = 0;
    });
  }
  std::size_t bytes() const override {
    return shared_->kinetic.capacity() * sizeof(KineticRecord) + shared_->dense_group.capacity();
  }

 private:
  void gather(const MovingSet& p, std::size_t begin, std::size_t end) const {
    GrainStress& g = *shared_;
    const GrainStatesSettings& states = *g.settings.states;
    const auto& density_change = p.scalar(fields::density_change);
    const Field* theta = p.find(fields::granular_temperature);
    const Field* stress = p.find(fields::kinetic_stress);
    const auto& support_completeness = p.scalar(fields::support_completeness);
    const NeighborRecord* records = g.lists.records();
    for (std::size_t i = begin; i < end; ++i) {
      KineticRecord& k = g.kinetic[i];
      const double e = density_change[i], temperature = theta ? theta->component[0][i] : 0;
      k = {};
      k.viscosity = records[i].viscosity;
      if (e >= GrainStressSettings::separation_threshold && temperature == 0) continue;
      g.dense_group[i / group_size] = 0;
      const double fraction = states.reference_fraction * (1 + e);
      const double dilation_ratio =
          (1 + std::max(e, GrainStressSettings::separation_threshold)) / (1 + e);
      k.dilation_ratio = static_cast<float>(dilation_ratio);
      k.weight = static_cast<float>(pair_weight(dilation_ratio, support_completeness[i]));
      double wave = 0;
      if (temperature > 0) {
        const KineticTheory& law = *states.dilute;
        const auto c = kinetic_coefficients(law, fraction, g.settings.smoothing_length);
        wave = std::sqrt(temperature * kinetic_wave2(law, c, fraction));
        k.theta = static_cast<float>(temperature);
        k.resistance = static_cast<float>(1 / (c.conductivity * std::sqrt(temperature) + 1e-30));
        float* columns[] = {&k.xx, &k.yy, &k.zz, &k.xy, &k.yz, &k.zx};
        for (int n = 0; n < 6; ++n) *columns[n] = static_cast<float>(stress->component[n][i]);
      }
      // Artificial viscosity belongs to sound: that of contacts, or of the collisions in their
      // place.
      const double apart = kinetic_share(fraction, states.paper_switch);
      k.viscosity *= static_cast<float>(
          1 - apart + apart * std::min(1.0, wave / g.settings.sound_speed) / dilation_ratio);
    }
  }

  std::shared_ptr<GrainStress> shared_;
};

class KineticPass final : public Pass {
 public:
  explicit KineticPass(std::shared_ptr<GrainStress> shared) : shared_(std::move(shared)) {}
  std::string_view name() const override { return "granular temperature"; }
  std::string_view effect() const override { return EffectName::kinetic_theory; }
  Stage stage() const override { return Stage::stress; }

  void limits(const State& s, std::vector<StepLimit>& out) const override {
    const double none = std::numeric_limits<double>::infinity();
    const double h = shared_->settings.smoothing_length, v = s.sets[shared_->set].motion.max_speed;
    const KineticTotals& t = last_;
    out.push_back({"collisions", t.wave > 0 ? shared_->settings.courant * h / (t.wave + v) : none});
    out.push_back({"granular viscosity", t.viscosity > 0 ? 0.125 * h * h / t.viscosity : none});
    out.push_back({"conduction", t.diffusivity > 0 ? 0.1 * h * h / t.diffusivity : none});
  }

  void apply(State& s, double dt) override {
    MovingSet& p = s.sets[shared_->set];
    KineticColumns columns;
    columns.mass = p.mass.data();
    columns.density_change = p.scalar(fields::density_change).data();
    columns.theta = p.scalar(fields::granular_temperature).data();
    for (int k = 0; k < 6; ++k) columns.stress[k] = p.components(fields::kinetic_stress)[k].data();
    const SweepOutput rates = shared_->output();
    const double v = p.motion.max_speed;
    const KineticUpdate update(shared_->settings, dt, v * v / 3);
    last_ = ordered_reduce(
        p.n_listed, s.threads, KineticTotals{},
        [&](std::size_t begin, std::size_t end, KineticTotals& out) {
          update.apply(columns, rates, begin, end, out);
        },
        [](KineticTotals& total, const KineticTotals& block) { total += block; });
    p.ledger.granular = last_.granular;
    p.ledger.stress_power += last_.power;
    p.ledger.collisions += last_.collisions;
    p.ledger.conducted += last_.conducted;
    p.largest_granular_temperature = std::max(p.largest_granular_temperature, last_.theta);
    if (p.any_leaving) release(s, p, columns.theta);
  }

 private:
  /// What a grain that is about to leave has goes with it.
  static void release(const State& s, MovingSet& p, const double* theta) {
    for (std::size_t i = 0; i < p.n_listed; ++i) {
      if (!s.leaves(p, i)) continue;
      const double granular_energy = 1.5 * p.mass[i] * theta[i];
      p.ledger.granular -= granular_energy;
      p.ledger.granular_lost += granular_energy;
    }
  }

  std::shared_ptr<GrainStress> shared_;
  KineticTotals last_;
};

/// Names the state of every grain.
class StatePass final : public Pass {
 public:
  explicit StatePass(std::shared_ptr<GrainStress> shared) : shared_(std::move(shared)) {}
  std::string_view name() const override { return "grain states"; }
  std::string_view effect() const override { return EffectName::states; }
  Stage stage() const override { return Stage::stress; }

  void apply(State& s, double) override {
    MovingSet& p = s.sets[shared_->set];
    const double reference = shared_->settings.states->reference_fraction;
    const auto& density_change = p.scalar(fields::density_change);
    auto& state = p.flags(fields::state);
    auto& support_completeness = p.scalar(fields::support_completeness);
    const SweepOutput out = shared_->output();
    parallel_ranges(p.n_listed, reduction_block, s.threads,
                    [&](std::size_t begin, std::size_t end) {
                      for (std::size_t i = begin; i < end; ++i) {
                        state[i] = named(reference * (1 + density_change[i]), state[i]);
                        support_completeness[i] = out.support_completeness[i];
                      }
                    });
  }

  static std::uint8_t named(double fraction, std::uint8_t before) {
    const bool stays =
        before == static_cast<std::uint8_t>(GrainState::dense) && fraction >= leave_dense_fraction;
    return static_cast<std::uint8_t>(stays ? GrainState::dense : grain_state(fraction));
  }

 private:
  std::shared_ptr<GrainStress> shared_;
};

}  // namespace

void add_kinetic_theory(Step& step, State& state, const std::shared_ptr<GrainStress>& shared) {
  MovingSet& p = state.sets[shared->set];
  p.add(fields::granular_temperature);
  p.add(fields::kinetic_stress);
  step.add(std::make_unique<KineticPass>(shared));
}

void add_grain_states(Step& step, State& state, const std::shared_ptr<GrainStress>& shared) {
  MovingSet& p = state.sets[shared->set];
  p.add(fields::state);
  p.add(fields::support_completeness);
  // As it was set down; the packing of a dry release counts as dense also where it bears no load.
  const auto& change = p.scalar(fields::density_change);
  auto& names = p.flags(fields::state);
  const double reference = shared->settings.states->reference_fraction;
  for (std::size_t i = 0; i < p.size(); ++i)
    names[i] = StatePass::named(reference * (1 + change[i]), names[i]);
  step.add(std::make_unique<KineticGather>(shared));
  step.add(std::make_unique<StatePass>(shared));
}

}  // namespace sturz
