// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/members/growing_ground.hpp"

#include "engine/core/error.hpp"
#include "io/site/scene_inputs.hpp"

#include <utility>

namespace sturz::workflow {

GrowingGround::GrowingGround(const Scenario& scenario, SceneInputs first)
    : scenario_(scenario),
      first_(std::make_shared<const SceneInputs>(std::move(first))),
      largest_(first_) {}

std::shared_ptr<const SceneInputs> GrowingGround::now() const {
  const std::lock_guard guard(lock_);
  return largest_;
}

std::shared_ptr<const SceneInputs> GrowingGround::more_than(const SceneInputs& held) {
  const std::lock_guard guard(lock_);
  expect(held.held() != whole_of(held.terrain_grid()), "only a part of the raster can be missing");
  if (largest_->level <= held.level)
    largest_ =
        std::make_shared<const SceneInputs>(load_larger_inputs(scenario_, *first_, held.level + 1));
  return largest_;
}

}  // namespace sturz::workflow
