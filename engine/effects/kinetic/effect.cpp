// SPDX-License-Identifier: Apache-2.0
// Grains that part and meet again: kinetic records before the sweep, granular temperature and the
// states after it. Those that are left alone fly on as parcels: terms/lone_parcels.
#include "engine/core/parallel.hpp"
#include "engine/effects/dense/shared.hpp"
#include "engine/effects/isolated/flight.hpp"
#include "engine/effects/kinetic/update.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sturz {
namespace {

/// Fills the kinetic records, after the records themselves.
class KineticPack final : public Pass {
 public:
  explicit KineticPack(std::shared_ptr<GrainStress> shared) : shared_(std::move(shared)) {}
  std::string_view name() const override { return "kinetic pack"; }
  std::string_view effect() const override { return flying_effect(shared_->settings); }
  Stage stage() const override { return Stage::pack; }

  void apply(State& s, double) override {
    GrainStress& g = *shared_;
    const std::size_t groups = g.lists.n_records_rounded() / group_size;
    g.kinetic.resize(groups * group_size);
    g.calm.assign(groups, 1);
    parallel_ranges(s.n_listed, reduction_block, s.threads,
                    [&](std::size_t begin, std::size_t end) { fill(s, begin, end); });
    std::fill(g.kinetic.begin() + static_cast<std::ptrdiff_t>(s.n_listed),
              g.kinetic.begin() + static_cast<std::ptrdiff_t>(g.lists.padded_size()),
              KineticRecord{});
    g.lists.for_each_image([&](std::size_t image, std::size_t source) {
      g.kinetic[image] = g.kinetic[source];
      if (!g.calm[source / group_size]) g.calm[image / group_size] = 0;
    });
  }
  std::size_t bytes() const override {
    return shared_->kinetic.capacity() * sizeof(KineticRecord) + shared_->calm.capacity();
  }

 private:
  void fill(const State& s, std::size_t begin, std::size_t end) const {
    GrainStress& g = *shared_;
    const GrainStatesSettings& states = *g.settings.states;
    const auto& compression = s.grains.find_field("compression")->component[0];
    const Field* theta = s.grains.find_field("granular_temperature");
    const Field* stress = s.grains.find_field("kinetic_stress");
    const auto& fill = s.grains.find_field("fill")->component[0];
    const PackedRecord* records = g.lists.records();
    for (std::size_t i = begin; i < end; ++i) {
      KineticRecord& k = g.kinetic[i];
      const double e = compression[i], hot = theta ? theta->component[0][i] : 0;
      k = {};
      k.viscosity = records[i].viscosity;
      if (e >= GrainStressSettings::separation && hot == 0) continue;
      g.calm[i / group_size] = 0;
      const double fraction = states.reference_fraction * (1 + e);
      const double growth = (1 + std::max(e, GrainStressSettings::separation)) / (1 + e);
      k.growth = static_cast<float>(growth);
      k.weight = static_cast<float>(pair_weight(growth, fill[i]));
      double wave = 0;
      if (hot > 0) {
        const KineticTheory& law = *states.dilute;
        const auto c = kinetic_coefficients(law, fraction, g.settings.smoothing_length);
        wave = std::sqrt(hot * kinetic_wave2(law, c, fraction));
        k.theta = static_cast<float>(hot);
        k.resistance = static_cast<float>(1 / (c.conductivity * std::sqrt(hot) + 1e-30));
        float* columns[] = {&k.xx, &k.yy, &k.zz, &k.xy, &k.yz, &k.zx};
        for (int n = 0; n < 6; ++n) *columns[n] = static_cast<float>(stress->component[n][i]);
      }
      // Artificial viscosity belongs to sound: that of contacts, or of the collisions in their
      // place.
      const double apart = kinetic_share(fraction, states.switched);
      k.viscosity *= static_cast<float>(
          1 - apart + apart * std::min(1.0, wave / g.settings.sound_speed) / growth);
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
    const double h = shared_->settings.smoothing_length, v = s.motion.max_speed;
    const KineticTotals& t = last_;
    out.push_back({"collisions", t.wave > 0 ? shared_->settings.courant * h / (t.wave + v) : none});
    out.push_back({"granular viscosity", t.viscosity > 0 ? 0.125 * h * h / t.viscosity : none});
    out.push_back({"conduction", t.diffusivity > 0 ? 0.1 * h * h / t.diffusivity : none});
  }

  void apply(State& s, double dt) override {
    ParticleSet& p = s.grains;
    KineticColumns columns;
    columns.mass = p.mass.data();
    columns.compression = p.find_field("compression")->component[0].data();
    columns.theta = p.find_field("granular_temperature")->component[0].data();
    for (int k = 0; k < 6; ++k)
      columns.stress[k] = p.find_field("kinetic_stress")->component[k].data();
    const SweepOutput rates = shared_->output();
    const double v = s.motion.max_speed;
    const KineticUpdate update(shared_->settings, dt, v * v / 3);
    last_ = ordered_reduce(
        s.n_listed, s.threads, KineticTotals{},
        [&](std::size_t begin, std::size_t end, KineticTotals& out) {
          update.apply(columns, rates, begin, end, out);
        },
        [](KineticTotals& total, const KineticTotals& block) { total += block; });
    s.ledger.granular = last_.granular;
    s.ledger.stress_power += last_.power;
    s.ledger.collisions += last_.collisions;
    s.ledger.conducted += last_.conducted;
    s.hottest = std::max(s.hottest, last_.theta);
    if (s.any_outside) release(s, columns.theta);
  }

 private:
  /// What a grain that is about to leave has goes with it.
  static void release(State& s, const double* theta) {
    for (std::size_t i = 0; i < s.n_listed; ++i) {
      if (!s.leaves(i)) continue;
      const double heat = 1.5 * s.grains.mass[i] * theta[i];
      s.ledger.granular -= heat;
      s.ledger.granular_lost += heat;
    }
  }

  std::shared_ptr<GrainStress> shared_;
  KineticTotals last_;
};

/// Names the state of every grain and counts for how long it has been alone.
class StatePass final : public Pass {
 public:
  explicit StatePass(std::shared_ptr<GrainStress> shared) : shared_(std::move(shared)) {}
  std::string_view name() const override { return "grain states"; }
  std::string_view effect() const override { return EffectName::states; }
  Stage stage() const override { return Stage::stress; }

