// SPDX-License-Identifier: Apache-2.0
#include "engine/effects/phases/effect.hpp"

#include "engine/core/error.hpp"
#include "engine/effects/columns/effect.hpp"
#include "engine/effects/motion/wrapping.hpp"
#include "engine/effects/phases/nodes.hpp"
#include "engine/effects/phases/shared.hpp"

namespace sturz {
namespace {

/// One frame for the cells of both sets, so that each finds the other's columns.
class FramePass final : public Pass {
 public:
  explicit FramePass(std::shared_ptr<TwoPhases> both) : both_(std::move(both)) {}
  std::string_view name() const override { return "cells of both phases"; }
  Stage stage() const override { return Stage::neighbors; }

  void apply(State& s, double) override {
    for (std::size_t k : {0, 1}) wrap_particles(s.domain, s.sets[k]);
    both_->frame =
        ColumnCells::frame_of(s.sets[0], s.sets[1], s.sets[0].scalar(fields::support_radius),
                              s.sets[1].scalar(fields::support_radius));
  }

 private:
  std::shared_ptr<TwoPhases> both_;
};

}  // namespace

void add_phase_frame(Step& step, const std::shared_ptr<TwoPhases>& both) {
  step.add(std::make_unique<FramePass>(both));
}

std::size_t two_phase_bytes_per_particle() {
  return 2 * column_bytes_per_particle() + 2 * (5 * 4 + 6 * 8 + 4 * 8 + 3 * 8) +
         DragNodes::bytes_per_column();
}

void add_two_phases(Step& step, State& state, const TwoPhaseSettings& settings,
                    std::span<const double> grains, std::span<const double> liquid,
                    std::span<const double> grains_covered,
                    std::span<const double> liquid_covered) {
  expect(state.sets.size() == 2, "grains and liquid are two sets");
  expect(!settings.grains.mixture && !settings.liquid.mixture,
         "two velocities have no pore pressure of their own");
  expect(settings.grains.spent_inside.empty() && settings.liquid.spent_inside.empty(),
         "pressure of two phases is isotropic");
  auto both = std::make_shared<TwoPhases>(settings);
  add_phase_frame(step, both);
  both->flow[0] = add_depth_averaged(step, state, 0, settings.grains, grains, grains_covered);
  both->flow[1] = add_depth_averaged(step, state, 1, settings.liquid, liquid, liquid_covered);
  for (const auto& flow : both->flow) {
    expect(!state.sets[flow->set].has(fields::earth_pressure),
           "pressure of two phases is isotropic");
    flow->frame = &both->frame;
    flow->has_exchange = true;
  }
  add_phase_pressure(step, both);
  add_phase_drag(step, both);
}

}  // namespace sturz
