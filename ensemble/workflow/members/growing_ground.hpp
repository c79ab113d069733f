// SPDX-License-Identifier: Apache-2.0
/// The part of a large raster that members compute on: it grows where one of them comes near its
/// end while the raster goes on.
#pragma once

#include "scenarios/scenario.hpp"
#include "scenarios/scene_inputs.hpp"

#include <memory>
#include <mutex>

namespace sturz::workflow {

/// Windows are nested, level by level, and follow from the scene alone. A result has the same bits
/// on every window that held all it asked for, so members may begin on any of them: they take the
/// largest that was needed so far. Held in memory are the first window, that one, and what running
/// members still use.
class GrowingGround {
 public:
  GrowingGround(const Scenario& scenario, SceneInputs first);

  /// What a member starts with. From any thread.
  std::shared_ptr<const SceneInputs> now() const;
  /// More than `held`, read from the files where nobody did before. From any thread; the others
  /// wait. \pre `held` is not the whole raster \throws SetupError when it cannot be read or held
  std::shared_ptr<const SceneInputs> more_than(const SceneInputs& held);

  /// Computes, and computes again with more ground until the result needs no more.
  /// \param compute of SceneInputs, to something with needs_more_ground; may be called again
  template <class Compute>
  auto computed(const Compute& compute) {
    for (std::shared_ptr<const SceneInputs> ground = now();; ground = more_than(*ground)) {
      auto result = compute(*ground);
      if (!result.needs_more_ground) return result;
    }
  }

 private:
  Scenario scenario_;
  std::shared_ptr<const SceneInputs> first_, largest_;
  mutable std::mutex lock_;
};

}  // namespace sturz::workflow