  void apply(State& s, double) override {
    const GrainStatesSettings& states = *shared_->settings.states;
    const auto& compression = s.grains.find_field("compression")->component[0];
    auto& state = s.grains.find_field("state")->component[0];
    auto& fill = s.grains.find_field("fill")->component[0];
    Field* alone = s.grains.find_field("steps_alone");
    const double touching = shared_->settings.touching_distance();
    const SweepOutput out = shared_->output();
    parallel_ranges(
        s.n_listed, reduction_block, s.threads, [&](std::size_t begin, std::size_t end) {
          for (std::size_t i = begin; i < end; ++i) {
            const double fraction = states.reference_fraction * (1 + compression[i]);
            state[i] = named(fraction, state[i]);
            fill[i] = out.fill[i];
            if (!alone) continue;
            double& steps = alone->component[0][i];
            const bool lone = (fraction < detach_fraction || out.neighbors[i] < detach_neighbors) &&
                              s.boundary.distance[i] >= touching;
            steps = lone ? std::min<double>(steps + 1, detach_steps) : 0;
          }
        });
    if (alone) land(s, alone->component[0], touching);
  }

 private:
  /// A parcel that lies on the ground and does not bounce any more has landed.
  void land(const State& s, std::vector<double>& alone, double touching) const {
    const ParticleSet& p = s.grains;
    const BoundarySupport& b = s.boundary;
    const double calm = 0.1 * std::sqrt(s.gravity * shared_->settings.spacing);
    for (std::size_t i = s.n_listed; i < p.size(); ++i) {
      const double vn = p.vx[i] * b.nx[i] + p.vy[i] * b.ny[i] + p.vz[i] * b.nz[i];
      if (b.distance[i] < touching && std::abs(vn) < calm) alone[i] = landed;
    }
  }

  static double named(double fraction, double before) {
    const bool stays =
        before == static_cast<double>(GrainState::dense) && fraction >= leave_dense_fraction;
    return static_cast<double>(stays ? GrainState::dense : grain_state(fraction));
  }

  std::shared_ptr<GrainStress> shared_;
};

}  // namespace

void add_grain_states(Step& step, State& state, const std::shared_ptr<GrainStress>& shared) {
  const GrainStatesSettings& settings = *shared->settings.states;
  state.grains.add_field("state", 1);
  std::fill_n(state.grains.add_field("fill", 1).component[0].begin(), state.grains.size(), 1.0);
  if (settings.dilute) {
    state.grains.add_field("granular_temperature", 1);
    state.grains.add_field("kinetic_stress", 6);
  }
  step.add(std::make_unique<KineticPack>(shared));
  if (settings.dilute) step.add(std::make_unique<KineticPass>(shared));
  if (settings.ultradilute) state.grains.add_field("steps_alone", 1);
  step.add(std::make_unique<StatePass>(shared));
}

}  // namespace sturz
