// SPDX-License-Identifier: Apache-2.0
#include "engine/effects/motion/gravity.hpp"

#include "engine/core/parallel.hpp"

namespace sturz {
namespace {

/// v_{n-1/2} -> v_{n-1/2} + (a_n + g) dt; contacts follow before it is v_{n+1/2}.
class Kick final : public Pass {
 public:
  explicit Kick(std::size_t set) : set_(set) {}
  std::string_view name() const override { return "gravity and kick"; }
  std::string_view effect() const override { return EffectName::gravity; }
  Stage stage() const override { return Stage::kick; }

  void apply(State& s, double full) override {
    MovingSet& p = s.sets[set_];
    // The first kick starts from v_0 and needs half a step to reach v_{1/2}.
    const double dt = s.n_steps == 0 ? 0.5 * full : full;
    parallel_ranges(p.size(), reduction_block, s.threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        p.vx[i] += dt * p.ax[i];
        p.vy[i] += dt * p.ay[i];
        p.vz[i] += dt * (p.az[i] - s.gravity);
      }
    });
  }

 private:
  std::size_t set_;
};

}  // namespace

void add_gravity(Step& step, State& state, std::size_t set) {
  MovingSet& p = state.sets[set];
  for (auto* a : {&p.ax, &p.ay, &p.az}) a->assign(p.size(), 0.0f);
  step.add(std::make_unique<Kick>(set));
}

}  // namespace sturz
