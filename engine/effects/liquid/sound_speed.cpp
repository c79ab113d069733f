// SPDX-License-Identifier: Apache-2.0
// The numerical sound speed of a liquid follows its flow.
#include "engine/effects/dense/following_speed.hpp"
#include "engine/effects/fields.hpp"
#include "engine/effects/liquid/shared.hpp"

#include <cstddef>
#include <utility>

namespace sturz {
namespace {

/// A change keeps every pressure and shear stress as it is, so the density that carries it is
/// another one. Elastic energy that comes or goes with that is accounted as numerical.
class LiquidSoundSpeed final : public Pass {
 public:
  LiquidSoundSpeed(std::shared_ptr<LiquidFlow> shared, double planned)
      : shared_(std::move(shared)), planned_(planned) {}
  std::string_view name() const override { return "liquid sound speed"; }
  std::string_view effect() const override { return EffectName::liquid; }
  Stage stage() const override { return Stage::neighbors; }

  void apply(State& s, double) override {
    MovingSet& p = s.sets[shared_->set];
    LiquidSettings& g = shared_->settings;
    const FollowingSpeed rule{g.speed_factor, g.least_sound_speed, planned_};
    const double wanted = rule.next(g.sound_speed, p.motion.max_speed, s.n_steps);
    if (wanted / g.sound_speed < 1.0005 && g.sound_speed / wanted < 1.0005) return;
    LiquidSettings next = g;
    next.sound_speed = wanted;
    auto& change = p.scalar(fields::density_change);
    double gained = 0;
    for (std::size_t i = 0; i < change.size(); ++i) {
      if (change[i] <= 0) continue;
      const double e = next.density_change_at(g.pressure_at(change[i]));
      gained += p.mass[i] * (next.stored_at(e) - g.stored_at(change[i]));
      change[i] = e;
    }
    g.sound_speed = p.sound_speed = wanted;
    p.ledger.elastic += gained;
    p.ledger.diffusion += gained;
  }

 private:
  std::shared_ptr<LiquidFlow> shared_;
  double planned_;
};

}  // namespace

void add_liquid_sound_speed(Step& step, const std::shared_ptr<LiquidFlow>& shared, double planned) {
  step.add(std::make_unique<LiquidSoundSpeed>(shared, planned));
}

}  // namespace sturz
