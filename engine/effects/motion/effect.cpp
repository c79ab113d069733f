// SPDX-License-Identifier: Apache-2.0
#include "engine/effects/motion/effect.hpp"

#include "engine/core/parallel.hpp"
#include "engine/effects/motion/losses.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sturz {
namespace {

struct DriftSums {
  double risen = 0;           // sum of m dz
  double stopped_energy = 0;  // taken by a domain boundary that is a wall
};

class Motion final : public Pass {
 public:
  Motion(std::size_t set, const MotionSettings& m) : set_(set), settings_(m) {}
  std::string_view name() const override { return "motion"; }
  std::string_view effect() const override { return EffectName::motion; }
  Stage stage() const override { return Stage::move; }

  void limits(const State& s, std::vector<StepLimit>& out) const override {
    const double none = std::numeric_limits<double>::infinity();
    const MovingSet& p = s.sets[set_];
    const double v = p.motion.max_speed, a = p.motion.max_acceleration;
    out.push_back({"advection", v > 0 ? 0.25 * settings_.spacing / v : none});
    out.push_back({"force", a > 0 ? 0.25 * std::sqrt(settings_.smoothing_length / a) : none});
  }

  void apply(State& s, double dt) override {
    MovingSet& p = s.sets[set_];
    if (p.any_leaving) remove_outside(s, p, keep_, dt);
    drift(s, p, dt);
    refresh_motion(s, p, dt);
  }

 private:
  static void drift(const State& s, MovingSet& p, double dt) {
    const bool walled = s.terrain.nodata_rule() == NodataRule::wall;
    const DriftSums sums = ordered_reduce(
        p.size(), s.threads, DriftSums{},
        [&](std::size_t begin, std::size_t end, DriftSums& out) {
          for (std::size_t i = begin; i < end; ++i) {
            if (walled) out.stopped_energy += p.mass[i] * stop_at_domain_boundary(s, p, i, dt);
            p.x[i] += dt * p.vx[i];
            p.y[i] += dt * p.vy[i];
            p.z[i] += dt * p.vz[i];
            out.risen += p.mass[i] * dt * p.vz[i];
          }
        },
        [](DriftSums& total, const DriftSums& block) {
          total.risen += block.risen;
          total.stopped_energy += block.stopped_energy;
        });
    p.ledger.potential += s.gravity * sums.risen;
    p.ledger.lost_energy += sums.stopped_energy;
  }

  std::size_t set_;
  MotionSettings settings_;
  std::vector<std::uint8_t> keep_;
};

}  // namespace

void add_motion(Step& step, std::size_t set, const MotionSettings& settings) {
  step.add(std::make_unique<Motion>(set, settings));
}

}  // namespace sturz
