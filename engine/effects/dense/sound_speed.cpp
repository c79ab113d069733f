// SPDX-License-Identifier: Apache-2.0
// The numerical sound speed follows the flow: a slide that starts, spreads and stops needs the
// stiffness of its fastest moment only then.
#include "engine/effects/dense/shared.hpp"
#include "engine/effects/fields.hpp"

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

/// Keeps c0 at `factor` times the present largest speed (so the Mach number stays at 1/factor),
/// never under what the mass needs at rest and never over twice what its descent asks for.
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
    const double needed = g.speed_factor * p.motion.max_speed;
    const double wanted =
        std::clamp(room * needed, g.least_sound_speed, 2 * std::max(planned_, g.least_sound_speed));
    if (wanted > g.sound_speed && needed > g.sound_speed)
      change(p, wanted);
    else if (s.n_steps % interval == 0 && wanted < g.sound_speed)
      change(p, std::max(wanted, fall * g.sound_speed));
  }

 private:
  /// Raised at once with this much room, so that an accelerating flow does not ask every step.
  static constexpr double room = 1.1;
  /// Lowered slowly: by this factor every so many-th step.
  static constexpr double fall = 0.97;
  static constexpr int interval = 16;

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
