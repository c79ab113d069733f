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
  double stopped_energy = 0;  // taken by a rim that is a wall
};

class Motion final : public Pass {
 public:
  explicit Motion(const MotionSettings& m) : settings_(m) {}
  std::string_view name() const override { return "motion"; }
  std::string_view effect() const override { return EffectName::motion; }
  Stage stage() const override { return Stage::move; }

  void limits(const State& s, std::vector<StepLimit>& out) const override {
    const double none = std::numeric_limits<double>::infinity();
    const double v = s.motion.max_speed, a = s.motion.max_acceleration;
    out.push_back({"advection", v > 0 ? 0.25 * settings_.spacing / v : none});
    out.push_back({"force", a > 0 ? 0.25 * std::sqrt(settings_.smoothing_length / a) : none});
  }

  void apply(State& s, double dt) override {
    if (s.any_outside) remove_outside(s, keep_);
    drift(s, dt);
    refresh_motion(s, dt);
  }

 private:
  void drift(State& s, double dt) const {
    ParticleSet& p = s.grains;
    const bool rim = s.terrain.nodata_rule() == NodataRule::wall;
    const DriftSums sums = ordered_reduce(
        p.size(), s.threads, DriftSums{},
        [&](std::size_t begin, std::size_t end, DriftSums& out) {
          for (std::size_t i = begin; i < end; ++i) {
            if (rim) out.stopped_energy += p.mass[i] * stop_at_rim(s, i, dt);
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
    s.ledger.potential += s.gravity * sums.risen;
    s.ledger.lost_energy += sums.stopped_energy;
  }

  MotionSettings settings_;
  std::vector<std::uint8_t> keep_;
};

}  // namespace

void add_motion(Step& step, State& state, const MotionSettings& settings) {
  (void)state;
  step.add(std::make_unique<Motion>(settings));
}

}  // namespace sturz
