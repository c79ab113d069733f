// SPDX-License-Identifier: Apache-2.0
#include "engine/effects/motion/gravity.hpp"

#include "engine/core/parallel.hpp"

namespace sturz {
namespace {

/// v_{n-1/2} -> v_{n-1/2} + (a_n + g) dt; contacts follow before it is v_{n+1/2}.
class Kick final : public Pass {
 public:
  std::string_view name() const override { return "gravity and kick"; }
  std::string_view effect() const override { return EffectName::gravity; }
  Stage stage() const override { return Stage::kick; }

  void apply(State& s, double full) override {
    ParticleSet& p = s.grains;
    // The first kick starts from v_0 and needs half a step to reach v_{1/2}.
    const double dt = s.n_steps == 0 ? 0.5 * full : full;
    parallel_ranges(p.size(), reduction_block, s.threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        p.vx[i] += dt * s.ax[i];
        p.vy[i] += dt * s.ay[i];
        p.vz[i] += dt * (s.az[i] - s.gravity);
      }
    });
  }
};

}  // namespace

void add_gravity(Step& step, State& state) {
  for (auto* a : {&state.ax, &state.ay, &state.az}) a->assign(state.grains.size(), 0.0f);
  step.add(std::make_unique<Kick>());
}

}  // namespace sturz
