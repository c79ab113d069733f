// SPDX-License-Identifier: Apache-2.0
// The numerical sound speed follows the flow: a slide that starts, spreads and stops needs the
// stiffness of its fastest moment only then.
#include "engine/effects/dense/following_speed.hpp"
#include "engine/effects/dense/shared.hpp"
#include "engine/effects/fields.hpp"

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

/// See FollowingSpeed.
///
/// A change keeps every pressure and stress as it is: rho_new = rho_ref (1 + p/K_new). Elastic
/// energy p^2/2K + tau^2/2G goes with 1/c0^2; the difference is accounted as numerical.
class SoundSpeedPass final : public Pass {
 public:
  SoundSpeedPass(std::shared_ptr<GrainStress> shared, double planned)
      : shared_(std::move(shared)), planned_(planned) {}
  std::string_view name() const override { return "sound speed"; }
  std::string_view effect() const override { return EffectName::grain_stress; }
  Stage stage() const override { return Stage::neighbors; }

  void apply(State& s, double) override {
    MovingSet& p = s.sets[shared_->set];
    const GrainStressSettings& g = shared_->settings;
    const FollowingSpeed rule{g.speed_factor, g.least_sound_speed, planned_};
    const double wanted = rule.next(g.sound_speed, p.motion.max_speed, s.n_steps);
    if (wanted != g.sound_speed) change(p, wanted);
  }

 private:
  void change(MovingSet& p, double c0) {
    GrainStressSettings& g = shared_->settings;
    const double ratio = (g.sound_speed / c0) * (g.sound_speed / c0);  // K_old / K_new
    if (std::abs(ratio - 1) < 1e-3) return;
    g.sound_speed = p.sound_speed = c0;
    auto& density_change = p.scalar(fields::density_change);
    const auto& stress = p.components(fields::stress);
    for (std::size_t i = 0; i < density_change.size(); ++i) {
      double& e = density_change[i];
      if (e <= 0) continue;
      e = g.states ? g.density_change_at(-(stress[0][i] + stress[1][i] + stress[2][i]) / 3)
                   : e * ratio;
    }
    const double gained = (ratio - 1) * p.ledger.elastic;
    p.ledger.elastic += gained;
    p.ledger.diffusion += gained;
  }

  std::shared_ptr<GrainStress> shared_;
  double planned_;
};

}  // namespace

double sound_speed_at_start(const ParticleSet& p, const GrainStressSettings& g) {
  double fastest2 = 0;
  for (std::size_t i = 0; i < p.size(); ++i)
    fastest2 = std::max(fastest2, p.vx[i] * p.vx[i] + p.vy[i] * p.vy[i] + p.vz[i] * p.vz[i]);
  return std::max(g.least_sound_speed, g.speed_factor * std::sqrt(fastest2));
}

void add_sound_speed(Step& step, const std::shared_ptr<GrainStress>& shared, double planned) {
  step.add(std::make_unique<SoundSpeedPass>(shared, planned));
}

}  // namespace sturz
