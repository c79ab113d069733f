// SPDX-License-Identifier: Apache-2.0
/// The part of a large raster that members compute on: it grows where one of them comes near its
/// end while the raster goes on.
#pragma once

#include "scenarios/scenario.hpp"
#include "scenarios/scene_inputs.hpp"

#include <functional>
#include <memory>
#include <mutex>
#include <vector>

namespace sturz::workflow {

/// Windows are nested, level by level, and follow from the scene alone. A result has the same bits
/// on every window that held all it asked for, so members may begin on any of them: they take the
/// largest that was needed so far. Held in memory are the first window, that one, and what running
/// members still use.
class GrowingGround {
 public:
  /// Hears of inputs when more of them was read; called under the ground's lock. Throws when they
  /// may not be used.
  using Hearer = std::function<void(const std::vector<InputIdentity>&)>;

  GrowingGround(Scenario scenario, SceneInputs first);

  /// Larger windows have to agree with `known` too, what a results folder says was read before, and
  /// `hearer` hears of each.
  void remember(const std::vector<InputIdentity>& known, Hearer hearer);
  /// What was read so far, by any member, and what is known besides.
  std::vector<InputIdentity> identities() const;

  /// What a member starts with. From any thread.
  std::shared_ptr<const SceneInputs> now() const;
  /// More than `held`, read from the files where none did before. From any thread; the others
  /// wait. \pre `held` is not the whole raster \throws StopsRun when it cannot be read or held, or
  ///   the files hold something else than before
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
  void grow_to(int level);

  Scenario scenario_;
  std::shared_ptr<const SceneInputs> first_, largest_;
  std::vector<InputIdentity> known_;
  Hearer hearer_;
  mutable std::mutex lock_;
};

}  // namespace sturz::workflow
