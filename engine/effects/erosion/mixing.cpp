// SPDX-License-Identifier: Apache-2.0
#include "engine/core/parallel.hpp"
#include "engine/core/sum.hpp"
#include "engine/effects/erosion/shared.hpp"
#include "engine/effects/fields.hpp"

#include <memory>
#include <utility>

namespace sturz {
namespace {

struct Mixed {
  Sum mass;           // taken up [kg]
  double energy = 0;  // lost [J]
};

/// What the new mass, which has come no way, takes off the mean travel of column i's mass.
void shift_origin(MovingSet& p, std::size_t i, double share) {
  const std::uint32_t id = p.id[i];
  const bool wraps = !p.wrapped_x.empty();
  const double dx = p.x[i] - p.start_x[id] + (wraps ? p.wrapped_x[id] : 0);
  const double dy = p.y[i] - p.start_y[id] + (wraps ? p.wrapped_y[id] : 0);
  p.lag_x[id] += share * (dx - p.lag_x[id]);
  p.lag_y[id] += share * (dy - p.lag_y[id]);
}

/// The other half enters after the kick: speed and mass of a steady flow are of second order then.
class MixingPass final : public Pass {
 public:
  explicit MixingPass(std::shared_ptr<Erosion> erosion) : erosion_(std::move(erosion)) {}
  std::string_view name() const override { return "entrainment"; }
  std::string_view effect() const override { return EffectName::erosion; }
  Stage stage() const override { return Stage::stress; }

  void apply(State& s, double) override {
    MovingSet& p = s.sets[erosion_->set];
    mix_half(s, p, *erosion_, true);
  }

 private:
  std::shared_ptr<Erosion> erosion_;
};

}  // namespace

void mix_half(const State& s, MovingSet& p, Erosion& erosion, bool keeps_works) {
  const std::vector<double>& gained = erosion.gained;
  auto& entrained = p.scalar(fields::entrained_mass);
  auto& before = p.components(fields::velocity_before);
  const Mixed mixed = ordered_reduce(
      p.size(), s.threads, Mixed{},
      [&](std::size_t begin, std::size_t end, Mixed& out) {
        for (std::size_t i = begin; i < end; ++i) {
          if (!(gained[i] > 0)) continue;
          const double mass = p.mass[i] + 0.5 * gained[i];
          const double taken = mass - p.mass[i];  // what the number can hold of it
          const double kept = p.mass[i] / mass;
          const double v2 = p.vx[i] * p.vx[i] + p.vy[i] * p.vy[i] + p.vz[i] * p.vz[i];
          shift_origin(p, i, taken / mass);
          p.vx[i] *= kept, p.vy[i] *= kept, p.vz[i] *= kept;
          if (keeps_works)
            for (auto& component : before) component[i] *= kept;
          p.mass[i] = mass;
          entrained[i] += taken;
          out.mass.add(taken);
          out.energy += 0.5 * taken * kept * v2;
        }
      },
      [](Mixed& total, const Mixed& block) {
        total.mass.add(block.mass.value());
        total.energy += block.energy;
      });
  erosion.entrained.add(mixed.mass.value());
  p.ledger.entrained_mass = erosion.entrained.value();
  p.ledger.entrainment_loss += mixed.energy;
  if (erosion.settings.received) erosion.settings.received(p, gained, 0.5);
}

void add_mixing(Step& step, const std::shared_ptr<Erosion>& erosion) {
  step.add(std::make_unique<MixingPass>(erosion));
}

}  // namespace sturz
