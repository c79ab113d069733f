// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/members/growing_ground.hpp"

#include "engine/core/error.hpp"
#include "ensemble/members/runner.hpp"
#include "ensemble/workflow/folder/input_check.hpp"
#include "io/site/scene_inputs.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <new>
#include <stdexcept>
#include <utility>

namespace sturz::workflow {

GrowingGround::GrowingGround(Scenario scenario, SceneInputs first)
    : scenario_(std::move(scenario)),
      first_(std::make_shared<const SceneInputs>(std::move(first))),
      largest_(first_),
      known_(first_->identities) {}

void GrowingGround::remember(const std::vector<InputIdentity>& known, Hearer hearer) {
  const std::lock_guard guard(lock_);
  known_ = with_known_parts(std::move(known_), known);
  hearer_ = std::move(hearer);
}

std::vector<InputIdentity> GrowingGround::identities() const {
  const std::lock_guard guard(lock_);
  return known_;
}

std::shared_ptr<const SceneInputs> GrowingGround::now() const {
  const std::lock_guard guard(lock_);
  return largest_;
}

/// Members on two grounds make no map, so the larger window is used only where all that was read
/// before is still the same.
void GrowingGround::grow_to(int level) {
  SceneInputs larger = load_larger_inputs(scenario_, *first_, level);
  std::vector<InputIdentity> before = known_;
  std::erase_if(before, [&](const InputIdentity& was) {  // the release is not read again
    return std::none_of(larger.identities.begin(), larger.identities.end(),
                        [&](const InputIdentity& is) { return is.role == was.role; });
  });
  const auto changed = changed_inputs(scenario_, larger.identities, before);
  require(changed.empty(),
          "the input changed while members were computed (they would stand on different ground). "
          "Take the earlier file back, or begin again in another folder with --out:" +
              as_lines(changed) + "\n");
  auto known = with_known_parts(known_, larger.identities);
  if (hearer_) hearer_(known);
  known_ = std::move(known);
  largest_ = std::make_shared<const SceneInputs>(std::move(larger));
}

std::shared_ptr<const SceneInputs> GrowingGround::more_than(const SceneInputs& held) {
  const std::lock_guard guard(lock_);
  expect(held.held() != whole_of(held.terrain_grid()), "only a part of the raster can be missing");
  if (largest_->level > held.level) return largest_;
  const auto stopped = [](const std::string& why) {
    // Members that run farthest meet it, and maps without these would be wrong.
    return StopsRun("a member needs more of the terrain than was read: " + why);
  };
  try {
    grow_to(held.level + 1);
  } catch (const std::bad_alloc&) {
    throw stopped(
        "there is no memory left for it. Use fewer workers, larger cells, or cut the area out.");
  } catch (const std::runtime_error& problem) {
    throw stopped(problem.what());
  }
  return largest_;
}

}  // namespace sturz::workflow
