// SPDX-License-Identifier: Apache-2.0
#include "engine/effects/dilatancy/effect.hpp"

#include "engine/core/parallel.hpp"
#include "engine/core/symmetric_tensor.hpp"
#include "engine/effects/dense/shared.hpp"
#include "engine/effects/fields.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sturz {
namespace {

/// The pair sweep divides by the density of the reference packing: a packing of another one has
/// another mass in the same volume. With it the forces of a pair are opposite again.
class PackedForces final : public Pass {
 public:
  explicit PackedForces(std::shared_ptr<GrainStress> shared) : shared_(std::move(shared)) {}
  std::string_view name() const override { return "forces of the packing"; }
  std::string_view effect() const override { return EffectName::dilatancy; }
  Stage stage() const override { return Stage::force; }

  void apply(State& s, double) override {
    MovingSet& p = s.sets[shared_->set];
    const auto& packing = p.scalar(fields::packing_change);
    const auto support = static_cast<float>(2 * shared_->settings.smoothing_length);
    const float* distance = p.boundary.distance.data();
    parallel_ranges(p.n_listed, reduction_block, s.threads,
                    [&](std::size_t begin, std::size_t end) {
                      for (std::size_t i = begin; i < end; ++i) {
                        const auto share = static_cast<float>(1 / (1 + packing[i]));
                        for (auto* a : {&p.ax, &p.ay, &p.az}) (*a)[i] *= share;
                        if (distance[i] >= support) continue;  // the sweep wrote nothing there
                        for (auto& a : p.boundary.from_ground) a[i] *= share;
                      }
                    });
  }

 private:
  std::shared_ptr<GrainStress> shared_;
};

struct PackingEnergies {
  double elastic = 0;  ///< change of what load stores [J]
};

class PackingPass final : public Pass {
 public:
  PackingPass(std::shared_ptr<GrainStress> shared, const DilatancySettings& settings)
      : shared_(std::move(shared)), settings_(settings) {}
  std::string_view name() const override { return "packing"; }
  std::string_view effect() const override { return EffectName::dilatancy; }
  Stage stage() const override { return Stage::stress; }

  void apply(State& s, double dt) override {
    MovingSet& p = s.sets[shared_->set];
    const double gained = ordered_reduce(
                              p.n_listed, s.threads, PackingEnergies{},
                              [&](std::size_t begin, std::size_t end, PackingEnergies& out) {
                                for (std::size_t i = begin; i < end; ++i)
                                  out.elastic += shear(p, i, dt);
                              },
                              [](PackingEnergies& total, const PackingEnergies& block) {
                                total.elastic += block.elastic;
                              })
                              .elastic;
    p.ledger.elastic += gained;
    p.ledger.plastic -= gained;  // what yielding stores by loosening under load it does not waste
  }

 private:
  /// \return change of the elastic energy of grain i [J]
  double shear(MovingSet& p, std::size_t i, double dt) const {
    const GrainStressSettings& g = shared_->settings;
    auto& t = p.components(fields::stress);
    double& e = p.scalar(fields::density_change)[i];
    double& packing = p.scalar(fields::packing_change)[i];
    const double p0 = -(t[0][i] + t[1][i] + t[2][i]) / 3;
    const Symmetric dev{t[0][i] + p0, t[1][i] + p0, t[2][i] + p0, t[3][i], t[4][i], t[5][i]};
    const double yielding =
        yields(std::sqrt(dev.norm2()), g.law.cohesion + g.law.static_friction * p0);
    const double rate = yielding * shear_rate(i);
    if (!(rate > 0) || e < GrainStressSettings::separation_threshold) return 0;
    const double alpha = settings_.reference_fraction * (1 + packing) * (1 + e);
    const double tangent =
        settings_.slope * dilatancy(settings_.law, alpha, rate, std::fmax(0.0, p0)).tangent;
    if (tangent < 0 && e <= 0) return 0;  // nothing presses it together
    const double loosened = std::clamp(dt * rate * tangent, -most, most);
    const double next = (1 + e) / (1 - loosened) - 1;
    packing = (1 + packing) * (1 - loosened) - 1;
    const double k = g.bulk_modulus(), p1 = k * std::fmax(0.0, next);
    for (int c = 0; c < 3; ++c) t[c][i] -= p1 - p0;
    e = next;
    return p.mass[i] / g.reference_density * (p1 * p1 - p0 * p0) / (2 * k);
  }

  /// 0 where shear is elastic .. 1 on the yield surface.
  static double yields(double shear_stress, double strength) {
    const double share = strength > 0 ? shear_stress / strength : 0;
    return std::clamp((share - 0.95) / 0.05, 0.0, 1.0);
  }
  /// sqrt(2 D':D') [1/s]
  double shear_rate(std::size_t i) const {
    const auto& r = shared_->results;  // rows of L
    const double third = (r[0][i] + r[4][i] + r[8][i]) / 3.0;
    const Symmetric d{r[0][i] - third,           r[4][i] - third,
                      r[8][i] - third,           0.5 * (r[1][i] + r[3][i]),
                      0.5 * (r[5][i] + r[7][i]), 0.5 * (r[2][i] + r[6][i])};
    return 2 * std::sqrt(d.norm2());
  }

  static constexpr double most = 0.01;  ///< of the packing in one step
  std::shared_ptr<GrainStress> shared_;
  DilatancySettings settings_;
};

}  // namespace

void add_dilatancy(Step& step, State& state, const std::shared_ptr<GrainStress>& shared,
                   const DilatancySettings& settings) {
  state.sets[shared->set].add(fields::packing_change);
  step.add(std::make_unique<PackedForces>(shared));
  step.add(std::make_unique<PackingPass>(shared, settings));
}

}  // namespace sturz
